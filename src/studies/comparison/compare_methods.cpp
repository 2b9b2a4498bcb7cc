#include "comparison/compare_methods.h"

#include <algorithm>
#include <cmath>

#include "base/progress.h"
#include "comparison/closed_form_totals.h"
#include "comparison/sky_comparison.h"

namespace heightlight {
namespace {

/// Writes the rows of one contender.
class RowWriter {
 public:
  RowWriter(const ComparedScene& scene, const ComparisonReference& reference,
            std::vector<ComparisonRow>& rows)
      : scene_(scene), reference_(reference), rows_(rows) {}

  void add_occlusion(const Contender& contender, const Estimate& estimate, Cost cost) const {
    const auto write = [&](const std::string& quantity, const ErrorStatistics& error) {
      rows_.push_back(row(contender, estimate, "", quantity, cost, error));
    };
    if (estimate.sky_view_factor.size() > 0) {
      write(kSkyQuantity, measure(subtract(estimate.sky_view_factor, reference_.sky_view_factor)));
    }
    if (estimate.ambient_occlusion.size() > 0) {
      write(kOcclusionQuantity, measure(subtract(estimate.ambient_occlusion, reference_.ambient_occlusion)));
    }
    if (estimate.bent_normal.size() > 0) {
      write(kBentQuantity, measure(angles_deg(estimate.bent_normal, reference_.bent_normal)));
    }
  }

  /// `estimate` has the total at the a-th albedo alone.
  void add_total(const Contender& contender, const Estimate& estimate, std::size_t a, Cost cost) const {
    rows_.push_back(row(contender, estimate, "", total_quantity(scene_.albedos[a]), cost,
                        measure(subtract(estimate.totals[0], reference_.totals[a]))));
  }

  /// The totals that closed forms make of the estimate's AO; each takes as long as the AO and the form.
  void add_closed_forms(const Contender& contender, const Estimate& estimate, Cost cost) const {
    for (const ClosedForm& form : scene_.forms) {
      if (!can_evaluate(form, estimate)) continue;
      for (std::size_t a = 0; a < scene_.albedos.size(); ++a) {
        const Stopwatch watch;
        const Map total = evaluate_closed_form(form, estimate, scene_.surface, scene_.albedos[a]);
        const Cost own = watch.elapsed();
        rows_.push_back(row(contender, estimate, form.name, total_quantity(scene_.albedos[a]), cost + own,
                            measure(subtract(total, reference_.totals[a]))));
        rows_.back().outside_share = share_outside(total);
      }
    }
  }

  /// Direct light of the reference's sky; `variant` says what was made of the AO.
  void add_sky_light(const Contender& contender, const Estimate& estimate, const std::string& variant,
                     Cost cost, const ErrorStatistics& error) const {
    rows_.push_back(row(contender, estimate, variant, reference_.sky.quantity, cost, error));
  }

 private:
  static ComparisonRow row(const Contender& contender, const Estimate& estimate, const std::string& variant,
                           const std::string& quantity, Cost cost, const ErrorStatistics& error) {
    return {.method = contender.method,
            .parameters = contender.parameters,
            .variant = variant,
            .quantity = quantity,
            .cost = cost,
            .samples_per_texel = estimate.samples_per_texel,
            .error = error,
            .shown = contender.shown};
  }

  /// Of the texels of the surface, those for which a closed form has no value.
  double share_outside(const Map& total) const {
    std::size_t present = 0;
    std::size_t outside = 0;
    for (std::size_t i = 0; i < total.size(); ++i) {
      if (std::isnan(reference_.sky_view_factor.values[i])) continue;
      ++present;
      outside += std::isnan(total.values[i]) ? 1 : 0;
    }
    return present > 0 ? static_cast<double>(outside) / static_cast<double>(present) : 0;
  }

