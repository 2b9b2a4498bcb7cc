#include <pybind11/stl.h>

#include <cmath>

#include "base/parallel.h"
#include "comparison/comparison_study.h"
#include "heightlight/error.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "python/python_watch.h"
#include "user_form/user_form.h"

namespace heightlight {
namespace {

py::dict describe_row(const ComparisonRow& row) {
  py::dict told;
  told["method"] = row.method;
  told["parameters"] = row.parameters;
  told["variant"] = row.variant;
  told["quantity"] = row.quantity;
  told["seconds"] = row.cost.wall;
  told["core_seconds"] = row.cost.core;
  told["samples_per_texel"] = row.samples_per_texel;
  told["rmse"] = row.error.rmse;
  told["bias"] = row.error.bias;
  told["p99"] = row.error.p99;
  told["max"] = row.error.largest;
  told["outside_share"] = row.outside_share;
  return told;
}

py::list describe_answer(const Answer& answer) {
  py::list lines;
  for (const AnswerGroup& group : answer.groups) {
    for (const AnswerLine& line : group.lines) {
      for (std::size_t a = 0; a < line.errors.size(); ++a) {
        py::dict told;
        told["ao"] = group.role;
        told["parameters"] = group.parameters;
        told["form"] = line.form;
        told["albedo"] = answer.albedos[a];
        told["rmse"] = line.errors[a].rmse;
        told["bias"] = line.errors[a].bias;
        told["outside_share"] = line.outside_share;
        lines.append(told);
      }
    }
  }
  return lines;
}

/// Albedos as single numbers, named as the quantities are.
std::vector<ComparedAlbedo> read_albedos(const std::vector<double>& albedos, const Surface& surface) {
  std::vector<ComparedAlbedo> compared;
  for (const double albedo : albedos) {
    if (!(albedo >= 0 && albedo <= 1))
      throw UsageError("albedo", std::to_string(albedo), "must be in [0, 1]");
    std::string label = std::to_string(albedo);
    label.erase(label.find_last_not_of('0') + 1);
    if (label.ends_with('.')) label.pop_back();
    compared.push_back({.label = label, .reflectance = TexelVector(surface.map.height.size(), albedo)});
  }
  if (compared.empty()) throw UsageError("albedo", "", "name at least one");
  return compared;
}

ComparedSky read_sky(const std::optional<Array<float>>& radiance) {
  if (!radiance) return {};
  if (radiance->ndim() != 3 || radiance->shape(2) != 3)
    throw UsageError("sky", "", "must have the shape rows × columns × 3");
  SkyLight sky{Image<Vector3>(static_cast<int>(radiance->shape(1)), static_cast<int>(radiance->shape(0)))};
  const float* value = radiance->data();
  for (Vector3& texel : sky.radiance.values) {
    texel = {value[0], value[1], value[2]};
    value += 3;
  }
  check_sky_light(sky);
  return {.quantity = "sky_irradiance", .label = "the sky given", .light = normalised(std::move(sky))};
}

py::tuple compare_surface(const Surface& surface, const Settings& settings, const std::vector<double>& albedo,
                          const std::vector<std::string>& forms, const std::optional<Array<float>>& sky,
                          int azimuths) {
  check_azimuths(azimuths);
  const Request request = make_request(settings);
  ComparisonOptions options{.albedos = read_albedos(albedo, surface),
                            .own_forms = read_user_forms(forms, {}),
                            .sky = read_sky(sky),
                            .azimuths = azimuths,
                            .memory = request.limits.memory,
                            .seed = request.accuracy.seed};
  PythonWatch watch(settings.progress);
  const std::unique_ptr<const ComparisonStudy> study = watch.run([&](const Watch& told) {
    const ThreadScope threads(settings.threads);
    options.watch = told;
    return std::make_unique<const ComparisonStudy>(surface, std::move(options));
  });
  py::list rows;
  for (const ComparisonRow& row : study->comparison.rows) rows.append(describe_row(row));
  return py::make_tuple(rows, describe_answer(study->answer));
}

}  // namespace

void add_compare(py::module_& module) {
  module.def("compare", compare_surface, py::arg("surface"), py::arg("settings"), py::arg("albedo"),
             py::arg("forms"), py::arg("sky"), py::arg("azimuths"));
}

}  // namespace heightlight
