#pragma once

#include <string>
#include <vector>

#include "heightlight/surface.h"
#include "heightlight/transport.h"
#include "io/staged_output.h"

namespace heightlight {

/// One float map, channel Y; `meaning` goes into its header. Throws OutputError.
void write_map(StagedFolder& folder, const std::string& name, const Map& map, const std::string& meaning);

/// `irradiance_total.exr`: one map, Y, or three, R, G, B. Throws OutputError.
void write_totals(StagedFolder& folder, const std::vector<Map>& totals);

/// `ambient_occlusion.exr` and `sky_view_factor.exr`. Throws OutputError.
void write_occlusion(StagedFolder& folder, const Transport& transport);

/// The previews. Throws OutputError.
void write_pictures(StagedFolder& folder, const Surface& surface, const Transport& transport,
                    const std::vector<Map>& first_bounces, const std::vector<Map>& totals);

}  // namespace heightlight
