#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/files.h"
#include "shared_data.h"
#include "test_maps.h"
#include "transport/exact_gather.h"
#include "transport/simulated.h"
#include "visibility/ray_caster.h"

// The last gather of the light decides what a receiver's total is: exact slices along 512 azimuths against
// 65536 rays, over the same field of light, on maps of every kind.

namespace heightlight {
namespace {

constexpr double kAlbedo = 0.8;
constexpr int kReceivers = 64;

/// A real map, every n-th sample of it.
std::optional<Heightmap> real_map(const char* name, const LoadOptions& options, int n) {
  const auto path = find_shared_data(name);
  if (!path) return std::nullopt;
  Heightmap map = load_heightmap(*path, options, std::uint64_t{1} << 32).map;
  Image<float> taken(map.height.width / n, map.height.height / n);
  for (int row = 0; row < taken.height; ++row) {
    for (int column = 0; column < taken.width; ++column) taken(row, column) = map.height(row * n, column * n);
  }
  map.height = taken;
  map.spacing = {map.spacing.x * n, map.spacing.y * n};
  return map;
}

std::optional<Heightmap> named_map(const std::string& name) {
  if (name == "brick") return make_synth_map("brick", 256, Boundary::tile, 0.1);
  if (name == "deep bowl") return make_synth_map("bowl", 256, Boundary::open, 0.5);
  if (name == "Ground054") return real_map("material/Ground054_height16.png", {}, 4);
  if (name == "MetalWalkway006") return real_map("material/MetalWalkway006_height16.png", {}, 4);
  LoadOptions terrain;
  terrain.texel = Spacing{50, 50};
  terrain.boundary = Boundary::open;
  return real_map("terrain/lakes_dem.tif", terrain, 1);
}

/// What an exact walk saw sends.
double gather_radiosity(const SliceView& view, const Surface& surface, const TexelVector& radiosity) {
  return gather_exactly(view, surface, [&](std::size_t texel) { return radiosity[texel]; });
}

/// A and what the surface sends, by 65536 rays.
struct RayView {
  double sky = 0;
  double gathered = 0;
};

RayView cast(const RayCaster& caster, const Surface& surface, const TexelVector& radiosity, int row,
             int column) {
  RayWorkspace workspace(caster.rays());
  ReceiverView view;
  caster.view(row, column, workspace, view);
  SliceView as_slices;
  for (std::size_t hit = 0; hit < view.ray.size(); ++hit) {
    as_slices.links.push_back({view.weight[view.ray[hit]], view.place[hit]});
  }
  return {sky_share(view).sky_view_factor, gather_radiosity(as_slices, surface, radiosity)};
}

TEST_CASE("512 exact azimuths see the light that 65536 rays see: A to 3e-4, the total to 1e-3",
          "[transport][slow]") {
  const std::string name = GENERATE("brick", "Ground054", "MetalWalkway006", "lakes_dem", "deep bowl");
  const std::optional<Heightmap> map = named_map(name);
  if (!map) return;
  const Surface surface = build_surface(*map);
  const PlannedTransport planned = plan_horizon_transport(surface, {.error = 0.002});
  const TexelVector light = total_of(*planned.transport, kAlbedo);
  const TexelVector radiosity = to_texels(kAlbedo * as_eigen(light));
  const ExactWalker walker(surface, 512);
  const RayCaster caster(surface, {.rays = 65536, .seed = 5});
  std::vector<double> sky(kReceivers);
  std::vector<double> total(kReceivers);
  parallel_for(kReceivers, [&](std::int64_t i) {
    const auto at = static_cast<std::size_t>(i);
    const std::uint64_t texel = scramble(static_cast<std::uint64_t>(i) + 77) % surface.map.height.size();
    const int row = static_cast<int>(texel / static_cast<std::uint64_t>(surface.width()));
    const int column = static_cast<int>(texel % static_cast<std::uint64_t>(surface.width()));
    SliceView view;
    walker.view(row, column, view);
    const RayView rays = cast(caster, surface, radiosity, row, column);
    sky[at] = view.sky_view_factor - rays.sky;
    total[at] = sky[at] + gather_radiosity(view, surface, radiosity) - rays.gathered;
  });
  double sky_squares = 0;
  double total_squares = 0;
  for (std::size_t i = 0; i < kReceivers; ++i) {
    sky_squares += sky[i] * sky[i];
    total_squares += total[i] * total[i];
  }
  INFO(name << ": RMSE of A " << std::sqrt(sky_squares / kReceivers) << ", of the total "
            << std::sqrt(total_squares / kReceivers));
  // Monte Carlo and discretisation: of the rays, 1e-4 at 65536 of them, and of the azimuths
  CHECK(std::sqrt(sky_squares / kReceivers) < 3e-4);
  CHECK(std::sqrt(total_squares / kReceivers) < 1e-3);
}

}  // namespace
}  // namespace heightlight
