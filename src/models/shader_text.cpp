#include "models/shader_text.h"

#include <array>
#include <cstdio>
#include <utility>
#include <vector>

namespace heightlight {
namespace {

// One text for both languages, which differ in nothing else here than the name of three floats, $3. $name
// stands for a constant.
constexpr const char* kText =
    R"(// Closed forms of the total irradiance E/pi (unoccluded = 1) after all bounces, by Heightlight.
// albedo: that of the surface all around, in [0, 1], linear. Two kinds of ambient occlusion, both 1 = open:
//   alpha  plain share of the hemisphere's solid angle that sees the sky
//   sky    the same, cosine weighted (the AO of GTAO)
// Feeding one where the other is wanted ruins the result.

float heightlight_share(float x) { return min(max(x, 0.0), 1.0); }

// A/(1 - albedo (1 - A)): Jimenez et al., eq. 12. Inputs: sky.
float heightlight_uniform_neighbourhood(float sky, float albedo) {
  float a = heightlight_share(sky);
  float rest = (1.0 - albedo) + albedo * a;
  return rest > 0.0 ? a / rest : 1.0;
}

// a A^3 - b A^2 + c A, coefficients linear in albedo: Jimenez et al., eq. 33. Inputs: sky.
float heightlight_cubic(float sky, float albedo) {
  float a = heightlight_share(sky);
  float a3 = $a_slope * albedo + ($a_offset);
  float a2 = $b_slope * albedo + ($b_offset);
  float a1 = $c_slope * albedo + ($c_offset);
  return heightlight_share(((a3 * a - a2) * a + a1) * a);
}
float heightlight_cubic_fitted(float sky, float albedo) {
  float a = heightlight_share(sky);
  float a3 = $fitted_a_slope * albedo + ($fitted_a_offset);
  float a2 = $fitted_b_slope * albedo + ($fitted_b_offset);
  float a1 = $fitted_c_slope * albedo + ($fitted_c_offset);
  return heightlight_share(((a3 * a - a2) * a + a1) * a);
}

// F0 + albedo F1/(1 - albedo tau), from F0 and F1; 1 outside its domain.
float heightlight_bounce_sum(float direct, float first, float albedo) {
  float missing = 1.0 - direct;
  float brought = albedo * first;
  float rest = (1.0 - albedo) * missing + brought;
  return missing > 0.0 && rest > 0.0 ? direct + missing * (brought / rest) : 1.0;
}

// The study notes' eqs. 7 and 9 to 12. Inputs: alpha, not sky.
float heightlight_notes(float alpha, float albedo) {
  float a = heightlight_share(alpha);
  float direct = a * (1.0 + $direct_gain * pow(1.0 - a, $direct_power));
  float first = $first_gain * a * (1.0 - a) * sqrt(1.0 - a) * exp(-$first_decay * sqrt(sqrt(a)));
  return heightlight_bounce_sum(direct, first, albedo);
}
float heightlight_notes_fitted(float alpha, float albedo) {
  float a = heightlight_share(alpha);
  float direct = a * (1.0 + $fitted_direct_gain * (1.0 - a));
  float first = $fitted_first_gain * a * (1.0 - a) * sqrt(1.0 - a) * exp(-($fitted_first_decay) * sqrt(sqrt(a)));
  return heightlight_bounce_sum(direct, first, albedo);
}

// G = A + albedo (1 - A) n/(1 - albedo (1 - n)), n the mean sky view factor of what the texel sees: exact at
// albedo 0 and 1, no poles. Inputs: sky, and seen from one of the functions below, or a second channel that
// holds n (solved for at albedo $seen_albedo).
float heightlight_bounced(float sky, float seen, float albedo) {
  float a = heightlight_share(sky);
  float n = heightlight_share(seen);
  float rest = (1.0 - albedo) + albedo * n;
  return rest > 0.0 ? a + (1.0 - a) * (albedo * n / rest) : 1.0;
}

// n from A alone.
float heightlight_seen_from_sky(float sky) {
  return heightlight_share($offset + $slope * heightlight_share(sky));
}

// n from A and one number for the whole map, expected: seen.expected_sky_view_factor of heightlight simulate.
float heightlight_seen_from_map(float sky, float expected) {
  float d = heightlight_share(sky) - expected;
  return heightlight_share($map_offset + expected + d * ($map_slope + d * ($map_curvature)));
}

// n from A and one number for the whole map that its simulation found: seen.deep_sky_view_factor of simulate.
float heightlight_seen_from_deep(float sky, float deep) {
  return heightlight_share(deep + ($deep_slope + ($deep_bend) * deep) * heightlight_share(sky));
}

// n from A and its blur, weighted by 1 - A, a Gaussian of $blur_sigma texels.
float heightlight_seen_from_blur(float sky, float blurred) {
  return heightlight_share($blur_offset + blurred + $blur_slope * (heightlight_share(sky) - blurred));
}
)";

/// A form for three albedos at once.
struct VectorForm {
  const char* name;
  const char* declared;  ///< arguments before the albedo
  const char* passed;
};
constexpr std::array kVectorForms{
    VectorForm{"uniform_neighbourhood", "float sky", "sky"},
    VectorForm{"cubic", "float sky", "sky"},
    VectorForm{"cubic_fitted", "float sky", "sky"},
    VectorForm{"notes", "float alpha", "alpha"},
    VectorForm{"notes_fitted", "float alpha", "alpha"},
    VectorForm{"bounced", "float sky, float seen", "sky, seen"},
};

/// Nine digits tell all floats apart; a point makes an integer a float.
std::string literal(double value) {
  std::array<char, 40> digits{};
  std::snprintf(digits.data(), digits.size(), "%.9g", value);
  std::string text = digits.data();
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

using Constants = std::vector<std::pair<std::string, double>>;

void append_cubic(const std::string& prefix, const CubicConstants& cubic, Constants& all) {
  all.insert(all.end(), {{prefix + "a_slope", cubic.a_slope},
                         {prefix + "a_offset", cubic.a_offset},
                         {prefix + "b_slope", cubic.b_slope},
                         {prefix + "b_offset", cubic.b_offset},
                         {prefix + "c_slope", cubic.c_slope},
                         {prefix + "c_offset", cubic.c_offset}});
}

void append_notes(const std::string& prefix, const NotesConstants& notes, Constants& all) {
  all.insert(all.end(), {{prefix + "direct_gain", notes.direct_gain},
                         {prefix + "direct_power", notes.direct_power},
                         {prefix + "first_gain", notes.first_gain},
                         {prefix + "first_decay", notes.first_decay}});
}

Constants list_constants(const ShaderConstants& constants) {
  const SeenConstants& seen = constants.seen;
  Constants all{{"seen_albedo", kSeenAlbedo},
                {"blur_sigma", kBlurSigma},
                {"offset", seen.offset},
                {"slope", seen.slope},
                {"map_offset", seen.map_offset},
                {"map_slope", seen.map_slope},
                {"map_curvature", seen.map_curvature},
                {"deep_slope", seen.deep_slope},
                {"deep_bend", seen.deep_bend},
                {"blur_offset", seen.blur_offset},
                {"blur_slope", seen.blur_slope}};
  append_cubic("", {}, all);
  append_cubic("fitted_", constants.cubic, all);
  append_notes("", {}, all);
  append_notes("fitted_", constants.notes, all);
  return all;
}

bool is_name(char character) { return (character >= 'a' && character <= 'z') || character == '_'; }

/// The text with each $name in it replaced by that constant's digits.
std::string fill_in(const std::string& text, const Constants& constants) {
  std::string filled;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '$') {
      filled += text[i++];
      continue;
    }
    std::size_t end = i + 1;
    while (end < text.size() && is_name(text[end])) ++end;
    const std::string name = text.substr(i + 1, end - i - 1);
    for (const auto& [known, value] : constants) {
      if (known == name) filled += literal(value);
    }
    i = end;
  }
  return filled;
}

std::string vector_form(const VectorForm& form, const std::string& three_floats) {
  const std::string call = std::string("heightlight_") + form.name + '(' + form.passed + ", albedo.";
  return three_floats + " heightlight_" + form.name + '(' + form.declared + ", " + three_floats +
         " albedo) {\n  return " + three_floats + '(' + call + "x), " + call + "y), " + call + "z));\n}\n";
}

}  // namespace

std::string shader_text(ShaderLanguage language, const ShaderConstants& constants) {
  std::string text = fill_in(kText, list_constants(constants));
  text += "\n// The same for albedos of three channels.\n";
  for (const VectorForm& form : kVectorForms) {
    text += vector_form(form, language == ShaderLanguage::glsl ? "vec3" : "float3");
  }
  return text;
}

}  // namespace heightlight
