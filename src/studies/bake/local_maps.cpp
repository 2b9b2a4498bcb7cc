#include "bake/local_maps.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "bake/material.h"
#include "base/percentile.h"
#include "base/texels.h"
#include "heightmap/gaussian_mean.h"
#include "heightmap/mean_curvature.h"

namespace heightlight {
namespace {

constexpr double kScaleShare = 0.0025;  // of the width

bool wants_curvature(const BakeOptions& options) {
  return is_wanted(options, MaterialMap::curvature) || is_wanted(options, MaterialMap::convexity) ||
         is_wanted(options, MaterialMap::concavity);
}

/// What all but one in 200 texels stay within, so that a few edges do not take all levels.
double usual_range(const Map& map) {
  constexpr double kShare = 0.995;
  std::vector<float> sizes;
  for (const float value : map.values) {
    if (!std::isnan(value)) sizes.push_back(std::fabs(value));
  }
  if (sizes.empty()) return 1;
  const double range = percentile(std::span<float>(sizes), kShare);
  return range > 0 ? range : 1;
}

}  // namespace

bool is_local(MaterialMap map) { return map >= MaterialMap::curvature && map <= MaterialMap::cavity; }

LocalMaps find_local_maps(const Surface& surface, const BakeOptions& options) {
  const bool has_curvature = wants_curvature(options);
  const bool has_cavity = is_wanted(options, MaterialMap::cavity);
  LocalMaps local;
  if (!has_curvature && !has_cavity) return local;
  const Heightmap& map = surface.map;
  local.scale = options.detail_scale.value_or(kScaleShare * map.spacing.x * map.height.width);
  const Image<double> mean = gaussian_mean(map, local.scale);
  if (has_curvature) {
    local.curvature = mean_curvature(mean, map.spacing, map.boundary);
    local.curvature_range = usual_range(local.curvature);
  }
  if (has_cavity) {
    local.cavity = Map(map.height.width, map.height.height);
    for_texels(local.cavity, [&](std::size_t i) {
      local.cavity.values[i] =
          static_cast<float>((double{map.height.values[i]} - mean.values[i]) / local.scale);
    });
    local.cavity_range = usual_range(local.cavity);
  }
  return local;
}

std::uint64_t kept_local_bytes(const BakeOptions& options) {
  const int maps = (wants_curvature(options) ? 1 : 0) + (is_wanted(options, MaterialMap::cavity) ? 1 : 0);
  return sizeof(Map::value_type) * static_cast<std::uint64_t>(maps);
}

std::uint64_t passing_local_bytes(const BakeOptions& options) {
  return kept_local_bytes(options) > 0 ? kGaussianMeanBytes : 0;
}

LengthUnit unit_of(DisplacementUnit unit) {
  return unit == DisplacementUnit::metre ? LengthUnit{"m", 1} : LengthUnit{"cm", 100};
}

}  // namespace heightlight
