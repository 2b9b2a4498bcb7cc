#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "heightlight/files.h"
#include "heightlight/solve.h"

// What the module heightlight._native offers to the Python package around it. Functions take and return plain
// arrays; names, defaults and documentation belong to the package.

namespace heightlight {

namespace py = pybind11;

/// Accuracy and limits, as Python passes them.
struct Settings {
  double error = 0.002;  ///< RMSE wanted; 0: exact slices
  int azimuths = 0;
  int rays = 0;  ///< rays per texel; 0: horizon walks
  std::uint64_t seed = 1;
  int threads = 0;
  std::uint64_t memory = 0;  ///< bytes beyond what the process already holds; 0: default_memory
  py::object progress = py::none();
};

/// Converts the settings to a request. Throws UsageError for a quantity out of its range.
Request make_request(const Settings& settings);

/// Evidence as JSON text.
std::string evidence_text(const Evidence& evidence);

/// Converts the options of heightlight.read.
LoadOptions read_load_options(const py::dict& options);

/// Converts the arguments of heightlight.bake; the format of files is left at its default. Throws UsageError.
BakeOptions read_bake_options(const std::vector<std::string>& maps, const py::dict& choice,
                              const Settings& settings);

/// The map with that name. Throws UsageError.
MaterialMap map_named(const std::string& name);

/// Sets the format of files: "png", "exr" or "tif", and the depth: "8", "16", "half", "float", or empty for
/// the format's default. Throws UsageError.
void set_format(const std::string& format, const std::string& depth, BakeOptions& options);

/// A surface that Python and operators share.
using SharedSurface = std::shared_ptr<const Surface>;

// Each of these functions adds its part to the module.
void add_surface(py::module_& module);
void add_sky(py::module_& module);
void add_light(py::module_& module);
void add_operator(py::module_& module);
void add_forms(py::module_& module);
void add_files(py::module_& module);
void add_bake(py::module_& module);
void add_work(py::module_& module);
void add_compare(py::module_& module);
void add_fit(py::module_& module);

}  // namespace heightlight
