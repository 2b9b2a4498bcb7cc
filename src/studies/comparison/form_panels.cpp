#include "comparison/form_panels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/percentile.h"
#include "comparison/closed_form_totals.h"
#include "user_form/user_form.h"

namespace heightlight {
namespace {

constexpr std::size_t kBins = 40;
constexpr std::size_t kFewestTexels = 10;   // texels of a bin that is drawn
constexpr std::size_t kFewestShare = 4000;  // one in so many

/// Which texels lie in which bin of AO.
using Bins = std::vector<std::vector<std::size_t>>;

Bins sort_into_bins(const Map& occlusion) {
  Bins bins(kBins);
  std::size_t present = 0;
  for (std::size_t i = 0; i < occlusion.size(); ++i) {
    const double ao = double{occlusion.values[i]};
    if (std::isnan(ao)) continue;
    ++present;
    bins[std::min(kBins - 1, static_cast<std::size_t>(clamp_share(ao) * kBins))].push_back(i);
  }
  const std::size_t fewest = std::max(kFewestTexels, present / kFewestShare);
  std::erase_if(bins, [fewest](const std::vector<std::size_t>& bin) { return bin.size() < fewest; });
  return bins;
}

/// NaN where no texel has a value.
double mean_over(const Map& map, const std::vector<std::size_t>& texels) {
  double sum = 0;
  std::size_t count = 0;
  for (const std::size_t i : texels) {
    if (std::isnan(map.values[i])) continue;
    sum += double{map.values[i]};
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
}

PanelBin measure_bin(const Map& occlusion, const Map& total, const std::vector<std::size_t>& texels) {
  constexpr double kLow = 0.05;
  std::vector<float> values;
  for (const std::size_t i : texels) values.push_back(total.values[i]);
  PanelBin bin{.ao = mean_over(occlusion, texels), .mean = mean_over(total, texels)};
  bin.low = percentile(std::span(values), kLow);
  bin.high = percentile(std::span(values), 1 - kLow);
  return bin;
}

}  // namespace

std::vector<AnsweringForm> answering_forms(const std::vector<ClosedForm>& forms) {
  std::vector<AnsweringForm> answering{{kDirectText.name, "AO × π"},
                                       {"notes_guarded", "notes"},
                                       {kUniformNeighbourhoodText.name, "eq. 12"},
                                       {kCubicText.name, "cubic"},
                                       {kSeenFromSkyText.name, "G, n from A"},
                                       {kBouncedText.name, "G, n stored"}};
  for (const ClosedForm& form : forms) {
    if (form.source == kUserFormSource) answering.push_back({form.name, form.name});
  }
  return answering;
}

std::vector<FormPanel> make_form_panels(const std::string& role, const Estimate& estimate,
                                        const ComparedScene& scene, const ComparisonReference& reference) {
  std::vector<FormPanel> panels;
  for (const AoKind kind : {AoKind::sky_view_factor, AoKind::ambient_occlusion}) {
    const bool over_alpha = kind == AoKind::ambient_occlusion;
    const Map& occlusion = over_alpha ? estimate.ambient_occlusion : estimate.sky_view_factor;
    if (occlusion.size() == 0) continue;
    const Bins bins = sort_into_bins(occlusion);
    for (std::size_t a = 0; a < scene.albedos.size(); ++a) {
      FormPanel panel{.role = role, .kind = kind, .albedo = scene.albedos[a].label};
      for (const std::vector<std::size_t>& texels : bins)
        panel.measured.push_back(measure_bin(occlusion, reference.totals[a], texels));
      for (const AnsweringForm& answering : answering_forms(scene.forms)) {
        for (const ClosedForm& form : scene.forms) {
          // Outside their domain curves end: of the notes' two the one that says so is drawn.
          const bool is_notes = answering.form == "notes_guarded";
          if (form.name != (is_notes ? std::string(kNotesText.name) : answering.form)) continue;
          if (form.kind != kind || !can_evaluate(form, estimate)) continue;
          const Map total = evaluate_closed_form(form, estimate, scene.surface, scene.albedos[a]);
          PanelCurve& curve = panel.curves.emplace_back(PanelCurve{form.name, answering.label, {}});
          for (std::size_t b = 0; b < bins.size(); ++b)
            curve.points.push_back({panel.measured[b].ao, mean_over(total, bins[b])});
        }
      }
      panels.push_back(std::move(panel));
    }
  }
  return panels;
}

}  // namespace heightlight
