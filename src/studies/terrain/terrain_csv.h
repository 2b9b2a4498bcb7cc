#pragma once

#include <filesystem>
#include <vector>

#include "terrain/terrain_trial.h"

namespace heightlight {

/// Writes `light,albedo,form,window,rmse,bias,p95,reflected_mean,relative_rmse,relative_bias`: E/π, and what
/// it is of the mean that terrain reflects. The window is empty where a form takes none. Throws Error naming
/// the file.
void write_terrain_forms_csv(const std::filesystem::path& path, const std::vector<TerrainFormRow>& rows);

/// Writes `method,azimuths,reach_cells,error_wanted,definition,below_horizontal,seconds,core_seconds,
/// core_seconds_per_megatexel,rmse,bias,p95`. Azimuths are empty where they are chosen for an error, the
/// number of cells where there is none, the error where none is wanted. Throws Error naming the file.
void write_terrain_methods_csv(const std::filesystem::path& path, const std::vector<TerrainMethodRow>& rows);

}  // namespace heightlight
