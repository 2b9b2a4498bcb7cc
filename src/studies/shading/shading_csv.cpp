#include "shading/shading_csv.h"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "files/output_file.h"

namespace heightlight {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

}  // namespace

double elevation_deg(const Vector3& view) {
  return kDegrees * std::atan2(double{view.z}, std::hypot(double{view.x}, double{view.y}));
}

void write_specular_csv(const std::filesystem::path& path, const SpecularStudy& study,
                        const std::vector<Vector3>& views) {
  write_file(path, [&](std::FILE* file) {
    fmt::print(file, "input,method,roughness,view_elevation_deg,rmse,bias,narrow_rmse\n");
    for (const SpecularRow& row : study.rows)
      fmt::print(file, "{},\"{}\",{:g},{:.4g},{:.6g},{:.6g},{:.6g}\n", row.input, row.method, row.roughness,
                 elevation_deg(views[row.view]), row.rmse, row.bias, row.narrow_rmse);
  });
}

void write_directional_csv(const std::filesystem::path& path, const DirectionalStudy& study) {
  write_file(path, [&](std::FILE* file) {
    fmt::print(file, "sky,truth,input,method,mrse,rmse,bias\n");
    for (const DirectionalRow& row : study.rows)
      fmt::print(file, "{},{},{},\"{}\",{:.6g},{:.6g},{:.6g}\n", row.sky,
                 row.as_harmonics ? "harmonics" : "function", row.input, row.method, row.mrse, row.rmse,
                 row.bias);
  });
}

void write_cone_forms_csv(const std::filesystem::path& path, const std::vector<ConeFormError>& forms) {
  write_file(path, [&](std::FILE* file) {
    fmt::print(file, "cone_deg,turn_deg,cone_error,product_error\n");
    for (const ConeFormError& form : forms)
      fmt::print(file, "{:.6g},{:.6g},{:.6g},{:.6g}\n", kDegrees * form.half_angle, kDegrees * form.turn,
                 form.by_cone, form.by_product);
  });
}

}  // namespace heightlight
