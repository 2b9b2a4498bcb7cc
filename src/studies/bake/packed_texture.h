#pragma once

#include "bake/baked_map.h"

namespace heightlight {

/// Throws UsageError for a component that a map has not.
void check_packs(const BakeOptions& options);

/// The file of a pack; `material` and `options`, which its channels read, must outlive it.
BakedTexture packed_texture(const PackedTexture& pack, const Material& material, const BakeOptions& options);

}  // namespace heightlight
