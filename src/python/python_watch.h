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

/// Long work as Python sees it: signals end it, and a function hears how far it is. The thread that makes it
/// must be the one that the work is called from, which does its share of it: that thread asks Python for
/// signals, ten times a second.
class PythonWatch {
 public:
  /// `progress(name, done, total, ended)`, or None.
  explicit PythonWatch(py::object progress);
  ~PythonWatch() { *self_ = nullptr; }
  PythonWatch(const PythonWatch&) = delete;
  PythonWatch& operator=(const PythonWatch&) = delete;

  /// Calls work(watch) without Python's lock. An exception that Python raised meanwhile (KeyboardInterrupt,
  /// or one of the function's own) comes out in place of Cancelled, and of a result that came all the same.
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

  /// For what is made in a call and outlives it, such as an operator: until this watch ends it is this one's,
  /// and afterwards it asks the watch under which the thread works that asks.
  Watch for_longer();

 private:
  /// Says whose watch this thread works under.
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
  std::chrono::steady_clock::time_point asked_ = std::chrono::steady_clock::now();  ///< of the caller alone
  std::chrono::steady_clock::time_point told_ = asked_;  ///< of whoever tells, one at a time
  std::atomic<bool> stopped_{false};
  /// Where what outlives this watch finds it; null once it has ended.
  std::shared_ptr<std::atomic<PythonWatch*>> self_ = std::make_shared<std::atomic<PythonWatch*>>(this);
  py::object type_, value_, trace_;  ///< of what was raised first
};

}  // namespace heightlight
