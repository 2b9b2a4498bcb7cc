#include <pybind11/stl.h>

#include "base/parallel.h"
#include "fit/fit_study.h"
#include "heightlight/error.h"
#include "python/bindings.h"
#include "python/curve_table.h"
#include "python/python_watch.h"

namespace heightlight {
namespace {

/// Converts a map from Python: name, material, curves over α and A, and s and the mean of n if known.
JudgedMap read_map(const py::dict& told) {
  JudgedMap map;
  map.name = told["name"].cast<std::string>();
  map.material = told["material"].cast<std::string>();
  map.over_alpha = read_curve_table(told["over_alpha"]);
  map.over_sky = read_curve_table(told["over_sky"]);
  if (map.over_alpha.kind != AoKind::ambient_occlusion || map.over_sky.kind != AoKind::sky_view_factor)
    throw UsageError("curves", "",
                     "of " + map.name + " must be over ambient_occlusion, then sky_view_factor");
  for (const BounceCurves* curves : {&map.over_alpha, &map.over_sky}) {
    if (curves->filled.size() < kFewestBins || curves->filled.front().bounces.size() < 3)
      throw UsageError("curves", "",
                       "of " + map.name + " have fewer than " + std::to_string(kFewestBins) +
                           " filled bins or fewer than two bounces");
  }
  map.expected_seen = told["expected_seen"].cast<std::optional<double>>();
  map.measured_seen = told["measured_seen"].cast<std::optional<double>>();
  return map;
}

}  // namespace

void add_fit(py::module_& module) {
  module.def(
      "fit",
      [](const std::vector<py::dict>& told, const Settings& settings, const std::vector<std::string>& forms,
         int bootstrap) {
        if (told.empty()) throw UsageError("curves", "", "of at least one map are wanted");
        std::vector<JudgedMap> maps;
        for (const py::dict& map : told) maps.push_back(read_map(map));
        const std::vector<UserForm> own = read_user_forms(forms, {});
        PythonWatch watch(settings.progress);
        return watch.run([&](const Watch& progress) {
          const ThreadScope threads(settings.threads);
          FitReport report =
              fit_maps(std::move(maps), own, {.draws = bootstrap, .seed = settings.seed, .watch = progress});
          for (const JudgedMap& map : report.maps) report.inputs.emplace_back(map.name);
          return std::pair(report_json(report), report_csv(report));
        });
      },
      py::arg("maps"), py::arg("settings"), py::arg("forms"), py::arg("bootstrap"));
}

}  // namespace heightlight
