#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/surface.h"
#include "heightlight/transport.h"

namespace heightlight {

struct ReadAlbedo {
  Albedo albedo;
  std::string sha256 = {};  ///< of the file as it was read; empty where there was none
};

/// Reads `--albedo R`, `--albedo R,G,B`, `--albedo '#RRGGBB'` (sRGB) or `--albedo FILE`. A file has the map's
/// size; integer samples are decoded from sRGB, float samples are linear already; equal channels become one.
/// Throws UsageError for values outside [0, 1] or something that is neither, Error naming the file for one of
/// another size, with samples outside [0, 1] or NaN, or written to while it was read.
ReadAlbedo read_albedo(const std::string& text, const Heightmap& map, std::uint64_t memory_limit);

/// An albedo with as many channels as read_albedo will find at most, and without the values of a file. Throws
/// UsageError for values outside [0, 1].
Albedo announced_albedo(const std::string& text);

/// "0.2,0.5,0.8": albedos that are tried one by one, at most eight; nothing where the text is no list of
/// numbers. Throws UsageError for values outside [0, 1] or too many.
std::optional<std::vector<double>> parse_albedo_list(const std::string& text);

/// What of read_albedo can be told without a map. Throws UsageError for values outside [0, 1] or too few or
/// many of them, Error for a file that is not there.
void check_albedo(const std::string& text);

}  // namespace heightlight
