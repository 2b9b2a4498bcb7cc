#include "python/python_watch.h"

#include <string>
#include <utility>

#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr std::chrono::milliseconds kBetween{100};

thread_local PythonWatch* working_under = nullptr;

}  // namespace

PythonWatch::PythonWatch(py::object progress) : progress_(std::move(progress)) {}

PythonWatch::Caller::Caller(PythonWatch& watch) { working_under = &watch; }
PythonWatch::Caller::~Caller() { working_under = nullptr; }

Watch PythonWatch::for_longer() {
  Watch watch;
  watch.stopped = [self = self_] {
    PythonWatch* const working = *self ? self->load() : working_under;
    return working && working->stopped();
  };
  if (progress_.is_none()) return watch;
  watch.tell = [self = self_](const Step& step) {
    if (PythonWatch* const working = *self) working->tell(step);
  };
  return watch;
}

Watch PythonWatch::watch() {
  Watch watch;
  watch.stopped = [this] { return stopped(); };
  if (!progress_.is_none()) watch.tell = [this](const Step& step) { tell(step); };
  return watch;
}

bool PythonWatch::stopped() {
  if (std::this_thread::get_id() != caller_) return stopped_;
  const auto now = std::chrono::steady_clock::now();
  if (now - asked_ < kBetween) return stopped_;
  asked_ = now;
  const py::gil_scoped_acquire acquire;
  if (PyErr_CheckSignals() != 0) note_raised();
  return stopped_;
}

void PythonWatch::tell(const Step& step) {
  const auto now = std::chrono::steady_clock::now();
  if (step.done > 0 && !step.ended && now - told_ < kBetween) return;
  told_ = now;
  const py::gil_scoped_acquire acquire;
  try {
    progress_(std::string(step.name), step.done, step.total, step.ended);
  } catch (py::error_already_set& error) {
    error.restore();
    note_raised();
  }
}

void PythonWatch::note_raised() {
  PyObject* type = nullptr;
  PyObject* value = nullptr;
  PyObject* trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  if (!stopped_.exchange(true)) {
    type_ = py::reinterpret_steal<py::object>(type);
    value_ = py::reinterpret_steal<py::object>(value);
    trace_ = py::reinterpret_steal<py::object>(trace);
    return;
  }
  Py_XDECREF(type);
  Py_XDECREF(value);
  Py_XDECREF(trace);
}

void PythonWatch::throw_raised() {
  if (!type_) return;
  PyErr_Restore(type_.release().ptr(), value_.release().ptr(), trace_.release().ptr());
  throw py::error_already_set();
}

}  // namespace heightlight
