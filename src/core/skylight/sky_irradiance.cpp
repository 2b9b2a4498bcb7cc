#include <algorithm>
#include <cmath>
#include <optional>

#include "base/hash.h"
#include "base/texel_algebra.h"
#include "heightlight/sky_light.h"
#include "skylight/sky_slices.h"
#include "visibility/exact_walk.h"
#include "visibility/horizon_sky.h"
#include "visibility/walk_route.h"

namespace heightlight {
namespace {

constexpr int kFewestSkyAzimuths = 64;
constexpr int kMostSkyAzimuths = 512;
constexpr int kReferenceAzimuths = 1024;
constexpr int kSkyReceivers = 128;
constexpr WalkOptions kSkyWalk{.samples_per_octave = 32};

/// What a thread needs to walk tile after tile.
struct SkyWorkspace {
  WalkTile tile;
  SkySums sums;
  FarView far;
  std::array<Eigen::Vector3d, WalkTile::kTexels> received;
  std::array<double, WalkTile::kTexels> hemisphere;
};

bool is_grey(const SkyLight& sky) {
  return std::all_of(sky.radiance.values.begin(), sky.radiance.values.end(),
                     [](const Vector3& value) { return value.x == value.y && value.y == value.z; });
}

/// Walks one azimuth from all receivers of the tile, and adds the irradiance from its slice.
void add_azimuth(const RouteAzimuth& azimuth, const SkySlices& slices, std::size_t k, SkyWorkspace& work) {
  look_far(work.tile, azimuth.table, work.far);
  walk_sky(work.tile, azimuth.table, work.far, work.sums);
  for_present(work.tile, [&](std::size_t at, int, int) {
    const double tangent = double{work.tile.slope_x[at]} * double{azimuth.table.world_x} +
                           double{work.tile.slope_y[at]} * double{azimuth.table.world_y};
    const double up = double{work.tile.normal_z[at]};
    const SliceNormal in_slice{-up * tangent, up};
    work.hemisphere[at] += cosine_mass(in_slice, elevation_of_slope(tangent), Elevation{});
    work.received[at] += slices.from_slice(k, in_slice, std::atan(double{work.sums.slope[at]}));
  });
}

void walk_sky_light(const Surface& surface, const HeightPyramid& pyramid, const SkySlices& slices,
                    const Watch& watch, SkyIrradiance& found) {
  WalkOptions options = kSkyWalk;
  options.azimuths = found.azimuths;
  const Route route = plan_route(surface, options, walked_azimuths(options), std::nullopt);
  const std::vector<TileFrame> tiles = all_tiles(surface);
  const RouteStep step{.route = route, .tiles = tiles, .label = "light of the sky", .watch = watch};
  for_tiles<SkyWorkspace>(surface, pyramid, options, step, [&](SkyWorkspace& work, std::size_t) {
    work.sums.keep_slope = true;
    work.sums.clear();
    work.received.fill(Eigen::Vector3d::Zero());
    work.hemisphere.fill(0);
    for (std::size_t k = 0; k < route.azimuths.size(); ++k) add_azimuth(route.azimuths[k], slices, k, work);
    for_present(work.tile, [&](std::size_t at, int row, int column) {
      const Eigen::Vector3d light = work.received[at] / work.hemisphere[at];
      for (std::size_t c = 0; c < found.channels.size(); ++c)
        found.channels[c][surface.map.height.index(row, column)] = light[static_cast<Eigen::Index>(c)];
    });
  });
}

/// A receiver, and its E/π by exact horizons.
struct SkyReference {
  std::size_t texel = 0;
  Eigen::Vector3d light;
};

std::vector<SkyReference> find_references(const Surface& surface, const SkyLight& sky,
                                          const SkyAccuracy& accuracy) {
  const ExactWalker walker(surface, kReferenceAzimuths);
  const SkySlices slices(sky, kReferenceAzimuths);
  std::vector<std::optional<SkyReference>> found(kSkyReceivers);
  Progress progress("check of the sky's light", kSkyReceivers, accuracy.watch);
  parallel_for(
      kSkyReceivers,
      [&](std::int64_t i) {
        const std::uint64_t pick = hash_combine(accuracy.seed + 3, static_cast<std::uint64_t>(i));
        const std::size_t texel = pick % surface.map.height.size();
        if (std::isnan(surface.map.height.values[texel])) return;
        const auto width = static_cast<std::size_t>(surface.width());
        const auto row = static_cast<int>(texel / width);
        const auto column = static_cast<int>(texel % width);
        std::vector<double> horizons;
        for (int k = 0; k < walker.azimuths(); ++k)
          horizons.push_back(walker.horizon_rad(row, column, walker.azimuth_rad(k)));
        const Eigen::Vector3d normal = as_eigen(surface.normal(row, column)).cast<double>().normalized();
        found[static_cast<std::size_t>(i)] = {texel, slices.irradiance(normal, horizons)};
      },
      &progress);
  std::vector<SkyReference> references;
  for (const std::optional<SkyReference>& reference : found) {
    if (reference) references.push_back(*reference);
  }
  return references;
}

/// RMSE of E/π in the channel with the largest error.
double sky_light_rmse(const std::vector<SkyReference>& references, const std::vector<TexelVector>& channels) {
  if (references.empty()) return 0;
  double largest = 0;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    double squares = 0;
    for (const SkyReference& reference : references) {
      const double error = channels[c][reference.texel] - reference.light[static_cast<Eigen::Index>(c)];
      squares += error * error;
    }
    largest = std::max(largest, squares);
  }
  return std::sqrt(largest / static_cast<double>(references.size()));
}

}  // namespace

SkyIrradiance sky_irradiance(const Surface& surface, const SkyLight& sky, const SkyAccuracy& accuracy) {
  check_sky_light(sky);
  if (accuracy.azimuths != 0) check_azimuths(accuracy.azimuths);
  const HeightPyramid pyramid = build_height_pyramid(surface);
  const std::vector<SkyReference> references = find_references(surface, sky, accuracy);
  SkyIrradiance found;
  found.channels.resize(is_grey(sky) ? 1 : 3, TexelVector(surface.map.height.size()));
  found.azimuths = accuracy.azimuths > 0 ? accuracy.azimuths : kFewestSkyAzimuths;
  for (;; found.azimuths *= 2) {
    walk_sky_light(surface, pyramid, SkySlices(sky, found.azimuths), accuracy.watch, found);
    found.rmse = sky_light_rmse(references, found.channels);
    const bool good = found.rmse <= accuracy.error || found.azimuths >= kMostSkyAzimuths;
    if (good || accuracy.azimuths > 0) return found;
  }
}

std::uint64_t sky_irradiance_bytes(const Surface& surface, const SkyLight& sky) {
  return height_pyramid_bytes(surface.width(), surface.height()) +
         maximum_pyramid_bytes(surface.width(), surface.height()) + SkySlices::bytes(sky, kReferenceAzimuths);
}

}  // namespace heightlight
