#pragma once

#include <vector>

#include "fit/form_family.h"
#include "user_form/user_form.h"

namespace heightlight {

/// What is put on trial: forms as they are, and forms whose constants are fitted.
struct TrialForms {
  std::vector<ClosedForm> fixed;
  std::vector<FormFamily> families;
};

/// The published forms and this project's, then a user's own, which are fitted where they name constants.
/// This project's guesses of n are judged as fitted alone: their defaults come from maps that may be among
/// those judged.
TrialForms list_trial_forms(const std::vector<UserForm>& own = {});

/// A user's form with free constants as a family. Fits start from 1 for every constant, and from other
/// numbers beside.
FormFamily make_user_family(const UserForm& form);

}  // namespace heightlight
