#pragma once

#include <string>
#include <vector>

#include "comparison/compare_methods.h"

namespace heightlight {

/// What a closed form errs by on some AO.
struct AnswerLine {
  std::string form;                          ///< as in the list of closed forms
  std::string label;                         ///< as readers know it: "eq. 12"
  std::vector<ErrorStatistics> errors = {};  ///< of the total, per albedo
  double outside_share = 0;                  ///< of the texels: outside the form's domain, and in no error
};

/// One AO, and what forms make of it.
struct AnswerGroup {
  std::string role;  ///< "exact AO", "GTAO as games run it" …
  std::string parameters;
  double core_seconds = 0;
  double sky_rmse = 0;  ///< of its A; 0 of the exact one
  std::vector<AnswerLine> lines;
};

/// The question that the comparison answers: how far closed forms come from light transport, on exact AO and
/// on that of games.
struct Answer {
  std::vector<std::string> albedos;  ///< labels
  std::vector<AnswerGroup> groups;   ///< exact AO first
};

/// From the rows of the contenders that have a role, and of the exact AO.
Answer find_answer(const Comparison& comparison, const ComparedScene& scene);

/// The group's line of least RMSE at an albedo among those that need no second channel (n stored); null where
/// none was tried.
const AnswerLine* best_line(const AnswerGroup& group, std::size_t albedo);

}  // namespace heightlight