  const ComparedScene& scene_;
  const ComparisonReference& reference_;
  std::vector<ComparisonRow>& rows_;
};

/// The errors of the totals at the last albedo, of each form at the head of the report.
void add_total_errors(const ComparedScene& scene, const ComparisonReference& reference,
                      const std::string& role, const Estimate& estimate, Comparison& comparison) {
  for (const AnsweringForm& answering : answering_forms(scene.forms)) {
    ErrorMap& error = comparison.total_errors.emplace_back();
    error.title = role;
    error.subtitle = answering.label;
    for (const ClosedForm& form : scene.forms) {
      if (form.name != answering.form || !can_evaluate(form, estimate)) continue;
      const Map total = evaluate_closed_form(form, estimate, scene.surface, scene.albedos.back());
      const Map differences = subtract(total, reference.totals.back());
      error.error = measure(differences);
      error.differences = thin_out(differences);
    }
  }
}

/// What stands at the head of the report.
void add_role(const ComparedScene& scene, const ComparisonReference& reference, const Contender& contender,
              const Estimate& estimate, Comparison& comparison) {
  add_total_errors(scene, reference, contender.role, estimate, comparison);
  const bool is_drawn = comparison.panels.empty() || contender.role == kRoleOfGames;
  if (!is_drawn) return;
  for (FormPanel& panel : make_form_panels(contender.role, estimate, scene, reference))
    comparison.panels.push_back(std::move(panel));
  for (RenderedForm& one : render_forms(contender.role, estimate, scene, reference))
    comparison.rendered.push_back(std::move(one));
}

/// A, as a grey picture.
RenderedForm render_sky(const std::string& title, const std::string& label, const Map& sky, double rmse) {
  const Map thin = thin_out(sky);
  return {.title = title, .label = label, .rmse = rmse, .reflected = {thin, thin, thin}};
}

/// Jimenez et al. 2016, figure 5: by rising number of directions.
void add_directions(const Contender& contender, const Estimate& estimate,
                    const ComparisonReference& reference, Comparison& comparison) {
  const ErrorStatistics error = measure(subtract(estimate.sky_view_factor, reference.sky_view_factor));
  const std::string title =
      std::to_string(contender.directions) + (contender.directions == 1 ? " direction" : " directions");
  RenderedForm rendered = render_sky(title, contender.parameters, estimate.sky_view_factor, error.rmse);
  auto& all = comparison.directions;
  const auto place = std::find_if(all.begin(), all.end(), [&](const RenderedForm& one) {
    return std::stoi(one.title) > contender.directions;
  });
  all.insert(place, std::move(rendered));
}

/// The reference's own maps, as if a method had found them.
Estimate exact_estimate(const ComparisonReference& reference) {
  Estimate exact;
  exact.sky_view_factor = reference.sky_view_factor;
  exact.ambient_occlusion = reference.ambient_occlusion;
  exact.bent_normal = reference.bent_normal;
  exact.seen = reference.seen;
  return exact;
}

/// The totals at each albedo, timed one by one; what its AO takes is known.
void compare_totals(const ComparedScene& scene, const RowWriter& writer, const Contender& contender,
                    Cost occlusion, Comparison& comparison) {
  StageCost stage{contender.method, contender.parameters, occlusion.core, {}};
  for (std::size_t a = 0; a < scene.albedos.size(); ++a) {
    const std::vector<ComparedAlbedo> one{scene.albedos[a]};
    Estimate estimate;
    const Cost cost = least_cost([&] { estimate = contender.run(one); });
    writer.add_total(contender, estimate, a, cost);
    stage.bounce_core_seconds.push_back(std::max(0.0, cost.core - occlusion.core));
  }
  if (contender.finds_occlusion) comparison.stages.push_back(std::move(stage));
}

/// Light under the sky: what AO makes of it, of those that are shown; and every method's own.
void compare_sky_light(const ComparedScene& scene, const RowWriter& writer, const Contender& contender,
                       const Estimate& estimate, Cost cost, SkyComparison& skies, Comparison& comparison) {
  std::vector<SkyLightResult> results;
  if (contender.shown || contender.role == kExactMethod)
    results = skies.compare_occlusion(contender, estimate, scene.surface, cost);
  if (contender.run_under_sky) results.push_back(skies.compare_own(contender));
  for (SkyLightResult& result : results) {
    writer.add_sky_light(contender, estimate, result.variant, result.cost, result.error);
    const bool is_drawn = !contender.role.empty() || (contender.shown && result.variant.empty());
    if (is_drawn) comparison.sky_light.push_back(std::move(result.rendered));
  }
}

}  // namespace

std::string total_quantity(const ComparedAlbedo& albedo) { return "total_irradiance_" + albedo.label; }

Comparison compare_methods(const ComparedScene& scene, const ComparisonReference& reference,
                           const std::vector<Contender>& contenders, const Watch& watch) {
  Comparison comparison;
  const RowWriter writer(scene, reference, comparison.rows);
  const Estimate exact = exact_estimate(reference);
  const Contender itself{.method = kExactMethod,
                         .parameters = std::to_string(reference.azimuths) + " azimuths",
                         .role = kExactMethod};
  writer.add_closed_forms(itself, exact, reference.cost);
  SkyComparison skies(reference);
  comparison.sky_light.push_back(skies.exact());
  compare_sky_light(scene, writer, itself, exact, reference.cost, skies, comparison);
  comparison.roles.push_back({itself.role, itself.method, itself.parameters, reference.cost.core});
  add_role(scene, reference, itself, exact, comparison);

  Progress progress("methods", static_cast<std::int64_t>(contenders.size()), watch);
  for (const Contender& contender : contenders) {
    progress.throw_if_stopped();
    if (contender.prepare) contender.prepare();
    Estimate estimate;
    Cost cost;
    if (contender.finds_occlusion) {
      cost = least_cost([&] { estimate = contender.run({}); });
      writer.add_occlusion(contender, estimate, cost);
      writer.add_closed_forms(contender, estimate, cost);
    }
    if (contender.finds_totals) compare_totals(scene, writer, contender, cost, comparison);
    if (contender.finds_occlusion)
      compare_sky_light(scene, writer, contender, estimate, cost, skies, comparison);
    if (contender.shown) {
      Map differences = subtract(estimate.sky_view_factor, reference.sky_view_factor);
      const ErrorStatistics error = measure(differences);
      comparison.shown.push_back({.title = contender.method,
                                  .subtitle = contender.parameters,
                                  .error = error,
                                  .differences = std::move(differences)});
    }
    if (!contender.role.empty()) {
      comparison.roles.push_back({contender.role, contender.method, contender.parameters, cost.core});
      add_role(scene, reference, contender, estimate, comparison);
    }
    if (contender.directions > 0) add_directions(contender, estimate, reference, comparison);
    progress.add(1);
  }
  comparison.directions.push_back(render_sky("exact", itself.parameters, reference.sky_view_factor, 0));
  return comparison;
}

}  // namespace heightlight
