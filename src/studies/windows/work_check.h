#pragma once

#include "bake/material.h"
#include "heightlight/evidence.h"
#include "windows/work.h"

namespace heightlight {

/// How the work walks, of a bake that is planned; nothing of its errors.
Evidence evidence_of_plan(const Work& work);

/// What was found of the total's channels, as they are now.
std::vector<HorizonCheck> read_total_checks(const Work& work);

/// The same, and the errors that were found, of one that is done.
Evidence read_evidence(const Work& work);

/// What the sky of a window errs by, by exact walks over the whole map from receivers inside. `material` is
/// of the window, or of more around it.
std::optional<SkyCheck> check_window_sky(const Work& work, const Material& material, const MapRect& window);

}  // namespace heightlight
