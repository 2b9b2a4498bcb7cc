#include "cli/bounce_sink.h"

#include <algorithm>

#include "cli/reach_options.h"
#include "cli/simulate_report.h"
#include "cli/simulation_files.h"
#include "files/saved_run.h"
#include "heightlight/error.h"
#include "plot/previews.h"

namespace heightlight {
namespace {

constexpr int kPreviewedBounces = 6;

MaximumDistance obscurance_maximum_distance(const SimulateOptions& options, const Surface& surface) {
  const double width = surface.map.spacing.x * surface.width();
  const double height = surface.map.spacing.y * surface.height();
  const MaximumDistance maximum_distance{.distance = parse_distance("obscurance", options.obscurance, width),
                                         .falloff = falloff_named(options.falloff)};
  if (surface.tiles() && maximum_distance.distance > std::min(width, height) / 2)
    throw UsageError("obscurance", options.obscurance,
                     "is more than half of the shorter side of a map that tiles");
  return maximum_distance;
}

}  // namespace

SimulationSink::SimulationSink(const Surface& surface, const Albedo& albedo, const SimulateOptions& options,
                               const MapFolder& output)
    : surface_(surface), albedo_(albedo), options_(options), output_(output) {
  if (!options.obscurance.empty()) maximum_distance_ = obscurance_maximum_distance(options, surface);
}

void SimulationSink::take_sky(const Map& ambient_occlusion, const Map& sky_view_factor) {
  alpha_.emplace(ambient_occlusion, AoKind::ambient_occlusion, options_.bins);
  sky_.emplace(sky_view_factor, AoKind::sky_view_factor, options_.bins);
}

void SimulationSink::take_links(const FormFactors& form_factors) {
  if (options_.save_links) write_form_factors(output_.folder.file("links.npz"), form_factors);
  if (maximum_distance_)
    write_transfer(output_, find_ambient_transfer(surface_, form_factors, *maximum_distance_, albedo_));
}

void SimulationSink::take_bounce(int b, const TexelVector& irradiance) {
  alpha_->add(irradiance);
  sky_->add(irradiance);
  if (b < kPreviewedBounces) first_.push_back(grey_picture(to_map(irradiance, surface_)));
  if (options_.report && b < kReportedBounces) {
    const Map bounce = to_map(irradiance, surface_);
    reported_.push_back(make_preview({&bounce}));
  }
  if (!options_.save_bounces) return;
  write_map(output_, std::filesystem::path(bounce_file(b)).stem().string(), to_map(irradiance, surface_),
            "E_b / pi at albedo 1, b = " + std::to_string(b));
}

void SimulationSink::take_tail(const TexelVector& tail) {
  alpha_->add_tail(tail);
  sky_->add_tail(tail);
}

std::uint64_t SimulationSink::bytes_per_texel() {
  constexpr std::uint64_t kOnItsWay = 2;  // a bounce that is written: as a map, and as the writer's samples
  return 2 * CurveBuilder::kBytesPerTexel + kOnItsWay * sizeof(Map::value_type);
}

}  // namespace heightlight
