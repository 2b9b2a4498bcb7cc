#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bake/bake.h"
#include "heightlight/files.h"
#include "heightlight/solve.h"

// What the module heightlight._native offers to the package around it, which is written in Python. Functions
// take and give plain arrays; names, defaults and documentation are the package's.

namespace heightlight {

namespace py = pybind11;

/// How everything is found, as Python says it.
struct Settings {
  double error = 0.002;  ///< 0: exact slices
  int azimuths = 0;
  int rays = 0;  ///< > 0: by rays
  std::uint64_t seed = 1;
  int threads = 0;
  std::uint64_t memory = 0;  ///< bytes beside what the process holds; 0: default_memory
  py::object progress = py::none();
};

/// Accuracy and limits of a request. Throws UsageError for a quantity out of its range.
Request make_request(const Settings& settings);

/// Evidence as the text of JSON.
std::string evidence_text(const Evidence& evidence);

/// How a file becomes heights, as heightlight.read says it.
LoadOptions read_load_options(const py::dict& options);

/// What is baked, as heightlight.bake says it; its files' format is as it was. Throws UsageError.
BakeOptions read_bake_options(const std::vector<std::string>& maps, const py::dict& choice,
                              const Settings& settings);

/// The map of that name. Throws UsageError.
MaterialMap map_named(const std::string& name);

/// "png", "exr" or "tif"; "8", "16", "half", "float", or as the format has it where empty. Throws UsageError.
void set_format(const std::string& format, const std::string& depth, BakeOptions& options);

/// A surface that Python and operators share.
using SharedSurface = std::shared_ptr<const Surface>;

// Each adds its part to the module.
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
