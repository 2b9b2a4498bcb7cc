#include "shading/shading_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>

#include "files/output_file.h"
#include "shading/shading_csv.h"

namespace heightlight {
namespace {

void begin_columns(std::FILE* file, const std::vector<std::string>& heads) {
  for (const std::string& head : heads) fmt::print(file, "| {} ", head);
  fmt::print(file, "|\n");
  for (std::size_t i = 0; i < heads.size(); ++i) fmt::print(file, "|---");
  fmt::print(file, "|\n");
}

void write_head(std::FILE* file, const ShadingReportHead& head, const char* title) {
  const Surface& surface = head.surface;
  fmt::print(file, "# {}: {}\n\n{} × {} texels of {:g} × {:g}, relief {:g}.\n\n", head.map_name, title,
             surface.width(), surface.height(), surface.map.spacing.x, surface.map.spacing.y,
             relief(surface.map));
  for (const Warning& warning : head.warnings) fmt::print(file, "* Warning: {}\n", warning.message);
  if (!head.warnings.empty()) std::fputc('\n', file);
}

/// In the order in which they come first.
template <class Row>
std::vector<std::string> distinct(const std::vector<Row>& rows, std::string Row::*name) {
  std::vector<std::string> names;
  for (const Row& row : rows) {
    if (std::find(names.begin(), names.end(), row.*name) == names.end()) names.push_back(row.*name);
  }
  return names;
}

std::string condition_of(const SpecularTruth& truth, const std::vector<Vector3>& views) {
  return fmt::format("{:g}, {:.0f}°", truth.roughness, elevation_deg(views[truth.view]));
}

const SpecularRow* find_specular(const SpecularStudy& study, const SpecularTruth& truth,
                                 const std::string& input, const std::string& method) {
  for (const SpecularRow& row : study.rows) {
    if (row.method == method && row.input == input && row.roughness == truth.roughness &&
        row.view == truth.view)
      return &row;
  }
  return nullptr;
}

void write_truths(std::FILE* file, const SpecularStudy& study, const std::vector<Vector3>& views) {
  fmt::print(
      file,
      "The truth is by rays into the lobe (GGX, reflectance 0.04), on the receivers that the viewer sees. "
      "Columns are roughness (α of GGX) and the view's elevation above the map's plane; narrow places "
      "have A below {:g}.\n\n",
      kNarrowSky);
  begin_columns(file, {"roughness, view", "receivers", "narrow", "mean S", "error of the truth, RMSE"});
  for (const SpecularTruth& truth : study.truths)
    fmt::print(file, "| {} | {} | {} | {:.4f} | {:.4f} |\n", condition_of(truth, views), truth.seen,
               truth.narrow, truth.mean, truth.rmse);
  std::fputc('\n', file);
}

void write_specular_winners(std::FILE* file, const SpecularStudy& study, const std::vector<Vector3>& views) {
  fmt::print(file,
             "## Winners\n\nLeast RMSE with exact openness: of all, and of what takes no more than A and a "
             "bent normal.\n\n");
  begin_columns(file, {"roughness, view", "of all", "RMSE", "of A and bent normal", "RMSE"});
  for (const SpecularTruth& truth : study.truths) {
    const SpecularRow* best = nullptr;
    const SpecularRow* best_open = nullptr;
    for (const SpecularRow& row : study.rows) {
      if (row.roughness != truth.roughness || row.view != truth.view) continue;
      if (row.input != "" && row.input != kExactOpenness) continue;
      if (!best || row.rmse < best->rmse) best = &row;
      if (row.input == kExactOpenness && (!best_open || row.rmse < best_open->rmse)) best_open = &row;
    }
    if (!best || !best_open) continue;
    fmt::print(file, "| {} | {} | {:.4f} | {} | {:.4f} |\n", condition_of(truth, views), best->method,
               best->rmse, best_open->method, best_open->rmse);
  }
  std::fputc('\n', file);
}

void write_specular_errors(std::FILE* file, const SpecularStudy& study, const std::vector<Vector3>& views,
                           const char* quantity,
                           const std::function<std::string(const SpecularRow&)>& value) {
  fmt::print(file, "## {}\n\n", quantity);
  std::vector<std::string> heads{"method", "openness"};
  for (const SpecularTruth& truth : study.truths) heads.push_back(condition_of(truth, views));
  begin_columns(file, heads);
  for (const std::string& method : distinct(study.rows, &SpecularRow::method)) {
    for (const std::string& input : distinct(study.rows, &SpecularRow::input)) {
      if (!find_specular(study, study.truths.front(), input, method)) continue;
      fmt::print(file, "| {} | {} |", method, input);
      for (const SpecularTruth& truth : study.truths)
        fmt::print(file, " {} |", value(*find_specular(study, truth, input, method)));
      std::fputc('\n', file);
    }
  }
  std::fputc('\n', file);
}

void write_times(std::FILE* file, const SpecularStudy& study) {
  fmt::print(file,
             "## Cost\n\nOn one processor, in double precision, without any attempt at speed: what counts "
             "is one beside the other.\n\n");
  begin_columns(file, {"method", "ns per texel"});
  for (const MethodTime& time : study.times)
    fmt::print(file, "| {} | {:.0f} |\n", time.method, time.nanoseconds);
}

void write_shading_errors(std::FILE* file, const DirectionalStudy& study, bool as_harmonics,
                          double DirectionalRow::*quantity) {
  const std::vector<std::string> skies = distinct(study.rows, &DirectionalRow::sky);
  std::vector<std::string> heads{"method", "openness"};
  heads.insert(heads.end(), skies.begin(), skies.end());
  begin_columns(file, heads);
  for (const std::string& method : distinct(study.rows, &DirectionalRow::method)) {
    for (const std::string& input : distinct(study.rows, &DirectionalRow::input)) {
      std::string line;
      for (const std::string& sky : skies) {
        for (const DirectionalRow& row : study.rows) {
          if (row.method == method && row.input == input && row.sky == sky &&
              row.as_harmonics == as_harmonics)
            line += fmt::format(" {:.5f} |", row.*quantity);
        }
      }
      if (!line.empty()) fmt::print(file, "| {} | {} |{}\n", method, input, line);
    }
  }
  std::fputc('\n', file);
}

void write_shading_winners(std::FILE* file, const DirectionalStudy& study) {
  fmt::print(file, "## Winners\n\nLeast mean relative squared error against the sky itself.\n\n");
  begin_columns(file, {"sky", "openness", "method", "MRSE", "without sh maps", "MRSE"});
  for (const std::string& sky : distinct(study.rows, &DirectionalRow::sky)) {
    for (const std::string& input : distinct(study.rows, &DirectionalRow::input)) {
      const DirectionalRow* best = nullptr;
      const DirectionalRow* best_open = nullptr;
      for (const DirectionalRow& row : study.rows) {
        if (row.sky != sky || row.input != input || row.as_harmonics) continue;
        if (!best || row.mrse < best->mrse) best = &row;
        if (row.method != kOwnHarmonics && (!best_open || row.mrse < best_open->mrse)) best_open = &row;
      }
      if (!best || !best_open) continue;
      fmt::print(file, "| {} | {} | {} | {:.5f} | {} | {:.5f} |\n", sky, input, best->method, best->mrse,
                 best_open->method, best_open->mrse);
    }
  }
  std::fputc('\n', file);
}

}  // namespace

void write_specular_report(const std::filesystem::path& path, const ShadingReportHead& head,
                           const SpecularStudy& study, const std::vector<Vector3>& views) {
  write_file(path, [&](std::FILE* file) {
    write_head(file, head, "specular occlusion");
    fmt::print(file, "Cone against cone errs least here with u = {:.4g}.\n\n", study.fitted_share);
    write_truths(file, study, views);
    write_specular_winners(file, study, views);
    write_specular_errors(file, study, views, "RMSE",
                          [](const SpecularRow& row) { return fmt::format("{:.4f}", row.rmse); });
    write_specular_errors(file, study, views, "Bias",
                          [](const SpecularRow& row) { return fmt::format("{:+.4f}", row.bias); });
    write_specular_errors(file, study, views, "RMSE in narrow places",
                          [](const SpecularRow& row) { return fmt::format("{:.4f}", row.narrow_rmse); });
    write_times(file, study);
  });
}

void write_directional_report(const std::filesystem::path& path, const ShadingReportHead& head,
                              const DirectionalStudy& study) {
  write_file(path, [&](std::FILE* file) {
    write_head(file, head, "diffuse light of skies that are not even");
    fmt::print(file,
               "E/π in units of what a level plane receives, against exact horizons along {} azimuths on {} "
               "receivers. Relative errors are of the truth, or of {:g} where there is less.\n\n",
               kOpennessAzimuths, study.grid.texels.size(), kLeastLight);
    write_shading_winners(file, study);
    fmt::print(file, "## Mean relative squared error, against the sky itself\n\n");
    write_shading_errors(file, study, false, &DirectionalRow::mrse);
    fmt::print(file, "## The same, against the sky as its nine harmonics have it\n\n");
    write_shading_errors(file, study, true, &DirectionalRow::mrse);
    fmt::print(file, "## RMSE, against the sky itself\n\n");
    write_shading_errors(file, study, false, &DirectionalRow::rmse);
    fmt::print(file, "## Bias, against the sky itself\n\n");
    write_shading_errors(file, study, false, &DirectionalRow::bias);
    fmt::print(file, "## Cost\n\nPer texel and channel; times on one processor, in double precision.\n\n");
    begin_columns(file, {"method", "ns", "arithmetic", "roots", "look-ups of the sky"});
    for (const ShadingCost& cost : study.costs)
      fmt::print(file, "| {} | {:.1f} | {} | {} | {} |\n", cost.method, cost.nanoseconds,
                 cost.lookups > 0 ? "–" : std::to_string(cost.arithmetic),
                 cost.lookups > 0 ? "–" : std::to_string(cost.functions), cost.lookups);
  });
}

}  // namespace heightlight
