#include "comparison/report_answer.h"

#include <fmt/core.h>

#include <string_view>

namespace heightlight {
namespace {

const AnswerGroup* find_group(const Answer& answer, const std::string& role) {
  for (const AnswerGroup& group : answer.groups) {
    if (group.role == role) return &group;
  }
  return nullptr;
}

const AnswerLine* find_line(const AnswerGroup& group, const std::string& form) {
  for (const AnswerLine& line : group.lines) {
    if (line.form == form) return &line;
  }
  return nullptr;
}

/// "On exact AO the best form is … at albedo …".
void write_best(std::FILE* file, const Answer& answer, const AnswerGroup& exact) {
  fmt::print(file, "* **Which form is best, on exact AO?**");
  for (std::size_t a = 0; a < answer.albedos.size(); ++a) {
    const AnswerLine* best = best_line(exact, a);
    if (!best) continue;
    fmt::print(file, "{} albedo {}: {}, RMSE {:.3f}", a > 0 ? ";" : "", answer.albedos[a],
               as_markdown(best->label), best->errors[a].rmse);
    if (const AnswerLine* direct = find_line(exact, kDirectText.name); direct && direct != best)
      fmt::print(file, " (AO × π: {:.3f})", direct->errors[a].rmse);
  }
  fmt::print(file, ".");
  if (const AnswerLine* stored = find_line(exact, kBouncedText.name)) {
    fmt::print(file, " With n stored as a second channel, G errs by");
    for (std::size_t a = 0; a < answer.albedos.size(); ++a)
      fmt::print(file, "{} {:.4f}", a > 0 ? "," : "", stored->errors[a].rmse);
    fmt::print(file, ".");
  }
  std::fputc('\n', file);
}

/// What the same form loses on GTAO's AO.
void write_cost_of_games(std::FILE* file, const Answer& answer, const AnswerGroup& exact,
                         const AnswerGroup& games) {
  fmt::print(file, "* **What does GTAO's own error cost on top?** Its A errs by {:.3f}.", games.sky_rmse);
  for (std::size_t a = 0; a < answer.albedos.size(); ++a) {
    const AnswerLine* best = best_line(exact, a);
    const AnswerLine* same = best ? find_line(games, best->form) : nullptr;
    if (!same) continue;
    fmt::print(file, "{} albedo {}: {} errs by {:.3f} there, {:.3f} on exact AO", a > 0 ? ";" : "",
               answer.albedos[a], as_markdown(same->label), same->errors[a].rmse, best->errors[a].rmse);
  }
  fmt::print(file, ".\n");
}

void write_notes_domain(std::FILE* file, const AnswerGroup& exact, const AnswerGroup* games) {
  const AnswerLine* notes = find_line(exact, "notes_guarded");
  if (!notes) return;
  fmt::print(
      file,
      "* **Where has the notes' model no answer?** Where its F₀ reaches 1, which is from α = 0.9493 on: "
      "{:.1f} % of the texels",
      100 * notes->outside_share);
  const AnswerLine* on_games = games ? find_line(*games, "notes_guarded") : nullptr;
  if (on_games) fmt::print(file, ", {:.1f} % by GTAO's α", 100 * on_games->outside_share);
  fmt::print(file, ". It is taken for 1 there, below.\n");
}

void write_table(std::FILE* file, const Answer& answer) {
  fmt::print(file, "| AO | form |");
  for (const std::string& albedo : answer.albedos) fmt::print(file, " RMSE, ρ = {} | bias |", albedo);
  fmt::print(file, " outside |\n|---|---|");
  for (std::size_t a = 0; a < answer.albedos.size(); ++a) fmt::print(file, "---|---|");
  fmt::print(file, "---|\n");
  for (const AnswerGroup& group : answer.groups) {
    std::string who =
        fmt::format("**{}** ({}; {:.2g} core-s)", group.role, group.parameters, group.core_seconds);
    for (const AnswerLine& line : group.lines) {
      fmt::print(file, "| {} | {} |", who, as_markdown(line.label));
      who.clear();
      for (std::size_t a = 0; a < line.errors.size(); ++a) {
        const std::string mark = best_line(group, a) == &line ? "**" : "";
        fmt::print(file, " {}{:.4f}{} | {:+.4f} |", mark, line.errors[a].rmse, mark, line.errors[a].bias);
      }
      if (line.outside_share > 0) {
        fmt::print(file, " {:.1f} % |\n", 100 * line.outside_share);
      } else {
        fmt::print(file, " |\n");
      }
    }
  }
  fmt::print(
      file,
      "\nRMSE and bias of E/π; bold: the least of those that need no second channel. Outside: texels for "
      "which the form says nothing.\n\n");
}

void write_own_forms(std::FILE* file, const ReportInput& input) {
  for (const FormOnMap& own : input.own_forms) {
    fmt::print(file, "`{} = {}`: ", own.form.name, describe(own.form, own.constants));
    if (own.constants.empty()) {
      fmt::print(file, "RMSE {:.4f}, all albedos together.\n\n", own.rms);
    } else {
      fmt::print(
          file,
          "fitted to this map at all of these albedos, RMSE {:.4f}; {:.4f} on each half of the map by what "
          "was fitted to the other.\n\n",
          own.rms, own.left_out_rms);
    }
  }
}

}  // namespace

std::string as_markdown(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::string_view("\\`*_{}[]<>()#+-!|&~").find(c) != std::string_view::npos) text += '\\';
    text += c;
  }
  return text;
}

void write_answer(std::FILE* file, const ReportInput& input) {
  const Answer& answer = input.answer;
  const AnswerGroup* exact = find_group(answer, kExactMethod);
  if (!exact) return;
  const AnswerGroup* games = find_group(answer, kRoleOfGames);
  write_best(file, answer, *exact);
  if (games) write_cost_of_games(file, answer, *exact, *games);
  write_notes_domain(file, *exact, games);
  std::fputc('\n', file);
  write_table(file, answer);
  fmt::print(file, "![E/π over AO, measured and by each form](forms.png)\n\n");
  write_own_forms(file, input);
}

}  // namespace heightlight
