#include "cli/fit_print.h"

#include <fmt/core.h>

#include <cmath>

namespace heightlight {
namespace {

void print_parameters(const FittedFamily& fitted) {
  const FormFamily& family = *fitted.family;
  const char* start = origin_of_constants(family);
  fmt::print("{}: {}  ({})\n", family.name, family.formula, family.source);
  for (std::size_t p = 0; p < family.parameters.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    const double value = fitted.fit.parameters[i];
    fmt::print("  {:<9} {:10.5g}  95% {:.5g} … {:.5g}   {} {:.5g} ({:+.2g}){}\n", family.parameters[p], value,
               fitted.intervals.low[i], fitted.intervals.high[i], start, family.published[p],
               value - family.published[p],
               is_determined(family, fitted.fit.parameters, fitted.intervals, i)
                   ? ""
                   : "  hardly determined by these maps");
  }
  fmt::print("  RMS over the points: {:.4f}, at the {} parameters {:.4f}\n", fitted.fit.rms, start,
             fitted.published_rms);
}

void print_bounce_fits(const std::vector<BounceFit>& fits) {
  if (fits.empty()) return;
  fmt::print("each bounce over alpha, A alpha (1 - alpha)^1.5 exp(-B alpha^C), all three free (Patapom)\n");
  for (const BounceFit& fit : fits) {
    if (!fit.fault.empty()) {
      fmt::print("  b = {:<3} {}\n", fit.bounce, fit.fault);
      continue;
    }
    fmt::print("  b = {:<3}", fit.bounce);
    for (std::size_t c = 0; c < 3; ++c)
      fmt::print(" {} {:.4g} (95% {:.3g} … {:.3g})", "ABC"[c], fit.constants[c], fit.low[c], fit.high[c]);
    fmt::print("   RMS {:.2g}, {:.1f} % of the peak\n", fit.rms, 100 * fit.rms / fit.peak);
  }
}

/// τ at some α, for a map that has texels there.
void print_ratios(const std::vector<BounceRatios>& all) {
  constexpr double kAlphas[] = {0.2, 0.4, 0.6, 0.8};
  constexpr std::size_t kShown[] = {0, 4, 9};  // E₂/E₁, E₆/E₅, E₁₁/E₁₀
  const auto print = [](double value) {
    if (std::isnan(value)) {
      fmt::print("    -");
    } else {
      fmt::print(" {:4.2f}", value);
    }
  };
  fmt::print("is tau one number? E2/E1, E6/E5, E11/E10 | tau by eq. 9 on the data, published, at alpha\n");
  fmt::print("  {:<26} spread", "");
  for (const double alpha : kAlphas) fmt::print("  {:<27}", alpha);
  fmt::print("\n");
  for (const BounceRatios& ratios : all) {
    fmt::print("  {:<26}  {:.2f} ", ratios.map, ratios.spread);
    for (const double alpha : kAlphas) {
      const RatioBin* bin = find_bin(ratios, alpha);
      fmt::print(" ");
      for (const std::size_t b : kShown) print(bin && b < bin->ratios.size() ? bin->ratios[b] : std::nan(""));
      fmt::print(" |");
      print(bin ? bin->by_conservation : std::nan(""));
      print(bin ? bin->published : std::nan(""));
    }
    fmt::print("\n");
  }
}

void print_errors(const char* title, const std::vector<JudgedForm>& forms) {
  if (forms.empty()) return;
  fmt::print("{}\n  {:26}   ρ = .1     .3     .5     .7     .8     .9   max at .5     .9\n", title, "");
  for (const JudgedForm& form : forms) {
    fmt::print("  {:<26}", form.name);
    for (const std::size_t k : {0, 2, 4, 6, 7, 8}) fmt::print(" {:6.4f}", form.errors[k].rms());
    fmt::print("      {:.3f}  {:.3f}", form.errors[4].largest, form.errors[8].largest);
    if (form.outside_share > 0) fmt::print("   ({:.0f} % outside its domain)", 100 * form.outside_share);
    fmt::print("\n");
  }
}

void print_floors(const std::vector<Floor>& floors) {
  for (const Floor& floor : floors) {
    fmt::print("  floor of {:<17}", floor.inputs);
    for (const std::size_t k : {0, 2, 4, 6, 7, 8}) fmt::print(" {:6.4f}", floor.rms[k]);
    fmt::print("\n");
  }
}

}  // namespace

void print_report(const FitReport& report) {
  for (const FittedFamily& fitted : report.families) print_parameters(fitted);
  for (const std::string& reason : explain_distances(report)) fmt::print("{}\n", reason);
  print_bounce_fits(report.bounce_fits);
  print_ratios(report.ratios);
  const std::string left_out =
      report.trial.materials > 1
          ? "each of " + std::to_string(report.trial.materials) + " materials judged with a fit to the others"
          : "one material: judged on the maps that were fitted";
  print_errors(("RMS of E/π per texel, " + left_out).c_str(), report.trial.per_texel);
  print_floors(report.floors);
  print_errors("the same on maps that their samples resolve", report.trial.per_texel_resolved);
  print_errors(("RMS of bin means, " + left_out).c_str(), report.trial.per_bin);
}

}  // namespace heightlight
