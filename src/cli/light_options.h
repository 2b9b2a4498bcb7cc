#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "heightlight/sun.h"
#include "heightlight/surface.h"
#include "heightlight/watch.h"

namespace heightlight {

/// What sends the first light, as text until it is read; empty: an even sky all around.
struct LightOptions {
  std::filesystem::path direct;
  std::string sun;
  std::string sky;
};

/// "135,30" or "135,30,0.5": azimuth clockwise from north, elevation and diameter, in degrees. Throws
/// UsageError for anything else.
Sun parse_sun(const std::string& text);

/// Adds `--direct --sun --sky`, of which one may be given.
void add_light_options(CLI::App& command, LightOptions& options);

/// Whether there is another light than an even sky.
bool has_own_light(const LightOptions& options);

/// Files that it is read from; names that lead nowhere are no files.
std::vector<std::filesystem::path> light_files(const LightOptions& options);

/// Throws UsageError for what no map can be lit with, Error for a file that is not there.
void check_light_options(const LightOptions& options);

/// Channels that it will have, 1 or 3, by the headers of files. Throws Error naming one that cannot be read.
std::size_t count_light_channels(const LightOptions& options);

/// A light as one text that changes whenever the light does: with checksums of files in place of names; empty
/// for an even sky. Throws Error naming a file that cannot be read.
std::string light_key(const LightOptions& options);

/// What finding a light may use.
struct LightLimits {
  double error = 0.002;  ///< RMSE wanted of E₀/π under skies
  std::uint64_t seed = 1;
  std::uint64_t memory = 0;  ///< bytes
  Watch watch = {};
};

/// Direct light of one's own, E₀/π per texel.
struct DirectIrradiance {
  std::vector<TexelVector> channels;  ///< as many as were counted; none of an even sky
  std::string description;            ///< "sun at 135, 30 degrees"
  double rmse = 0;                    ///< of a sky's, against exact horizons
};

/// Finds it. Throws Error naming a file and what is wrong, MemoryError, UsageError as check_light_options.
DirectIrradiance find_direct_irradiance(const LightOptions& options, const Surface& surface,
                                        const LightLimits& limits);

}  // namespace heightlight
