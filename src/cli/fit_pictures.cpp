#include "cli/fit_pictures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace heightlight {
namespace {

constexpr std::size_t kBins = 50;

double shown_albedo(std::size_t k) { return static_cast<double>(k) / 10; }

using Columns = std::function<std::vector<double>(const CurveBin&)>;

/// Bins of all maps together: mean AO, then the means of the columns, each map counting alike. Rows of NaN
/// where no texel is.
PlotTable pool_bins(const std::vector<JudgedMap>& maps, AoKind kind, const Columns& columns) {
  PlotTable sums(kBins);
  std::vector<double> weights(kBins);
  std::size_t count = 1;
  for (const JudgedMap& map : maps) {
    const BounceCurves& curves = kind == AoKind::ambient_occlusion ? map.over_alpha : map.over_sky;
    double texels = 0;
    for (const CurveBin& bin : curves.filled) texels += static_cast<double>(bin.count);
    for (const CurveBin& bin : curves.filled) {
      const std::size_t place =
          std::min(kBins - 1, static_cast<std::size_t>(clamp_share(bin.ao_mean) * kBins));
      const double weight = static_cast<double>(bin.count) / texels;
      std::vector<double> row = columns(bin);
      row.insert(row.begin(), bin.ao_mean);
      count = std::max(count, row.size());
      sums[place].resize(std::max(sums[place].size(), row.size()));
      for (std::size_t c = 0; c < row.size(); ++c) sums[place][c] += weight * row[c];
      weights[place] += weight;
    }
  }
  for (std::size_t i = 0; i < kBins; ++i) {
    if (weights[i] <= 0) {
      sums[i].assign(count, std::numeric_limits<double>::quiet_NaN());
      continue;
    }
    sums[i].resize(count);
    for (double& sum : sums[i]) sum /= weights[i];
  }
  return sums;
}

/// At ρ = 0, 0.1 … 1: AO, then totals.
PlotTable measured_table(const std::vector<JudgedMap>& maps, AoKind kind) {
  return pool_bins(maps, kind, [](const CurveBin& bin) {
    std::vector<double> totals;
    for (std::size_t k = 0; k <= 10; ++k) totals.push_back(bin_total(bin, shown_albedo(k)));
    return totals;
  });
}

using TotalOfAo = std::function<double(double ao, double albedo)>;

PlotTable fitted_table(const TotalOfAo& total) {
  PlotTable table;
  for (int i = 0; i <= 100; ++i) {
    std::vector<double> row{i / 100.0};
    for (std::size_t k = 0; k <= 10; ++k) row.push_back(total(i / 100.0, shown_albedo(k)));
    table.push_back(row);
  }
  return table;
}

FittedPanel panel(const FitReport& report, const std::string& title, AoKind kind, const TotalOfAo& total) {
  return {title, kind, measured_table(report.maps, kind), fitted_table(total)};
}

CubicConstants cubic_line(const FitReport& report, const char* name) {
  const FittedFamily* fitted = find_family(report, name);
  if (!fitted) return {};
  const Eigen::VectorXd& p = fitted->fit.parameters;
  return {p[0], p[1], p[2], p[3], p[4], p[5]};
}

/// A user's forms as panels, where AO alone tells them.
void add_own_panels(const FitReport& report, std::vector<FittedPanel>& panels) {
  const auto inputs_of = [](AoKind kind, double ao) {
    ModelInputs inputs;
    if (kind == AoKind::ambient_occlusion) {
      inputs.ambient_occlusion = AmbientOcclusion(ao);
    } else {
      inputs.sky_view_factor = SkyViewFactor(ao);
    }
    return inputs;
  };
  for (const ClosedForm& form : report.forms.fixed) {
    if (form.source != kUserFormSource || form.extra != ExtraInput::none || form.both_kinds) continue;
    panels.push_back(panel(report, form.name, form.kind, [&](double ao, double albedo) {
      return form.evaluate(inputs_of(form.kind, ao), albedo)
          .value_or(std::numeric_limits<double>::quiet_NaN());
    }));
  }
  for (const FittedFamily& fitted : report.families) {
    const FormFamily& family = *fitted.family;
    if (family.source != kUserFormSource || family.extra != ExtraInput::none || family.both_kinds) continue;
    panels.push_back(panel(report, family.name + ", fitted here", family.kind, [&](double ao, double albedo) {
      return family.evaluate(fitted.fit.parameters, inputs_of(family.kind, ao), albedo);
    }));
  }
}

}  // namespace

