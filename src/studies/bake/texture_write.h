#pragma once

#include <filesystem>

#include "bake/texel_encoding.h"
#include "bake/texture_files.h"

namespace heightlight {

/// With its point.
const char* extension_of(TextureFormat format);

/// The values of a texture's channels, row by row of `width` texels. The texture must outlive them.
FillRows values_of(const BakedTexture& texture, int width);

/// Writes one file: the values as `encoding` has them, with what they mean, at the map's place. Throws Error
/// where that cannot be.
void write_baked(const std::filesystem::path& path, const BakedTexture& texture, const FillRows& values,
                 const TexelEncoding& encoding, const BakedMap& map);

}  // namespace heightlight
