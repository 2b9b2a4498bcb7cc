#pragma once

#include <filesystem>

#include "heightlight/gloss.h"

namespace heightlight {

/// Writes a table as a KTX texture (version 1): three dimensions of 8 bits, GL_R8, side × side × side², whose
/// layers run over √r first, then over θ_o. Its key `heightlight` says so in words. Throws Error naming the
/// file.
void write_specular_table(const std::filesystem::path& path, const SpecularTable& table);

/// Reads one back. Throws Error naming the file and what is wrong: no KTX texture, one of another kind, a
/// size that is no table's, or bytes that are missing or too many.
SpecularTable read_specular_table(const std::filesystem::path& path);

}  // namespace heightlight
