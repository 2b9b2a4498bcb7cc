#include "models/form_family.h"

#include "models/judged_map.h"

namespace heightlight {
namespace {

using Eigen::VectorXd;
using Inputs = const ModelInputs&;
using Parameters = const VectorXd&;

const NotesConstants kNotes;
const CubicConstants kCubic;
const SeenConstants kSeen;

FormFamily notes_direct_family() {
  return {"notes_direct",
          "alpha (1 + gain (1 - alpha)^power)",
          "file 004 eq. 7",
          AoKind::ambient_occlusion,
          ExtraInput::none,
          FitTarget::direct,
          {"gain", "power"},
          {kNotes.direct_gain, kNotes.direct_power},
          [](Parameters p, Inputs in, double) {
            return notes_direct(in.ambient_occlusion, NotesConstants{p[0], p[1], 0, 0});
          }};
}

/// F₀ with power 1 does not exceed 1 as long as its gain does not.
FormFamily bounded_direct_family() {
  return {"notes_direct_bounded",
          "alpha (1 + gain (1 - alpha))",
          "file 004 eq. 7 with power 1, at most 1",
          AoKind::ambient_occlusion,
          ExtraInput::none,
          FitTarget::direct,
          {"gain"},
          {kNotes.direct_gain},
          [](Parameters p, Inputs in, double) {
            return notes_direct(in.ambient_occlusion, NotesConstants{p[0], 1, 0, 0});
          }};
}

FormFamily notes_first_bounce_family() {
  return {"notes_first_bounce",
          "A alpha (1 - alpha)^1.5 exp(-B alpha^0.25)",
          "file 004 eq. 11",
          AoKind::ambient_occlusion,
          ExtraInput::none,
          FitTarget::first_bounce,
          {"A", "B"},
          {kNotes.first_gain, kNotes.first_decay},
          [](Parameters p, Inputs in, double) {
            return notes_first_bounce(in.ambient_occlusion, NotesConstants{0, 1, p[0], p[1]});
          }};
}

FormFamily cubic_family(const std::string& name, FitTarget target) {
  return {name,
          "a A^3 - b A^2 + c A; a, b, c linear in albedo",
          "file 000 eq. 33",
          AoKind::sky_view_factor,
          ExtraInput::none,
          target,
          {"a_slope", "a_offset", "b_slope", "b_offset", "c_slope", "c_offset"},
          {kCubic.a_slope, kCubic.a_offset, kCubic.b_slope, kCubic.b_offset, kCubic.c_slope, kCubic.c_offset},
          [](Parameters p, Inputs in, double albedo) {
            // as a polynomial, not held in [0, 1]
            const double sky = in.sky_view_factor.value;
            return (((p[0] * albedo + p[1]) * sky - (p[2] * albedo + p[3])) * sky + p[4] * albedo + p[5]) *
                   sky;
          }};
}

FormFamily seen_from_sky_family() {
  return {"seen_from_sky",
          "G(A, n, rho), n = offset + slope A",
          "here",
          AoKind::sky_view_factor,
          ExtraInput::none,
          FitTarget::total,
          {"offset", "slope"},
          {kSeen.offset, kSeen.slope},
          [](Parameters p, Inputs in, double albedo) {
            SeenConstants constants;
            constants.offset = p[0];
            constants.slope = p[1];
            return bounced_total(in.sky_view_factor, guess_seen(in.sky_view_factor, constants), albedo);
          }};
}

FormFamily seen_from_map_family() {
  return {"seen_from_map",
          "G(A, n, rho), n = offset + s + slope (A - s) + curvature (A - s)^2",
          "here",
          AoKind::sky_view_factor,
          ExtraInput::expected_seen,
          FitTarget::total,
          {"offset", "slope", "curvature"},
          {kSeen.map_offset, kSeen.map_slope, kSeen.map_curvature},
          [](Parameters p, Inputs in, double albedo) {
            SeenConstants constants;
            constants.map_offset = p[0];
            constants.map_slope = p[1];
            constants.map_curvature = p[2];
            return bounced_total(in.sky_view_factor,
                                 guess_seen_on_map(in.sky_view_factor, in.expected_seen, constants), albedo);
          }};
}

SeenConstants deep_constants(Parameters p) {
  SeenConstants constants;
  constants.deep_slope = p[0];
  constants.deep_bend = p[1];
  return constants;
}

FormFamily seen_from_deep_family() {
  return {"seen_from_deep",
          "G(A, n, rho), n = t + (slope + bend t) A",
          "here",
          AoKind::sky_view_factor,
          ExtraInput::deep_seen,
          FitTarget::total,
          {"slope", "bend"},
          {kSeen.deep_slope, kSeen.deep_bend},
          [](Parameters p, Inputs in, double albedo) {
            return bounced_total(in.sky_view_factor,
                                 guess_seen_in_deep(in.sky_view_factor, in.deep_seen, deep_constants(p)),
                                 albedo);
          }};
}

FormFamily seen_from_blur_family() {
  return {"seen_from_blur",
          "G(A, n, rho), n = offset + W + slope (A - W)",
          "here",
          AoKind::sky_view_factor,
          ExtraInput::blurred,
          FitTarget::total,
          {"offset", "slope"},
          {kSeen.blur_offset, kSeen.blur_slope},
          [](Parameters p, Inputs in, double albedo) {
            SeenConstants constants;
            constants.blur_offset = p[0];
            constants.blur_slope = p[1];
            return bounced_total(in.sky_view_factor,
                                 guess_seen_by_blur(in.sky_view_factor, in.blurred, constants), albedo);
          }};
}

}  // namespace

const std::vector<FormFamily>& form_families() {
  static const std::vector<FormFamily> families{
      notes_direct_family(),
      bounded_direct_family(),
      notes_first_bounce_family(),
      cubic_family("cubic_three_bounces", FitTarget::three_bounces),
      cubic_family("cubic", FitTarget::total),
      seen_from_sky_family(),
      seen_from_map_family(),
      seen_from_deep_family(),
      seen_from_blur_family(),
  };
  return families;
}

const std::vector<double>& target_albedos(FitTarget target) {
  static const std::vector<double> none{1.0};
  static const std::vector<double> appendix_b{0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9};
  static const std::vector<double> below_one(judged_albedos().begin(), judged_albedos().end() - 1);
  switch (target) {
    case FitTarget::total:
      return below_one;
    case FitTarget::three_bounces:
      return appendix_b;
    default:
      return none;
  }
}

ModelInputs tune_inputs(const FormFamily& family, const VectorXd& parameters, const SeenMoments& moments,
                        ModelInputs inputs) {
  if (family.extra == ExtraInput::deep_seen) {
    inputs.deep_seen = tune_deep_seen(moments, deep_constants(parameters));
  }
  return inputs;
}

}  // namespace heightlight
