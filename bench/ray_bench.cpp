// Rays per second of our traversal and of Embree, in one process: the same mesh, the same rays, one thread.
// Choice of maps: brick has cliffs and deep joints, fBm has slopes at every scale, ground054 is a scanned
// material. `disagree` is the share of rays that one of the two calls blocked and the other does not. It
// excludes rays that our traversal ends at the receiver's own facets, which Embree's rays, started a little
// above, cannot hit.
#include <benchmark/benchmark.h>

#include <limits>
#include <vector>

#include "base/hash.h"
#include "bench_map.h"
#include "embree_mesh.h"
#include "visibility/ray_caster.h"

namespace heightlight {
namespace {

constexpr int kRays = 256;
constexpr int kReceivers = 2048;

struct Scene {
  Surface surface;
  RayCaster caster;
  EmbreeMesh mesh;

  explicit Scene(Heightmap map)
      : surface(build_surface(std::move(map))), caster(surface, {.rays = kRays, .seed = 1}), mesh(surface) {}

  using Aim = RayBundle (RayCaster::*)(int, int, const LatticeTurn&, RayWorkspace&) const;

  /// The rays of the i-th receiver. `aim` computes them with the bounds of our traversal, or for a peer
  /// without these bounds and their cost.
  RayBundle rays_of(int i, Aim aim, RayWorkspace& workspace) const {
    // Runs of 64 neighbours, the order in which a simulation traces them.
    const std::uint64_t texel =
        (scramble(static_cast<std::uint64_t>(i / 64)) + static_cast<std::uint64_t>(i % 64)) %
        surface.map.height.size();
    const int row = static_cast<int>(texel / static_cast<std::uint64_t>(surface.width()));
    const int column = static_cast<int>(texel % static_cast<std::uint64_t>(surface.width()));
    return (caster.*aim)(row, column, caster.directions().turn(row, column), workspace);
  }
};

RayEnds ends_of(RayWorkspace& workspace) {
  return {workspace.cell.data(), workspace.across.data(), workspace.down.data()};
}

/// Our traversal always finds the closest hit; occlusion is a by-product of it.
void trace_ours(benchmark::State& state, const Scene& scene,
                void (*traverse_rays)(const RayGrid&, const RayBundle&, const RayEnds&)) {
  RayWorkspace workspace(kRays);
  std::int64_t rays = 0;
  int i = 0;
  for (auto _ : state) {
    const RayBundle bundle = scene.rays_of(i++ % kReceivers, &RayCaster::aim, workspace);
    traverse_rays(scene.caster.grid(), bundle, ends_of(workspace));
    benchmark::DoNotOptimize(workspace.cell.data());
    rays += kRays;
  }
  state.counters["rays"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
}

bool is_own_facet(const RayWorkspace& workspace, std::size_t ray) {
  const bool upper = workspace.across[ray] == kTwoThirds && workspace.down[ray] == kOneThird;
  const bool lower = workspace.across[ray] == kOneThird && workspace.down[ray] == kTwoThirds;
  return upper || lower;
}

double disagreement(const Scene& scene) {
  alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RayWorkspace workspace(kRays);
  int compared = 0;
  int different = 0;
  for (int i = 0; i < kReceivers; ++i) {
    const RayBundle bundle = scene.rays_of(i, &RayCaster::aim, workspace);
    traverse(scene.caster.grid(), bundle, ends_of(workspace));
    for (int first = 0; first < kRays; first += 8) {
      alignas(32) RTCRayHit8 packet = scene.mesh.packet(bundle, first);
      rtcOccluded8(valid, scene.mesh.scene(), &context, reinterpret_cast<RTCRay8*>(&packet.ray));
      for (int lane = 0; lane < 8; ++lane) {
        const auto ray = static_cast<std::size_t>(first + lane);
        const bool blocked = workspace.cell[ray] != kSky;
        if (blocked && is_own_facet(workspace, ray)) continue;
        ++compared;
        different += blocked != (packet.ray.tfar[lane] < 0);
      }
    }
  }
  return static_cast<double>(different) / compared;
}

void trace_embree(benchmark::State& state, const Scene& scene, bool closest) {
  alignas(32) const int valid[8] = {-1, -1, -1, -1, -1, -1, -1, -1};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  RayWorkspace workspace(kRays);
  std::int64_t rays = 0;
  int i = 0;
  for (auto _ : state) {
    const RayBundle bundle = scene.rays_of(i++ % kReceivers, &RayCaster::aim_directions, workspace);
    for (int first = 0; first < kRays; first += 8) {
      alignas(32) RTCRayHit8 packet = scene.mesh.packet(bundle, first);
      if (closest) {
        rtcIntersect8(valid, scene.mesh.scene(), &context, &packet);
      } else {
        rtcOccluded8(valid, scene.mesh.scene(), &context, reinterpret_cast<RTCRay8*>(&packet.ray));
      }
      benchmark::DoNotOptimize(packet);
    }
    rays += kRays;
  }
  state.counters["rays"] = benchmark::Counter(static_cast<double>(rays), benchmark::Counter::kIsRate);
  state.counters["disagree"] = disagreement(scene);
}

void register_map(const std::string& name, int size) {
  std::optional<Heightmap> map = make_bench_map(name, size);
  if (!map) return;
  const auto scene = std::make_shared<Scene>(std::move(*map));
  const std::string label = name + "/" + std::to_string(size) + "/";
  const auto add = [&label](const std::string& method, auto run) {
    benchmark::RegisterBenchmark((label + method).c_str(), run)->MinTime(1.0);
  };
  add("heightlight", [scene](benchmark::State& state) { trace_ours(state, *scene, traverse); });
  add("embree_packet8_occlusion", [scene](benchmark::State& state) { trace_embree(state, *scene, false); });
  add("embree_packet8_closest", [scene](benchmark::State& state) { trace_embree(state, *scene, true); });
  add("heightlight_scalar", [scene](benchmark::State& state) { trace_ours(state, *scene, traverse_scalar); });
}

}  // namespace
}  // namespace heightlight

int main(int argument_count, char** arguments) {
  for (const char* name : {"brick", "fbm", "ground054"}) {
    for (const int size : {512, 1024}) heightlight::register_map(name, size);
  }
  benchmark::Initialize(&argument_count, arguments);
  if (benchmark::ReportUnrecognizedArguments(argument_count, arguments)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
