#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/area_mean.h"
#include "heightlight/error.h"
#include "heightlight/surface.h"
#include "relief/match_judgement.h"
#include "relief/match_relief.h"

namespace heightlight {
namespace {

/// Slopes along x and y, and what they count.
struct Slopes {
  Map x;
  Map y;
  Map weight;
};

Slopes slopes_of(const Image<Vector3>& normals) {
  constexpr float kSteepest = 1e-3F;  // n_z of a vector that lies flat or points down
  Slopes slopes{Map(normals.width, normals.height), Map(normals.width, normals.height),
                Map(normals.width, normals.height)};
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vector3& n = normals.values[i];
    const float z = std::isnan(n.z) ? n.z : std::max(n.z, kSteepest);
    slopes.x.values[i] = -n.x / z;
    slopes.y.values[i] = -n.y / z;
    slopes.weight.values[i] = z * z * z * z;
  }
  return slopes;
}

Slopes on_grid(const Slopes& slopes, int width, int height) {
  return {area_mean(slopes.x, width, height), area_mean(slopes.y, width, height),
          area_mean(slopes.weight, width, height)};
}

/// Weighted sums of two slopes' products, where both are known.
struct Products {
  double own = 0;    ///< ours by ours
  double given = 0;  ///< theirs by theirs
  double mixed = 0;

  void add(float ours, float theirs, double weight) {
    own += weight * double{ours} * double{ours};
    given += weight * double{theirs} * double{theirs};
    mixed += weight * double{ours} * double{theirs};
  }
};

bool is_known(const Slopes& ours, const Slopes& theirs, std::size_t i) {
  return !std::isnan(ours.x.values[i]) && !std::isnan(theirs.x.values[i]);
}

/// Angle between the normals of slopes, ours times `scale`.
double angle_between(double x, double y, double given_x, double given_y) {
  const double cosine = (x * given_x + y * given_y + 1) /
                        std::sqrt((x * x + y * y + 1) * (given_x * given_x + given_y * given_y + 1));
  return std::acos(std::clamp(cosine, -1.0, 1.0));
}

double rms_angle_deg(const Slopes& ours, const Slopes& theirs, double scale, double y_sign) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < ours.x.size(); ++i) {
    if (!is_known(ours, theirs, i)) continue;
    const double angle = angle_between(scale * double{ours.x.values[i]}, scale * double{ours.y.values[i]},
                                       double{theirs.x.values[i]}, y_sign * double{theirs.y.values[i]});
    sum += angle * angle;
    ++count;
  }
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(count, 1))) * 180 / std::numbers::pi;
}

}  // namespace

ReliefMatch match_normals(const Heightmap& map, const Image<Vector3>& normals) {
  refuse_level_match(map);
  const int width = std::min(map.height.width, normals.width);
  const int height = std::min(map.height.height, normals.height);
  const Slopes ours = on_grid(slopes_of(build_surface(map).normal), width, height);
  const Slopes theirs = on_grid(slopes_of(normals), width, height);
  Products x;
  Products y;
  for (std::size_t i = 0; i < ours.x.size(); ++i) {
    if (!is_known(ours, theirs, i)) continue;
    const double weight = double{theirs.weight.values[i]};
    x.add(ours.x.values[i], theirs.x.values[i], weight);
    y.add(ours.y.values[i], theirs.y.values[i], weight);
  }
  const double y_sign = y.mixed < 0 ? -1 : 1;
  const double mixed = x.mixed + y_sign * y.mixed;
  if (x.mixed < 0 && std::fabs(x.mixed) > 0.1 * std::sqrt(x.own * x.given))
    throw UsageError("match", "",
                     "its normals slope the other way: the heights are depths, which are to be inverted");
  const double scale = mixed / (x.own + y.own);
  ReliefMatch match{.relief = scale * relief(map),
                    .residual = rms_angle_deg(ours, theirs, scale, y_sign),
                    .correlation = mixed / std::sqrt((x.own + y.own) * (x.given + y.given)),
                    .y_down = y_sign < 0};
  if (!(match.relief > 0)) throw UsageError("match", "", "its normals have nothing of the heights' slopes");
  if (match.correlation < kPoorMatch)
    match.doubt = "the normals are not those of these heights at any relief";
  return match;
}

}  // namespace heightlight
