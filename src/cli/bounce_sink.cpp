#include "cli/bounce_sink.h"

#include <cstdio>

#include "cli/simulation_files.h"
#include "core/stopwatch.h"
#include "heightlight/models.h"

namespace heightlight {
namespace {

constexpr int kPreviewedBounces = 6;

}  // namespace

BounceSink::BounceSink(const Transport& transport, const Surface& surface, const SimulateOptions& options,
                       StagedFolder& folder)
    : surface_(surface),
      options_(options),
      folder_(folder),
      sky_view_factor_(transport.sky_view_factor),
      alpha_(transport.ambient_occlusion, AoKind::ambient_occlusion, options.bins),
      sky_(transport.sky_view_factor, AoKind::sky_view_factor, options.bins) {
  seen_.expected = expected_seen(transport.sky_view_factor, surface).value;
}

void BounceSink::take(int b, const TexelVector& irradiance) {
  Stopwatch watch;
  alpha_.add(irradiance);
  sky_.add(irradiance);
  seconds_ += watch.lap();
  if (b == 1) seen_.mean = measured_seen(sky_view_factor_, irradiance, surface_).value;
  if (b < kPreviewedBounces) first_.push_back(to_map(irradiance, surface_));
  if (!options_.save_bounces) return;
  char name[32];
  std::snprintf(name, sizeof name, "irradiance_%02d.exr", b);
  write_map(folder_, name, to_map(irradiance, surface_), "E_b / pi at albedo 1, b = " + std::to_string(b));
}

void BounceSink::take_tail(const TexelVector& tail) {
  alpha_.add_tail(tail);
  sky_.add_tail(tail);
}

}  // namespace heightlight
