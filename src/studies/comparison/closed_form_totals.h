#pragma once

#include "comparison/contenders.h"
#include "heightlight/closed_forms.h"

namespace heightlight {

/// Whether an estimate has what a closed form wants to know.
bool can_evaluate(const ClosedForm& form, const Estimate& estimate);

/// E/π by a closed form from an estimate's AO; NaN where it has none and outside the form's domain.
Map evaluate_closed_form(const ClosedForm& form, const Estimate& estimate, const Surface& surface,
                         const ComparedAlbedo& albedo);

}  // namespace heightlight
