#pragma once

#include <string>
#include <vector>

#include "files/staged_output.h"
#include "heightlight/solve.h"
#include "heightlight/surface.h"

namespace heightlight {

/// Names of all files that `simulate` may write: those of `bounces` bounces among them, kept apart or not,
/// since what an earlier run kept is the next one's.
std::vector<std::string> simulation_file_names(int bounces);

/// One float map, channel Y; `meaning` goes into its header. Throws OutputError.
void write_map(StagedFolder& folder, const std::string& name, const Map& map, const std::string& meaning);

/// `irradiance_total.exr`: one map, Y, or three, R, G, B. Throws OutputError.
void write_totals(StagedFolder& folder, const std::vector<Map>& totals);

/// `obscurance.exr` and `ambient_transfer.exr`. Throws OutputError.
void write_transfer(StagedFolder& folder, const AmbientTransfer& found);

/// `ambient_occlusion.exr` and `sky_view_factor.exr`. Throws OutputError.
void write_occlusion(StagedFolder& folder, const Results& results);

/// The previews. Throws OutputError.
void write_pictures(StagedFolder& folder, const Surface& surface, const Results& results,
                    const std::vector<Map>& first_bounces, const std::vector<Map>& totals);

}  // namespace heightlight
