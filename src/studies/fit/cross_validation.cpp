#include "fit/cross_validation.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "base/parallel.h"
#include "base/progress.h"

namespace heightlight {
namespace {

using Evaluate = std::function<std::optional<double>(const ModelInputs&, double albedo)>;

/// The forms as fitted without one material; the same order for every material, that of list_judged.
using Forms = std::vector<Evaluate>;

/// Names and facts of all forms that are judged, without errors yet: fixed ones, the notes' refitted,
/// families.
std::vector<JudgedForm> list_judged(const TrialForms& trial) {
  std::vector<JudgedForm> forms;
  for (const ClosedForm& form : trial.fixed) {
    forms.push_back({.name = form.name,
                     .formula = form.description,
                     .source = form.source,
                     .kind = form.kind,
                     .extra = form.extra,
                     .both_kinds = form.both_kinds});
  }
  forms.push_back({.name = "notes_refit",
                   .formula = std::string(kNotesText.formula) + ", F0 bounded",
                   .source = kNotesText.source,
                   .kind = AoKind::ambient_occlusion,
                   .fitted = true});
  for (const FormFamily& family : trial.families) {
    if (family.target != FitTarget::total) continue;
    forms.push_back({.name = family.name + "_refit",
                     .formula = family.formula,
                     .source = family.source,
                     .kind = family.kind,
                     .extra = family.extra,
                     .both_kinds = family.both_kinds,
                     .fitted = true});
  }
  for (JudgedForm& form : forms) {
    form.errors.resize(judged_albedos().size());
    form.errors_by_ao.resize(judged_albedos().size());
  }
  return forms;
}

/// All families' points, gathered once for all folds.
struct FamilyPoints {
  const FormFamily* family;
  std::vector<FitPoint> points;
};

std::vector<FamilyPoints> collect_all(const TrialForms& trial, const std::vector<JudgedMap>& maps) {
  std::vector<FamilyPoints> all;
  for (const FormFamily& family : trial.families) all.push_back({&family, collect_points(family, maps)});
  return all;
}

/// Parameters of every family without the maps of one material; empty where no other map has what it needs.
std::vector<Eigen::VectorXd> fit_without(const std::string& material, const std::vector<FamilyPoints>& all,
                                         const std::vector<JudgedMap>& maps, bool only_one) {
  std::vector<double> weights;
  for (const JudgedMap& map : maps) weights.push_back(map.material == material && !only_one ? 0 : 1);
  std::vector<Eigen::VectorXd> fits;
  for (const FamilyPoints& one : all) {
    const bool any = std::any_of(one.points.begin(), one.points.end(),
                                 [&](const FitPoint& point) { return weights[point.map] > 0; });
    fits.push_back(any ? fit_family(*one.family, one.points, weights).parameters : Eigen::VectorXd());
  }
  return fits;
}

/// The notes' total with F₀ and F₁ as fitted.
Evaluate fitted_notes(const std::vector<FamilyPoints>& all, const std::vector<Eigen::VectorXd>& fits) {
  NotesConstants notes;
  notes.direct_power = 1;
  for (std::size_t f = 0; f < all.size(); ++f) {
    if (all[f].family->name == "notes_direct_bounded") notes.direct_gain = fits[f][0];
    if (all[f].family->name != "notes_first_bounce") continue;
    notes.first_gain = fits[f][0];
    notes.first_decay = fits[f][1];
  }
  return [notes](const ModelInputs& in, double albedo) {
    return std::optional(notes_total_guarded(in.ambient_occlusion, albedo, notes));
  };
}

Evaluate fitted_family(const FormFamily& family, const Eigen::VectorXd& fit) {
  if (fit.size() == 0) return [](const ModelInputs&, double) { return std::optional<double>(); };
  return [&family, fit](const ModelInputs& in, double albedo) -> std::optional<double> {
    const double total = family.evaluate(fit, in, albedo);
    if (!std::isfinite(total)) return std::nullopt;
    return family.is_clamped ? clamp_share(total) : total;
  };
}

Forms make_forms(const TrialForms& trial, const std::vector<FamilyPoints>& all,
                 const std::vector<Eigen::VectorXd>& fits) {
  Forms forms;
  for (const ClosedForm& form : trial.fixed) forms.push_back(form.evaluate);
  forms.push_back(fitted_notes(all, fits));
  for (std::size_t f = 0; f < all.size(); ++f) {
    if (all[f].family->target == FitTarget::total) forms.push_back(fitted_family(*all[f].family, fits[f]));
  }
  return forms;
}

void tally(JudgedForm& form, const Evaluate& evaluate, const ModelInputs& inputs, std::size_t albedo,
           double measured, double weight) {
  const std::optional<double> total = evaluate(inputs, judged_albedos()[albedo]);
  if (!total) {
    form.outside_share += weight / static_cast<double>(judged_albedos().size());
    return;
  }
  const double ao =
      form.kind == AoKind::ambient_occlusion ? inputs.ambient_occlusion.value : inputs.sky_view_factor.value;
  const auto bin =
      static_cast<std::size_t>(std::min(kErrorBins - 1, static_cast<int>(clamp_share(ao) * kErrorBins)));
  form.errors[albedo].add(*total - measured, weight);
  form.errors_by_ao[albedo][bin].add(*total - measured, weight);
}

/// `judged` has no errors yet.
std::vector<JudgedForm> judge_texels(const JudgedMap& map, const Forms& forms,
                                     std::vector<JudgedForm> judged) {
  const TexelSample& texels = *map.texels;
  const double weight = 1 / static_cast<double>(texels.size());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const ModelInputs inputs = texel_inputs(map, i);
    for (std::size_t f = 0; f < forms.size(); ++f) {
      for (std::size_t k = 0; k < judged_albedos().size(); ++k) {
        tally(judged[f], forms[f], inputs, k, double{texels.totals[k][i]}, weight);
      }
    }
  }
  return judged;
}

bool takes_bins(const JudgedForm& form, const JudgedMap& map) {
  if (form.both_kinds) return false;
  return form.extra == ExtraInput::none || (form.extra == ExtraInput::expected_seen && map.expected_seen) ||
         (form.extra == ExtraInput::deep_seen && map.deep_seen);
}

std::vector<JudgedForm> judge_bins(const JudgedMap& map, const Forms& forms, std::vector<JudgedForm> judged) {
  for (std::size_t f = 0; f < forms.size(); ++f) {
    if (!takes_bins(judged[f], map)) continue;
    const bool over_alpha = judged[f].kind == AoKind::ambient_occlusion;
    const BounceCurves& curves = over_alpha ? map.over_alpha : map.over_sky;
    double texels = 0;
    for (const CurveBin& bin : curves.filled) texels += static_cast<double>(bin.count);
    for (const CurveBin& bin : curves.filled) {
      const ModelInputs inputs = bin_inputs(map, bin, judged[f].kind);
      for (std::size_t k = 0; k < judged_albedos().size(); ++k) {
        tally(judged[f], forms[f], inputs, k, bin_total(bin, judged_albedos()[k]),
              static_cast<double>(bin.count) / texels);
      }
    }
  }
  return judged;
}

void add_errors(const std::vector<JudgedForm>& more, std::vector<JudgedForm>& sums) {
  for (std::size_t f = 0; f < sums.size(); ++f) {
    sums[f].outside_share += more[f].outside_share;
    for (std::size_t k = 0; k < sums[f].errors.size(); ++k) {
      sums[f].errors[k].add(more[f].errors[k]);
      for (std::size_t b = 0; b < kErrorBins; ++b) {
        sums[f].errors_by_ao[k][b].add(more[f].errors_by_ao[k][b]);
      }
    }
  }
}

/// Forms that were judged at all, shares as shares of the maps.
std::vector<JudgedForm> finish(std::vector<JudgedForm> forms, std::size_t maps) {
  std::erase_if(forms, [](const JudgedForm& form) { return form.errors.front().weight <= 0; });
  for (JudgedForm& form : forms) form.outside_share /= static_cast<double>(std::max<std::size_t>(1, maps));
  return forms;
}

}  // namespace

