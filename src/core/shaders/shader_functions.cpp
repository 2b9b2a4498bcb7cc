#include <utility>

#include "heightlight/shaders.h"
#include "shaders/gloss_functions.h"
#include "shaders/shader_literal.h"
#include "shaders/text_template.h"

namespace heightlight {
namespace {

using Sky = SkyViewFactor<float>;
using Seen = SeenSkyViewFactor<float>;

// What forms take as inputs
// -----------------------------------------------------------------------------------------------

ShaderInput sky_input() {
  return {"sky", "A, the sky view factor: cosine weighted, the AO of GTAO; 1 where all is open"};
}
ShaderInput alpha_input() {
  return {"alpha", "plain share of the hemisphere's solid angle that sees the sky; 1 where all is open"};
}
ShaderInput seen_input() {
  return {"seen", "n, the mean sky view factor of what is seen: stored, or of a function seen_from_..."};
}
ShaderInput albedo_input() {
  return {.name = "albedo", .meaning = "of the surface all around, linear", .is_clamped = false};
}

// Constants in texts
// ------------------------------------------------------------------------------------------------

template <class Constants, std::size_t kCount>
Replacements list_constants(const FormConstant<Constants> (&constants)[kCount], const Constants& values,
                            const std::string& suffix = "") {
  Replacements all{{"suffix", suffix}};
  for (const FormConstant<Constants>& constant : constants) {
    all.emplace_back(constant.name, shader_literal(values.*constant.value));
  }
  return all;
}

// Parts, and forms as published
// -------------------------------------------------------------------------------------

ShaderFunction share_function() {
  return {.name = "heightlight_share",
          .formula = "Shares as measured stray out of [0, 1] by rounding",
          .source = "",
          .error = "",
          .inputs = {{.name = "x", .meaning = "any number"}},
          .text = kShareShader,
          .twin = "clamp_share",
          .evaluate = [](const float* in, float* out) { *out = clamp_share(in[0]); },
          .ulps = 0};
}

ShaderFunction uniform_neighbourhood_function() {
  return {.name = "heightlight_uniform_neighbourhood",
          .formula =
              "E/pi of all bounces = A/(1 - albedo (1 - A)), what is seen taken for as open as the place "
              "that sees it; 1 where that is 0/0",
          .source = "Jimenez et al. 2016, eq. 12",
          .error = "RMS of E/pi .0198 at albedo .5, .0464 at .9",
          .inputs = {sky_input(), albedo_input()},
          .is_per_channel = true,
          .text = kUniformNeighbourhoodText.shader,
          .twin = "uniform_neighbourhood",
          .evaluate = [](const float* in, float* out) { *out = uniform_neighbourhood(Sky(in[0]), in[1]); }};
}

ShaderFunction cubic_function(const CubicConstants& constants, const std::string& suffix) {
  return {.name = "heightlight_cubic" + suffix,
          .formula =
              "E/pi of all bounces = a A^3 - b A^2 + c A, the coefficients linear in the albedo; neither A "
              "at albedo 0 nor 1 at albedo 1",
          .source = "Jimenez et al. 2016, eq. 33",
          .error = "RMS of E/pi .0197 at albedo .5, .1048 at .9",
          .inputs = {sky_input(), albedo_input()},
          .is_per_channel = true,
          .text = fill_in(kCubicText.shader, list_constants(kCubicConstants, constants, suffix)),
          .twin = "cubic_total",
          .evaluate = [constants](const float* in, float* out) {
            *out = cubic_total(Sky(in[0]), in[1], constants);
          }};
}

ShaderFunction bounce_sum_function() {
  return {.name = "heightlight_bounce_sum",
          .formula =
              "F0 + albedo F1/(1 - albedo tau), tau = 1 - F1/(1 - F0); 1 outside its domain. A part of notes",
          .source = "study notes \"Improved Ambient Occlusion\", eqs. 9, 10 and 12",
          .error = "",
          .inputs = {{.name = "direct", .meaning = "F0, E/pi before any bounce", .is_clamped = false},
                     {.name = "first",
                      .meaning = "F1, what the first bounce brings at albedo 1",
                      .is_clamped = false},
                     albedo_input()},
          .text = kBounceSumShader,
          .twin = "sum_bounces_guarded",
          .evaluate = [](const float* in, float* out) { *out = sum_bounces_guarded(in[0], in[1], in[2]); }};
}

ShaderFunction notes_function(const NotesConstants& constants, const std::string& suffix) {
  return {.name = "heightlight_notes" + suffix,
          .formula = "E/pi of all bounces, F0 and F1 functions of alpha, not of A",
          .source = "study notes \"Improved Ambient Occlusion\", eqs. 7 and 11",
          .error = "RMS of E/pi .0738 at albedo .5, .0616 at .9",
          .inputs = {alpha_input(), albedo_input()},
          .is_per_channel = true,
          .text = fill_in(kNotesText.shader, list_constants(kNotesConstants, constants, suffix)),
          .twin = "notes_total_guarded",
          .evaluate =
              [constants](const float* in, float* out) {
                *out = notes_total_guarded(AmbientOcclusion(in[0]), in[1], constants);
              },
          .ulps = 4};
}

// This project's forms
// ----------------------------------------------------------------------------------------------------

ShaderFunction bounced_function() {
  return {
      .name = "heightlight_bounced",
      .formula =
          "E/pi of all bounces = A + albedo (1 - A) n/(1 - albedo (1 - n)): exact at albedo 0 and 1, "
          "rising with albedo, without poles; 1 where it is 0/0, as along all of albedo 1",
      .source = "",
      .error = "RMS of E/pi .0021 at albedo .5, .0059 at .9, n stored, as solved for at albedo " +
               shader_literal(kSeenAlbedo),
      .inputs = {sky_input(), seen_input(), albedo_input()},
      .is_per_channel = true,
      .text = kBouncedText.shader,
      .twin = "bounced_total",
      .evaluate = [](const float* in, float* out) { *out = bounced_total(Sky(in[0]), Seen(in[1]), in[2]); }};
}

ShaderFunction stored_pair_function() {
  return {
      .name = "multi_bounce",
      .formula =
          "E/pi of all bounces under an even sky, that of an open place being 1, from a texture of bake "
          "--maps ao-n: heightlight_bounced per channel",
      .source = "",
      .error = "",
      .inputs = {{.name = "a_n", .meaning = "the texture's two channels, A and n, linear", .components = 2},
                 {.name = "albedo",
                  .meaning = "linear reflectance, per channel",
                  .components = 3,
                  .is_clamped = false}},
      .components = 3,
      .text = kStoredPairShader,
      .twin = "bounced_total",
      .evaluate = [](const float* in, float* out) {
        for (int c = 0; c < 3; ++c) out[c] = bounced_total(Sky(in[0]), Seen(in[1]), in[2 + c]);
      }};
}

/// This project's guesses of n.
std::vector<ShaderFunction> seen_functions(const SeenConstants& constants) {
  const Replacements replacements = list_constants(kSeenConstants, constants);
  const auto text = [&](const FormText& form) { return fill_in(form.shader, replacements); };
  return {{.name = "heightlight_seen_from_sky",
           .formula = "n from A alone",
           .source = "",
           .error = "RMS of E/pi .0157 at albedo .5, .0256 at .9",
           .inputs = {sky_input()},
           .text = text(kSeenFromSkyText),
           .twin = "guess_seen",
           .evaluate = [constants](const float* in,
                                   float* out) { *out = guess_seen(Sky(in[0]), constants).value; }},
          {.name = "heightlight_seen_from_map",
           .formula = "n from A and one number for the whole map, which follows from the map's A and normals",
           .source = "",
           .error = "RMS of E/pi .0137 at albedo .5, .0207 at .9",
           .inputs = {sky_input(), {"expected", "seen.expected_sky_view_factor in summary.json of simulate"}},
           .text = text(kSeenFromMapText),
           .twin = "guess_seen_on_map",
           .evaluate =
               [constants](const float* in, float* out) {
                 *out = guess_seen_on_map(Sky(in[0]), Seen(in[1]), constants).value;
               }},
          {.name = "heightlight_seen_from_deep",
           .formula = "n from A and one number for the whole map, which its simulation finds",
           .source = "",
           .error = "RMS of E/pi .0117 at albedo .5, .0162 at .9",
           .inputs = {sky_input(),
                      {.name = "deep",
                       .meaning = "seen.deep_sky_view_factor in summary.json of simulate",
                       .is_clamped = false}},
           .text = text(kSeenFromDeepText),
           .twin = "guess_seen_in_deep",
           .evaluate =
               [constants](const float* in, float* out) {
                 *out = guess_seen_in_deep(Sky(in[0]), Seen(in[1]), constants).value;
               }},
          {.name = "heightlight_seen_from_blur",
           .formula = "n from A and its neighbourhood",
           .source = "",
           .error = "RMS of E/pi .0109 at albedo .5, .0131 at .9",
           .inputs = {sky_input(),
                      {"blurred", "A blurred by a Gaussian of " + shader_literal(kBlurSigma) +
                                      " texels, weighted by 1 - A"}},
           .text = text(kSeenFromBlurText),
           .twin = "guess_seen_by_blur",
           .evaluate = [constants](const float* in, float* out) {
             *out = guess_seen_by_blur(Sky(in[0]), Seen(in[1]), constants).value;
           }}};
}

// The lists
// --------------------------------------------------------------------------------------------------------

void append(std::vector<ShaderFunction>& functions, std::vector<ShaderFunction> more) {
  for (ShaderFunction& function : more) functions.push_back(std::move(function));
}

std::vector<ShaderFunction> make_shader_functions() {
  std::vector<ShaderFunction> functions{share_function(),       uniform_neighbourhood_function(),
                                        cubic_function({}, ""), bounce_sum_function(),
                                        notes_function({}, ""), bounced_function()};
  append(functions, seen_functions({}));
  functions.push_back(stored_pair_function());
  append(functions, gloss_functions(kShaderHorizons));
  return functions;
}

}  // namespace

const std::vector<ShaderFunction>& shader_functions() {
  static const std::vector<ShaderFunction> functions = make_shader_functions();
  return functions;
}

std::vector<ShaderFunction> fitted_shader_functions(const ShaderConstants& constants) {
  ShaderFunction cubic = cubic_function(constants.cubic, "_fitted");
  // The reports fit F0 in two ways; the shader's is the one that stays at or below 1.
  ShaderFunction notes = notes_function(constants.notes, "_fitted");
  notes.formula +=
      ", fitted: F0 with power 1, so that it is at most 1 (notes_direct_bounded in the report of a fit; its "
      "notes_direct has a power of its own, and may exceed 1), F1 as notes_first_bounce";
  cubic.formula += ", fitted";
  std::vector<ShaderFunction> seen = seen_functions(constants.seen);
  for (ShaderFunction* function : {&cubic, &notes})
    function->error.clear();  // errors were measured with the constants as published
  for (ShaderFunction& function : seen) function.error.clear();
  std::vector<ShaderFunction> functions{
      share_function(),      uniform_neighbourhood_function(), cubic_function({}, ""), std::move(cubic),
      bounce_sum_function(), notes_function({}, ""),           std::move(notes),       bounced_function()};
  append(functions, std::move(seen));
  return functions;
}

}  // namespace heightlight
