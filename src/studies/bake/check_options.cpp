#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "bake/bake.h"
#include "bake/packed_texture.h"
#include "bake/texel_encoding.h"
#include "base/digits.h"
#include "heightlight/error.h"
#include "visibility/distance_table.h"

namespace heightlight {
namespace {

/// Of maps that a height's surroundings make.
void check_local_options(const BakeOptions& options) {
  if (!(options.normal_strength > 0) || !std::isfinite(options.normal_strength))
    throw UsageError("normal_strength", "", "must be a positive number");
  if (!(options.midlevel >= 0 && options.midlevel <= 1))
    throw UsageError("midlevel", in_digits(options.midlevel), "must be from 0 to 1");
  if (!options.detail_scale) return;
  if (!(*options.detail_scale >= 0) || !std::isfinite(*options.detail_scale))
    throw UsageError("detail_scale", "", "must be a length, or 0: the samples as they are");
  if (*options.detail_scale == 0 && is_wanted(options, MaterialMap::cavity))
    throw UsageError("detail_scale", "0", "leaves a cavity no surroundings");
}

}  // namespace

void check_bake_options(const BakeOptions& options) {
  const bool integer = largest_level(options.depth) > 0;
  if (options.maps.empty() && options.packed.empty()) throw UsageError("maps", "", "name at least one map");
  if (std::set<MaterialMap>(options.maps.begin(), options.maps.end()).size() != options.maps.size()) {
    throw UsageError("maps", "", "names a map twice");
  }
  if (options.format == TextureFormat::png && !integer) {
    throw UsageError("depth", "", "PNG holds 8 or 16 bits; the formats exr and tif hold floats");
  }
  if (options.format == TextureFormat::exr && integer) {
    throw UsageError("depth", "", "EXR holds half or float; the formats png and tif hold 8 and 16 bits");
  }
  if (options.format == TextureFormat::asc && options.depth != TextureDepth::real) {
    throw UsageError("depth", "",
                     "of an Esri grid is that of its numbers; the formats png and tif hold levels");
  }
  const bool has_cone =
      std::find(options.maps.begin(), options.maps.end(), MaterialMap::bent_cone) != options.maps.end();
  if (options.format == TextureFormat::asc && (has_cone || !options.packed.empty())) {
    throw UsageError("format", "asc", "holds one channel: bent cones and packed channels want another");
  }
  if (options.dither && options.depth != TextureDepth::uint8) {
    throw UsageError("dither", "", "only a depth of 8 bits needs it");
  }
  if (is_wanted(options, MaterialMap::direct) && options.light_channels == 0) {
    throw UsageError("maps", "",
                     "direct wants a light: a sun, a sky, or one of your own; an even sky's is ao");
  }
  if (is_wanted(options, MaterialMap::ao_n) && options.light_channels > 0) {
    throw UsageError("maps", "", "ao-n is of an even sky; bake it without a light of your own");
  }
  if (options.maximum_distance) check_maximum_distance(*options.maximum_distance);
  if (!(options.error > 0) || options.error > 1) {
    throw UsageError("error", std::to_string(options.error), "must be above 0, and 1 at most");
  }
  if (options.azimuths != 0) check_azimuths(options.azimuths);
  if (options.horizon_azimuths < 1 || options.horizon_azimuths > 360) {
    throw UsageError("horizon_azimuths", std::to_string(options.horizon_azimuths), "must be from 1 to 360");
  }
  if (options.below == BelowHorizontal::ground && is_wanted(options, MaterialMap::ao_n))
    throw UsageError("below_horizontal", "ground", "is not for ao-n, whose n is that of a sky all around");
  if (options.below == BelowHorizontal::ground && is_wanted(options, MaterialMap::specular_occlusion))
    throw UsageError("below_horizontal", "ground", "is not for specular-occlusion, whose sky is all around");
  check_gloss(options.gloss);
  check_view(options.view);
  check_packs(options);
  check_local_options(options);
}

}  // namespace heightlight