std::vector<FittedPanel> fitted_panels(const FitReport& report) {
  constexpr AoKind kAlpha = AoKind::ambient_occlusion;
  constexpr AoKind kSky = AoKind::sky_view_factor;
  std::vector<FittedPanel> panels;
  panels.push_back(panel(report, "notes, as published", kAlpha,
                         [](double ao, double albedo) { return notes_total(AmbientOcclusion(ao), albedo); }));
  const NotesConstants notes = refitted_notes(report);
  panels.push_back(panel(report, "notes, fitted here", kAlpha, [notes](double ao, double albedo) {
    return notes_total_guarded(AmbientOcclusion(ao), albedo, notes);
  }));
  panels.push_back(panel(report, kUniformNeighbourhoodText.formula, kSky, [](double ao, double albedo) {
    return uniform_neighbourhood(SkyViewFactor(ao), albedo);
  }));
  panels.push_back(panel(report, "cubic, as published", kSky,
                         [](double ao, double albedo) { return cubic_total(SkyViewFactor(ao), albedo); }));
  const CubicConstants cubic = cubic_line(report, "cubic");
  panels.push_back(
      panel(report, "cubic, fitted here to all bounces", kSky,
            [cubic](double ao, double albedo) { return cubic_total(SkyViewFactor(ao), albedo, cubic); }));
  if (const FittedFamily* fitted = find_family(report, "seen_from_sky")) {
    panels.push_back(
        panel(report, "G(A, n, ρ), n from A, fitted here", kSky, [fitted](double ao, double albedo) {
          ModelInputs inputs;
          inputs.sky_view_factor = SkyViewFactor(ao);
          return fitted->family->evaluate(fitted->fit.parameters, inputs, albedo);
        }));
  }
  add_own_panels(report, panels);
  return panels;
}

BounceFitPlotInput bounce_fit_input(const FitReport& report) {
  constexpr AoKind kAlpha = AoKind::ambient_occlusion;
  const std::size_t last = report.bounce_fits.empty() ? 0 : report.bounce_fits.back().bounce;
  BounceFitPlotInput input{.fits = report.bounce_fits, .notes = refitted_notes(report)};
  input.measured = pool_bins(report.maps, kAlpha, [last](const CurveBin& bin) {
    std::vector<double> means;
    for (std::size_t b = 0; b <= last; ++b) means.push_back(bin.bounces[b].mean);
    return means;
  });
  input.spread = pool_bins(report.maps, kAlpha, [](const CurveBin& bin) {
    return std::vector<double>{bin.bounces[0].p05, bin.bounces[0].p95, bin.bounces[1].p05,
                               bin.bounces[1].p95};
  });
  return input;
}

PlotTable saturation_table(const FitReport& report) {
  PlotTable table;
  const PlotTable pooled = pool_bins(report.maps, AoKind::ambient_occlusion, [](const CurveBin& bin) {
    std::vector<double> columns{bin.bounces[0].mean, bin.bounces[1].mean};
    for (std::size_t k = 1; k < 10; ++k) columns.push_back(bin_total(bin, shown_albedo(k)));
    return columns;
  });
  for (std::size_t i = 2; i < pooled.size(); i += 5) {
    const double missing = 1 - pooled[i][1];
    if (std::isnan(missing) || missing <= 0.01) continue;
    const double tau = 1 - pooled[i][2] / missing;
    for (std::size_t k = 1; k < 10; ++k)
      table.push_back({shown_albedo(k), (pooled[i][2 + k] - pooled[i][1]) / missing, tau});
  }
  return table;
}

CubicPanel cubic_panel(const FitReport& report) {
  return {report.cubics_three_bounces, report.cubics_all_bounces, cubic_line(report, "cubic_three_bounces"),
          cubic_line(report, "cubic")};
}

NotesConstants refitted_notes(const FitReport& report) {
  NotesConstants notes;
  const FittedFamily* direct = find_family(report, "notes_direct_bounded");
  const FittedFamily* first = find_family(report, "notes_first_bounce");
  if (!direct || !first) return notes;
  return {direct->fit.parameters[0], 1, first->fit.parameters[0], first->fit.parameters[1]};
}

ShaderConstants shader_constants(const FitReport& report) {
  ShaderConstants constants;
  constants.notes = refitted_notes(report);
  constants.cubic = cubic_line(report, "cubic");
  if (const FittedFamily* sky = find_family(report, "seen_from_sky")) {
    constants.seen.offset = sky->fit.parameters[0];
    constants.seen.slope = sky->fit.parameters[1];
  }
  if (const FittedFamily* map = find_family(report, "seen_from_map")) {
    constants.seen.map_offset = map->fit.parameters[0];
    constants.seen.map_slope = map->fit.parameters[1];
    constants.seen.map_curvature = map->fit.parameters[2];
  }
  if (const FittedFamily* deep = find_family(report, "seen_from_deep")) {
    constants.seen.deep_slope = deep->fit.parameters[0];
    constants.seen.deep_bend = deep->fit.parameters[1];
  }
  if (const FittedFamily* blur = find_family(report, "seen_from_blur")) {
    constants.seen.blur_offset = blur->fit.parameters[0];
    constants.seen.blur_slope = blur->fit.parameters[1];
  }
  return constants;
}

}  // namespace heightlight
