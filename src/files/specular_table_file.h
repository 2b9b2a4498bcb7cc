#pragma once

#include <filesystem>

#include "heightlight/gloss.h"

namespace heightlight {

/// Writes a table as a KTX texture (version 1): three dimensions of 8 bits, GL_R8, side × side × side². The
/// layers run over √r first, then over θ_o; the key `heightlight` says so in words. Throws Error naming the
/// file.
void write_specular_table(const std::filesystem::path& path, const SpecularTable& table);

/// Reads a table that write_specular_table wrote. Throws Error naming the file and the fault: not a KTX
/// texture, a KTX texture of another kind, a size that no table has, or missing or surplus bytes.
SpecularTable read_specular_table(const std::filesystem::path& path);

}  // namespace heightlight