CrossValidation cross_validate(const std::vector<JudgedMap>& maps, const TrialForms& trial,
                               const Watch& watch) {
  std::set<std::string> names;
  for (const JudgedMap& map : maps) names.insert(map.material);
  const std::vector<std::string> materials(names.begin(), names.end());
  const std::vector<FamilyPoints> all = collect_all(trial, maps);
  const std::vector<JudgedForm> listed = list_judged(trial);

  std::vector<Forms> without(materials.size());
  Progress fitting("fits", static_cast<std::int64_t>(materials.size()), watch);
  parallel_for(
      static_cast<std::int64_t>(materials.size()),
      [&](std::int64_t m) {
        const auto material = static_cast<std::size_t>(m);
        without[material] =
            make_forms(trial, all, fit_without(materials[material], all, maps, materials.size() == 1));
      },
      &fitting);

  std::vector<std::vector<JudgedForm>> texels(maps.size());
  std::vector<std::vector<JudgedForm>> bins(maps.size());
  Progress judging("judging", static_cast<std::int64_t>(maps.size()), watch);
  parallel_for(
      static_cast<std::int64_t>(maps.size()),
      [&](std::int64_t i) {
        const auto map = static_cast<std::size_t>(i);
        const auto material = static_cast<std::size_t>(
            std::find(materials.begin(), materials.end(), maps[map].material) - materials.begin());
        bins[map] = judge_bins(maps[map], without[material], listed);
        if (maps[map].texels) texels[map] = judge_texels(maps[map], without[material], listed);
      },
      &judging);

  CrossValidation result{materials.size(), listed, listed, listed};
  std::size_t with_texels = 0;
  std::size_t resolved = 0;
  for (std::size_t map = 0; map < maps.size(); ++map) {
    add_errors(bins[map], result.per_bin);
    if (!maps[map].texels) continue;
    add_errors(texels[map], result.per_texel);
    ++with_texels;
    if (!is_resolved(maps[map])) continue;
    add_errors(texels[map], result.per_texel_resolved);
    ++resolved;
  }
  result.per_bin = finish(std::move(result.per_bin), maps.size());
  result.per_texel = finish(std::move(result.per_texel), with_texels);
  result.per_texel_resolved = finish(std::move(result.per_texel_resolved), resolved);
  return result;
}

}  // namespace heightlight
