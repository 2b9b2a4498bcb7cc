#pragma once

#include <optional>
#include <string>
#include <vector>

#include "files/image_file.h"
#include "files/staged_output.h"
#include "heightlight/georeference.h"
#include "heightlight/solve.h"
#include "heightlight/surface.h"

namespace heightlight {

/// Names of all files that `simulate` may write: those of `bounces` bounces among them, kept apart or not,
/// since what an earlier run kept is the next one's.
std::vector<std::string> simulation_file_names(int bounces);

/// Where maps go: each as NAME.exr, and of terrain as the GeoTIFF NAME.tif, too.
struct MapFolder {
  StagedFolder& folder;
  const std::optional<Georeference>& place;
};

/// One float map, channel Y; `meaning` goes into its header. Throws OutputError.
void write_map(const MapFolder& output, const std::string& name, const Map& map, const std::string& meaning);

/// `irradiance_total`: one map, Y, or three, R, G, B. Throws OutputError.
void write_totals(const MapFolder& output, const std::vector<Map>& totals);

/// `irradiance_direct`: likewise, and its preview. Throws OutputError.
void write_direct(const MapFolder& output, const std::vector<Map>& direct);

/// `obscurance` and `ambient_transfer`. Throws OutputError.
void write_transfer(const MapFolder& output, const AmbientTransfer& found);

/// `ambient_occlusion` and `sky_view_factor`. Throws OutputError.
void write_occlusion(const MapFolder& output, const Results& results);

/// The previews. Throws OutputError.
void write_pictures(StagedFolder& folder, const Surface& surface, const Results& results,
                    const std::vector<Image<Rgb8>>& first_bounces, const std::vector<Map>& totals);

}  // namespace heightlight
