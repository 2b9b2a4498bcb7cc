#include <array>
#include <string>
#include <utility>
#include <vector>

#include "forms/shader_literal.h"
#include "heightlight/closed_forms.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr const char* kHead =
    R"(// Closed forms of the total irradiance E/pi (unoccluded = 1) after all bounces, by Heightlight.
// albedo: that of the surface all around, in [0, 1], linear. Two kinds of ambient occlusion, both 1 = open:
//   alpha  plain share of the hemisphere's solid angle that sees the sky
//   sky    the same, cosine weighted (the AO of GTAO)
// Feeding one where the other is wanted ruins the result.

)";

/// Of the reports' fits of F0, the shader's is the one that stays below 1.
const std::string kFittedNotesHead =
    "// Fitted: F0 with power 1, so that it is at most 1 (notes_direct_bounded in the report of a fit; its\n"
    "// notes_direct has a power of its own, and may exceed 1), F1 as notes_first_bounce.\n";

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

/// What stands for each $name.
using Replacements = std::vector<std::pair<std::string, std::string>>;

template <class Constants, std::size_t kCount>
Replacements list_constants(const FormConstant<Constants> (&constants)[kCount], const Constants& values,
                            const std::string& suffix = "") {
  Replacements all{{"suffix", suffix}};
  for (const FormConstant<Constants>& constant : constants) {
    all.emplace_back(constant.name, shader_literal(values.*constant.value));
  }
  return all;
}

bool is_name(char character) {
  return (character >= 'a' && character <= 'z') || character == '_' || (character >= '0' && character <= '9');
}

/// The text with each $name in it replaced. Where no replacement has a name, nothing takes its place.
std::string fill_in(const std::string& text, const Replacements& replacements) {
  std::string filled;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] != '$') {
      filled += text[i++];
      continue;
    }
    std::size_t end = i + 1;
    while (end < text.size() && is_name(text[end])) ++end;
    const std::string name = text.substr(i + 1, end - i - 1);
    for (const auto& [known, value] : replacements) {
      if (known == name) filled += value;
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

const char* three_floats(ShaderLanguage language) {
  return language == ShaderLanguage::glsl ? "vec3" : "float3";
}

/// The project's own constants.
Replacements own_constants(const SeenConstants& constants) {
  Replacements seen = list_constants(kSeenConstants, constants);
  seen.emplace_back("seen_albedo", shader_literal(kSeenAlbedo));
  seen.emplace_back("blur_sigma", shader_literal(kBlurSigma));
  return seen;
}

/// A form by itself: its functions as published, and the one for three albedos.
struct ShadedForm {
  std::string name;    ///< as in the list of forms
  std::string vector;  ///< among kVectorForms; empty where it has none
  std::string text;
};

std::vector<ShadedForm> shaded_forms() {
  const Replacements seen = own_constants({});
  const std::string notes = fill_in(kNotesText.shader, list_constants(kNotesConstants, NotesConstants{}));
  const std::string bounced = fill_in(kBouncedText.shader, seen);
  std::vector<ShadedForm> forms{
      {kNotesText.name, "notes", notes},
      {"notes_guarded", "notes", notes},
      {kUniformNeighbourhoodText.name, "uniform_neighbourhood", kUniformNeighbourhoodText.shader},
      {kCubicText.name, "cubic",
       fill_in(kCubicText.shader, list_constants(kCubicConstants, CubicConstants{}))},
      {kBouncedText.name, "bounced", bounced}};
  for (const FormText* one : {&kSeenFromSkyText, &kSeenFromMapText, &kSeenFromDeepText, &kSeenFromBlurText})
    forms.emplace_back(ShadedForm{one->name, "bounced", bounced})
        .text.append("\n")
        .append(fill_in(one->shader, seen));
  return forms;
}

}  // namespace

std::string shader_text(ShaderLanguage language, const ShaderConstants& constants) {
  const Replacements seen = own_constants(constants.seen);
  std::string text = kHead;
  const auto append = [&text](const std::string& part) { (text += part) += '\n'; };
  append(kShareShader);
  append(kUniformNeighbourhoodText.shader);
  append(fill_in(kCubicText.shader, list_constants(kCubicConstants, CubicConstants{})));
  append(fill_in(kCubicText.shader, list_constants(kCubicConstants, constants.cubic, "_fitted")));
  // The fitted form shares the sum of the bounces with the published one.
  const std::string notes = kNotesText.shader;
  const std::string form = notes.substr(notes.find("\n\n") + 2);
  append(fill_in(notes, list_constants(kNotesConstants, NotesConstants{})));
  append(kFittedNotesHead + fill_in(form, list_constants(kNotesConstants, constants.notes, "_fitted")));
  for (const FormText* one :
       {&kBouncedText, &kSeenFromSkyText, &kSeenFromMapText, &kSeenFromDeepText, &kSeenFromBlurText}) {
    append(fill_in(one->shader, seen));
  }
  text += "// The same for albedos of three channels.\n";
  for (const VectorForm& one : kVectorForms) text += vector_form(one, three_floats(language));
  return text;
}

std::string form_shader(const std::string& name, ShaderLanguage language) {
  std::string known;
  for (const ShadedForm& form : shaded_forms()) {
    known += (known.empty() ? "" : ", ") + form.name;
    if (form.name != name) continue;
    std::string text = kHead;
    for (const std::string& part : {std::string(kShareShader), form.text}) (text += part) += '\n';
    for (const VectorForm& one : kVectorForms) {
      if (one.name == form.vector) text += vector_form(one, three_floats(language));
    }
    return text;
  }
  throw UsageError("form", name, "has no shader; these have: " + known);
}

std::string stored_pair_shader(ShaderLanguage language) {
  const std::string two = language == ShaderLanguage::glsl ? "vec2" : "float2";
  return fill_in(kStoredPairShader, {{"2", two}, {"3", three_floats(language)}});
}

}  // namespace heightlight
