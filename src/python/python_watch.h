#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "heightlight/error.h"
#include "heightlight/watch.h"

namespace heightlight {

namespace py = pybind11;

/// Connects long work with Python: signals end the work, and a Python function hears of its progress. It must
/// be constructed on the thread that calls the work and takes part in it. That thread asks Python for signals
/// ten times a second.
class PythonWatch {
 public:
  /// `progress` is a function (name, done, total, ended), or None.
  explicit PythonWatch(py::object progress);
  ~PythonWatch() { *self_ = nullptr; }
  PythonWatch(const PythonWatch&) = delete;
  PythonWatch& operator=(const PythonWatch&) = delete;

  /// Calls work(watch) without holding Python's lock (GIL). An exception that Python raised meanwhile
  /// (KeyboardInterrupt, or one from the progress function) is thrown instead of Cancelled, and also if the
  /// work returned a result all the same.
  template <class Work>
  auto run(Work&& work) {
    try {
      auto found = run_unlocked(work);
      throw_raised();
      return found;
    } catch (const Cancelled&) {
      throw_raised();
      throw;
    }
  }

  /// A watch for an object that is made in a call and outlives it, such as an operator. While this
  /// PythonWatch exists, the watch refers to it; afterwards to the PythonWatch under which the asking thread
  /// is working.
  Watch for_longer();

 private:
  /// Registers the PythonWatch under which this thread works.
  class Caller {
   public:
    explicit Caller(PythonWatch& watch);
    ~Caller();
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;
  };

  template <class Work>
  auto run_unlocked(Work& work) {
    const py::gil_scoped_release release;
    const Caller caller(*this);
    return work(watch());
  }

  Watch watch();
  bool stopped();
  void tell(const Step& step);
  void note_raised();
  void throw_raised();

  py::object progress_;
  std::thread::id caller_ = std::this_thread::get_id();
  /// Time of the last look for signals; used by the caller's thread only.
  std::chrono::steady_clock::time_point asked_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point told_ = asked_;  ///< last report; used by one thread at a time
  std::atomic<bool> stopped_{false};
  /// Through this pointer, objects that outlive this watch find it; null once the watch has ended.
  std::shared_ptr<std::atomic<PythonWatch*>> self_ = std::make_shared<std::atomic<PythonWatch*>>(this);
  py::object type_, value_, trace_;  ///< the first exception that was raised
};

}  // namespace heightlight
