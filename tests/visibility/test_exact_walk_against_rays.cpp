#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "heightlight/files.h"
#include "shared_data.h"
#include "test_maps.h"
#include "visibility/exact_walk.h"
#include "visibility/ray_caster.h"

// The rays, which share nothing with the walk but the mesh, are its measure. 65536 of them err by 4·10⁻⁵ to
// 1.2·10⁻⁴: so far they are from 4096 azimuths on the maps below. 512 azimuths are as near on surfaces that
// are continuous in the eyes of a receiver, where the quadrature adds nothing that shows.

namespace heightlight {
namespace {

constexpr int kReceivers = 64;
constexpr int kRays = 65536;

struct Rmse {
  double sky_view_factor = 0;
  double ambient_occlusion = 0;
  double gathered = 0;
};

/// A smooth function of the place that is seen, with a period of the map's size and of order 1.
double smooth_field(const Surface& surface, const SurfacePoint& place) {
  const auto cell = static_cast<int>(place.cell);
  const double u = (cell % surface.width() + double{place.across}) / surface.width();
  const double v = (cell / surface.width() + double{place.down}) / surface.height();
  return 0.5 + 0.25 * std::sin(2 * std::numbers::pi * (2 * u + v)) +
         0.25 * std::cos(2 * std::numbers::pi * (3 * v - u));
}

/// Root mean square difference between the walk and rays over receivers spread over the map by a hash.
Rmse compare_with_rays(const Surface& surface, int azimuths) {
  const ExactWalker walker(surface, azimuths);
  const RayCaster caster(surface, {.rays = kRays, .seed = 1});
  std::vector<Rmse> squared(kReceivers);
  parallel_for(kReceivers, [&](std::int64_t i) {
    std::uint64_t texel = static_cast<std::uint64_t>(i);
    do {
      texel = scramble(texel);
    } while (std::isnan(surface.map.height.values[texel % surface.map.height.size()]));
    texel %= surface.map.height.size();
    const int row = static_cast<int>(texel) / surface.width();
    const int column = static_cast<int>(texel) % surface.width();
    SliceView view;
    walker.view(row, column, view);
    RayWorkspace workspace(kRays);
    ReceiverView rays;
    caster.view(row, column, workspace, rays);
    const SkyShare sky = sky_share(rays);
    double gathered = 0;
    for (const VisibleInterval& link : view.links)
      gathered += link.weight * smooth_field(surface, link.place);
    for (std::size_t k = 0; k < rays.ray.size(); ++k) {
      gathered -= rays.weight[rays.ray[k]] * smooth_field(surface, rays.place[k]);
    }
    squared[static_cast<std::size_t>(i)] = {std::pow(view.sky_view_factor - sky.sky_view_factor, 2),
                                            std::pow(view.ambient_occlusion - sky.ambient_occlusion, 2),
                                            gathered * gathered};
  });
  Rmse sum;
  for (const Rmse& one : squared) {
    sum.sky_view_factor += one.sky_view_factor / kReceivers;
    sum.ambient_occlusion += one.ambient_occlusion / kReceivers;
    sum.gathered += one.gathered / kReceivers;
  }
  return {std::sqrt(sum.sky_view_factor), std::sqrt(sum.ambient_occlusion), std::sqrt(sum.gathered)};
}

void check_against_rays(const Surface& surface, int azimuths) {
  const Rmse rmse = compare_with_rays(surface, azimuths);
  INFO("A " << rmse.sky_view_factor << ", alpha " << rmse.ambient_occlusion << ", gathered "
            << rmse.gathered);
  CHECK(rmse.sky_view_factor < 3e-4);
  CHECK(rmse.ambient_occlusion < 3e-4);
  CHECK(rmse.gathered < 3e-4);
}

TEST_CASE("512 azimuths match 65536 rays on synthetic maps", "[visibility][exact][slow]") {
  const auto [shape, boundary, relief] =
      GENERATE(table<const char*, Boundary, double>({{"brick", Boundary::tile, 0.1},
                                                     {"brick", Boundary::open, 0.5},
                                                     {"bowl", Boundary::open, 0.25},
                                                     {"fbm", Boundary::tile, 0.1},
                                                     {"cobbles", Boundary::tile, 0.2}}));
  CAPTURE(shape);
  check_against_rays(build_surface(make_synth_map(shape, 128, boundary, relief)), 512);
}

TEST_CASE("azimuths are uniform in the world where texels are not square", "[visibility][exact][slow]") {
  Heightmap map = make_synth_map("fbm", 96, Boundary::tile, 0.2);
  map.spacing.y *= 2.5;
  check_against_rays(build_surface(std::move(map)), 512);
}

TEST_CASE("holes and their edges are for the walk what they are for rays", "[visibility][exact][slow]") {
  // Every cell is a cliff or a hole: the outline jumps from azimuth to azimuth, so that more of them are
  // needed.
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  check_against_rays(build_surface(make_rough_map(64, 64, boundary, 0.1, 0.3, 5)), 2048);
}

/// Every `step`-th sample of a map along both axes.
Heightmap decimate(const Heightmap& map, int step) {
  Heightmap coarse = map;
  coarse.height = Image<float>(map.height.width / step, map.height.height / step);
  coarse.spacing = {map.spacing.x * step, map.spacing.y * step};
  for (int row = 0; row < coarse.height.height; ++row) {
    for (int column = 0; column < coarse.height.width; ++column) {
      coarse.height(row, column) = map.height(row * step, column * step);
    }
  }
  return coarse;
}

TEST_CASE("512 azimuths match 65536 rays on real maps", "[visibility][exact][shared][slow]") {
  const auto [name, step, texel] =
      GENERATE(table<std::string, int, double>({{"material/Ground054_height16.png", 4, 0},
                                                {"material/MetalWalkway006_height16.png", 4, 0},
                                                {"terrain/lakes_dem.tif", 1, 50}}));
  CAPTURE(name);
  const auto path = find_shared_data(name);
  if (!path) return;
  LoadOptions options;
  if (texel > 0) {
    options.texel = Spacing{texel, texel};
    options.boundary = Boundary::open;
  }
  const Heightmap map = load_heightmap(*path, options, std::uint64_t{1} << 30).map;
  check_against_rays(build_surface(decimate(map, step)), 512);
}

}  // namespace
}  // namespace heightlight
