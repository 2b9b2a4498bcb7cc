#include "terrain/terrain_study.h"

#include "heightlight/error.h"
#include "terrain/marched_quantities.h"

namespace heightlight {

std::uint64_t study_bytes_per_texel(std::size_t albedos) {
  return trial_bytes_per_texel(albedos) + march_bytes_per_texel(terrain_quantities().size());
}

TerrainStudy study_terrain(const Surface& surface, TrialOptions options) {
  if (surface.tiles())
    throw UsageError("boundary", "tile", "terrain is open: nothing lies beyond its borders");
  check_sun(options.sun);
  TerrainStudy study;
  study.options = std::move(options);
  const TerrainTruth truth = find_terrain_truth(surface, study.options.seed, study.options.watch);
  study.receivers = truth.receivers.size();
  if (study.receivers == 0) throw Error("no sample is present");
  study.trial = try_terrain_forms(surface, study.options);
  study.methods = compare_terrain_methods(surface, truth, study.options.watch);
  return study;
}

}  // namespace heightlight
