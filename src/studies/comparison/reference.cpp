#include "comparison/reference.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/byte_size.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "heightlight/error.h"
#include "skylight/sky_slices.h"
#include "visibility/exact_walk.h"
#include "visibility/ray_caster.h"

namespace heightlight {
namespace {

constexpr int kCheckedReceivers = 256;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr double kTotalError = 0.001;  // wanted of the totals

void walk_all(const Surface& surface, const ReferenceOptions& options, ComparisonReference& reference) {
  const Stopwatch watch;
  const ExactWalker walker(surface, options.azimuths);
  reference.azimuths = options.azimuths;
  const SkySlices sky(options.sky.light, options.azimuths);
  reference.ambient_occlusion = reference.sky_view_factor = Map(surface.width(), surface.height());
  reference.bent_normal = reference.sky_light = Image<Vector3>(surface.width(), surface.height());
  Progress progress("reference", surface.height(), options.watch);
  parallel_for(
      surface.height(),
      [&](std::int64_t i) {
        const int row = static_cast<int>(i);
        SliceView view;
        for (int column = 0; column < surface.width(); ++column) {
          walker.view(row, column, view);
          const Eigen::Vector3d normal = as_eigen(surface.normal(row, column)).cast<double>();
          reference.ambient_occlusion(row, column) = static_cast<float>(view.ambient_occlusion);
          reference.sky_view_factor(row, column) = static_cast<float>(view.sky_view_factor);
          reference.bent_normal(row, column) = to_vector3(view.bent_normal.cast<float>());
          reference.sky_light(row, column) =
              view.horizon_rad.empty() ? Vector3{kNaN, kNaN, kNaN}
                                       : to_vector3(sky.irradiance(normal, view.horizon_rad).cast<float>());
        }
      },
      &progress);
  reference.cost = watch.elapsed();
}

struct CheckedReceiver {
  bool present = false;
  double sky = 0;
  double bent_deg = 0;
  double rays = 0;
};

CheckedReceiver check_receiver(const ExactWalker& walker, const RayCaster& caster,
                               const ComparisonReference& reference, int row, int column) {
  SliceView view;
  walker.view(row, column, view);
  if (std::isnan(view.sky_view_factor)) return {};
  const double sky = double{reference.sky_view_factor(row, column)};
  const Eigen::Vector3d bent = as_eigen(reference.bent_normal(row, column)).cast<double>();
  RayWorkspace workspace(caster.rays());
  ReceiverView rays;
  caster.view(row, column, workspace, rays);
  CheckedReceiver checked;
  checked.present = true;
  checked.sky = sky - view.sky_view_factor;
  checked.bent_deg =
      std::atan2(bent.cross(view.bent_normal).norm(), bent.dot(view.bent_normal)) * 180 / std::numbers::pi;
  checked.rays = sky - sky_share(rays).sky_view_factor;
  return checked;
}

/// What the walks err by, on a sample of receivers.
void check_walks(const Surface& surface, const ReferenceOptions& options, ComparisonReference& reference) {
  const ExactWalker walker(surface, kCheckAzimuths);
  const RayCaster caster(surface, {.rays = kCheckRays, .seed = options.seed});
  std::vector<CheckedReceiver> receivers(kCheckedReceivers);
  parallel_for(kCheckedReceivers, [&](std::int64_t i) {
    const std::uint64_t pick = hash_combine(options.seed + 7, static_cast<std::uint64_t>(i));
    const auto texel = static_cast<int>(pick % surface.map.height.size());
    receivers[static_cast<std::size_t>(i)] =
        check_receiver(walker, caster, reference, texel / surface.width(), texel % surface.width());
  });
  for (const CheckedReceiver& receiver : receivers) {
    if (!receiver.present) continue;
    ++reference.checked;
    reference.sky_rmse += receiver.sky * receiver.sky;
    reference.bent_rmse_deg += receiver.bent_deg * receiver.bent_deg;
    reference.ray_rmse += receiver.rays * receiver.rays;
  }
  if (reference.checked == 0) return;
  for (double* squares : {&reference.sky_rmse, &reference.bent_rmse_deg, &reference.ray_rmse}) {
    *squares = std::sqrt(*squares / reference.checked);
  }
}

void find_totals(const Surface& surface, const ReferenceOptions& options, ComparisonReference& reference) {
  const Stopwatch watch;
  Request request;
  for (const ComparedAlbedo& albedo : options.albedos) request.wanted.totals.push_back(albedo.albedo());
  request.wanted.seen = true;
  request.accuracy = {.error = kTotalError, .seed = options.seed};
  request.limits.memory = options.memory;
  request.watch = options.watch;
  Results results = solve(surface, request);
  reference.total_cost = watch.elapsed();
  reference.total_evidence = results.evidence;
  for (const std::vector<TexelVector>& channels : results.totals) {
    reference.totals.push_back(to_map(channels[0], surface));
  }
  reference.seen = std::move(results.seen);
}

}  // namespace

ComparisonReference build_reference(const Surface& surface, const ReferenceOptions& options) {
  check_azimuths(options.azimuths);
  const std::uint64_t slices = SkySlices::bytes(options.sky.light, options.azimuths);
  if (slices > options.memory)
    throw MemoryError("the sky along " + std::to_string(options.azimuths) + " azimuths takes " +
                          format_byte_size(slices) + ", more than the " + format_byte_size(options.memory) +
                          " of memory allowed",
                      slices - options.memory, write_enough(slices));
  ComparisonReference reference;
  reference.sky = options.sky;
  walk_all(surface, options, reference);
  check_walks(surface, options, reference);
  find_totals(surface, options, reference);
  return reference;
}

}  // namespace heightlight
