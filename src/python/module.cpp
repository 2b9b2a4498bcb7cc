#include "base/machine_share.h"
#include "files/evidence_json.h"
#include "heightlight/error.h"
#include "heightlight/version.h"
#include "python/bindings.h"

namespace heightlight {

Request make_request(const Settings& settings) {
  if (!(settings.error >= 0) || settings.error > 1)
    throw UsageError("error", std::to_string(settings.error), "must be from 0 to 1");
  if (settings.rays < 0) throw UsageError("rays", std::to_string(settings.rays), "must be from 1 to 65536");
  if (settings.threads < 0) throw UsageError("threads", std::to_string(settings.threads), "must be positive");
  Request request;
  request.accuracy.visibility = settings.rays > 0     ? Visibility::rays
                                : settings.error == 0 ? Visibility::exact_slices
                                                      : Visibility::horizon_walks;
  request.accuracy.error = settings.error;
  request.accuracy.azimuths = settings.azimuths;
  if (settings.rays > 0) request.accuracy.rays = settings.rays;
  request.accuracy.seed = settings.seed;
  request.limits = {.memory = settings.memory > 0 ? settings.memory : default_memory(settings.threads),
                    .threads = settings.threads};
  return request;
}

std::string evidence_text(const Evidence& evidence) {
  nlohmann::ordered_json json = describe_evidence(evidence);
  json["seconds"] = describe_times(evidence.seconds);
  json["threads"] = evidence.threads;
  json["faults"] = find_faults(evidence);
  return json_text(json);
}

namespace {

/// Checks the settings at once, not only when they are first used.
void check_settings(const Settings& settings) {
  const Request request = make_request(settings);
  if (settings.azimuths > 0) check_azimuths(settings.azimuths);
  if (settings.rays > 0) check_ray_options({.rays = request.accuracy.rays});
}

/// Translates Heightlight's exceptions for Python: ValueError for arguments that make no sense, MemoryError
/// for what does not fit in memory, OSError for files. Messages name quantities, which have the names of the
/// Python arguments.
void translate(
    std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param): pybind11 wants it so
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const UsageError& error) {
    PyErr_SetString(PyExc_ValueError, error.what());
  } catch (const MemoryError& error) {
    PyErr_SetString(PyExc_MemoryError, error.what());
  } catch (const Cancelled&) {
    PyErr_SetString(PyExc_KeyboardInterrupt, "");
  } catch (const Error& error) {
    PyErr_SetString(PyExc_OSError, error.what());
  }
}

}  // namespace
}  // namespace heightlight

PYBIND11_MODULE(_native, module) {
  using namespace heightlight;
  namespace py = pybind11;
  module.doc() = "Compiled part of heightlight. Use the package.";
  module.attr("version") = HEIGHTLIGHT_VERSION;
  py::register_exception_translator(translate);
  py::class_<Settings>(module, "Settings")
      .def(py::init([](double error, int azimuths, int rays, std::uint64_t seed, int threads,
                       std::uint64_t memory, py::object progress) {
             Settings settings{
                 error,  azimuths,           rays, seed, threads == 0 ? default_threads() : threads,
                 memory, std::move(progress)};
             check_settings(settings);
             return settings;
           }),
           py::kw_only(), py::arg("error"), py::arg("azimuths"), py::arg("rays"), py::arg("seed"),
           py::arg("threads"), py::arg("memory"), py::arg("progress"));
  add_surface(module);
  add_sky(module);
  add_light(module);
  add_operator(module);
  add_forms(module);
  add_files(module);
  add_bake(module);
  add_work(module);
  add_compare(module);
  add_fit(module);
}
