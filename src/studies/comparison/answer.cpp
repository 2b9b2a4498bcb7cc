#include "comparison/answer.h"

#include <algorithm>

namespace heightlight {
namespace {

const ComparisonRow* find_row(const Comparison& comparison, const RoleOfMethod& role,
                              const std::string& variant, const std::string& quantity) {
  for (const ComparisonRow& row : comparison.rows) {
    if (row.method == role.method && row.parameters == role.parameters && row.variant == variant &&
        row.quantity == quantity)
      return &row;
  }
  return nullptr;
}

}  // namespace

Answer find_answer(const Comparison& comparison, const ComparedScene& scene) {
  Answer answer;
  for (const ComparedAlbedo& albedo : scene.albedos) answer.albedos.push_back(albedo.label);
  for (const RoleOfMethod& role : comparison.roles) {
    AnswerGroup& group = answer.groups.emplace_back();
    group.role = role.role;
    group.parameters = role.parameters;
    group.core_seconds = role.core_seconds;
    if (const ComparisonRow* sky = find_row(comparison, role, "", kSkyQuantity))
      group.sky_rmse = sky->error.rmse;
    for (const AnsweringForm& form : answering_forms(scene.forms)) {
      AnswerLine line{.form = form.form, .label = form.label};
      for (const ComparedAlbedo& albedo : scene.albedos) {
        const std::string quantity = total_quantity(albedo);
        const ComparisonRow* row = find_row(comparison, role, form.form, quantity);
        if (!row) continue;
        line.errors.push_back(row->error);
        const bool is_notes = form.form == "notes_guarded";  // which has a value everywhere
        if (is_notes) row = find_row(comparison, role, kNotesText.name, quantity);
        line.outside_share = std::max(line.outside_share, row->outside_share);
      }
      if (line.errors.size() == scene.albedos.size()) group.lines.push_back(std::move(line));
    }
  }
  return answer;
}

const AnswerLine* best_line(const AnswerGroup& group, std::size_t albedo) {
  const AnswerLine* best = nullptr;
  for (const AnswerLine& line : group.lines) {
    if (line.form == kBouncedText.name) continue;
    if (!best || line.errors[albedo].rmse < best->errors[albedo].rmse) best = &line;
  }
  return best;
}

}  // namespace heightlight
