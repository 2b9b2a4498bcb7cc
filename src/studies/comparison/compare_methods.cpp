#include "comparison/compare_methods.h"

#include "base/progress.h"
#include "comparison/closed_form_totals.h"

namespace heightlight {
namespace {

/// Writes the rows of one contender.
class RowWriter {
 public:
  RowWriter(const ComparedScene& scene, const ComparisonReference& reference,
            std::vector<ComparisonRow>& rows)
      : scene_(scene), reference_(reference), rows_(rows) {}

  void add(const Contender& contender, const Estimate& estimate, Cost cost) const {
    const auto write = [&](const std::string& quantity, const ErrorStatistics& error) {
      rows_.push_back(
          {contender.method, contender.parameters, quantity, cost, estimate.samples_per_texel, error});
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
    if (estimate.half_sky.size() > 0)
      write(kTwoToneQuantity, two_tone_error(estimate.sky_view_factor, estimate.half_sky));
    for (std::size_t a = 0; a < estimate.totals.size(); ++a) {
      write(total_quantity(scene_.albedos[a]), measure(subtract(estimate.totals[a], reference_.totals[a])));
    }
  }

  /// The totals that closed forms make of the estimate's AO; each takes as long as the AO and the form.
  void add_closed_forms(const Contender& contender, const Estimate& estimate, Cost cost) const {
    for (const ClosedForm& form : closed_forms()) {
      if (!can_evaluate(form, estimate)) continue;
      for (std::size_t a = 0; a < scene_.albedos.size(); ++a) {
        const Stopwatch watch;
        const Map total = evaluate_closed_form(form, estimate, scene_.surface, scene_.albedos[a]);
        const Cost own = watch.elapsed();
        rows_.push_back({contender.method, contender.parameters + "; " + form.name,
                         total_quantity(scene_.albedos[a]), cost + own, estimate.samples_per_texel,
                         measure(subtract(total, reference_.totals[a]))});
      }
    }
  }

  /// What comes from either half of the sky, by the share of an open hemisphere that a direction has of each:
  /// from the normal, as AO does, or from the bent normal (file 000 section 5).
  void add_two_tone(const Contender& contender, const Estimate& estimate, Cost cost) const {
    const auto add = [&](const Image<Vector3>& direction, const char* name) {
      Map half = estimate.sky_view_factor;
      for (std::size_t i = 0; i < half.size(); ++i) half.values[i] *= (1 + direction.values[i].y) / 2;
      rows_.push_back({contender.method, contender.parameters + "; " + name, kTwoToneQuantity, cost,
                       estimate.samples_per_texel, two_tone_error(estimate.sky_view_factor, half)});
    };
    add(scene_.surface.normal, "by normal");
    if (estimate.bent_normal.size() > 0) add(estimate.bent_normal, "by bent normal");
  }

 private:
  /// Of the three channels together. Red is 1 from the one half and 0.3 from the other, blue the reverse,
  /// green 0.6 from both; all over their mean.
  ErrorStatistics two_tone_error(const Map& sky, const Map& half) const {
    constexpr double kWarm[] = {1, 0.6, 0.3};
    Map channels(sky.width * 3, sky.height);
    for (std::size_t i = 0; i < sky.size(); ++i) {
      const double half_error = double{half.values[i]} - double{reference_.half_sky.values[i]};
      const double rest_error =
          double{sky.values[i]} - double{reference_.sky_view_factor.values[i]} - half_error;
      for (std::size_t c = 0; c < 3; ++c) {
        const double mean = (kWarm[c] + kWarm[2 - c]) / 2;
        channels.values[3 * i + c] =
            static_cast<float>((kWarm[c] * half_error + kWarm[2 - c] * rest_error) / mean);
      }
    }
    return measure(channels);
  }

  const ComparedScene& scene_;
  const ComparisonReference& reference_;
  std::vector<ComparisonRow>& rows_;
};

}  // namespace

std::string total_quantity(const ComparedAlbedo& albedo) { return "total_irradiance_" + albedo.label; }

Comparison compare_methods(const ComparedScene& scene, const ComparisonReference& reference,
                           const std::vector<Contender>& contenders, const Watch& watch) {
  Comparison comparison;
  const RowWriter writer(scene, reference, comparison.rows);
  Progress progress("methods", static_cast<std::int64_t>(contenders.size()), watch);
  for (const Contender& contender : contenders) {
    progress.throw_if_stopped();
    Estimate estimate;
    const Cost cost = least_cost([&] { estimate = contender.run(); });
    writer.add(contender, estimate, cost);
    if (contender.shown) {
      writer.add_closed_forms(contender, estimate, cost);
      writer.add_two_tone(contender, estimate, cost);
      Map differences = subtract(estimate.sky_view_factor, reference.sky_view_factor);
      const ErrorStatistics error = measure(differences);
      comparison.shown.push_back({.method = contender.method,
                                  .parameters = contender.parameters,
                                  .error = error,
                                  .differences = std::move(differences)});
    }
    progress.add(1);
  }
  Estimate exact;
  exact.sky_view_factor = reference.sky_view_factor;
  exact.ambient_occlusion = reference.ambient_occlusion;
  const std::string azimuths = std::to_string(reference.azimuths) + " azimuths";
  exact.bent_normal = reference.bent_normal;
  const Contender itself{kExactMethod, azimuths, false, {}};
  writer.add_closed_forms(itself, exact, reference.cost);
  writer.add_two_tone(itself, exact, reference.cost);
  return comparison;
}

}  // namespace heightlight
