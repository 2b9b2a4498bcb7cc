#pragma once

#include "heightlight/evidence.h"
#include "windows/work.h"

namespace heightlight {

/// What is known of the errors of a bake that is done, beside its plan.
Evidence read_evidence(const Work& work);

}  // namespace heightlight
