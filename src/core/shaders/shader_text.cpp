#include <algorithm>
#include <string>
#include <vector>

#include "base/digits.h"
#include "heightlight/closed_forms.h"
#include "heightlight/error.h"
#include "heightlight/shaders.h"
#include "heightlight/version.h"
#include "shaders/gloss_functions.h"
#include "shaders/shader_print.h"

namespace heightlight {
namespace {

constexpr const char* kFormsHead =
    R"(// Closed forms of the total irradiance E/pi (unoccluded = 1) after all bounces, by Heightlight.
// albedo: that of the surface all around, in [0, 1], linear. Two kinds of ambient occlusion, both 1 = open:
//   alpha  plain share of the hemisphere's solid angle that sees the sky
//   sky    the same, cosine weighted (the AO of GTAO)
// Feeding one where the other is wanted ruins the result.
)";

constexpr const char* kCountOnce =
    R"(// Count bounces once. What functions of an albedo return holds all bounces already: multiply the sky's diffuse
// light by it, and feed it to nothing that brightens occlusion again: not to another of these functions, no
// "multi-bounce" or "coloured" AO of an engine, no screen-space or traced bounce of the same relief, no baked
// light that holds it. An engine that does one of these wants the plain A (sky).
)";

constexpr const char* kStoredPairHead =
    "// Irradiance of all bounces over that of an open place, under an even sky, at any albedo: multi_bounce "
    "of the\n"
    "// two channels of a map that heightlight bake --maps ao-n wrote. Stands alone.\n";

constexpr const char* kGlossHead =
    R"(// What a glossy lobe sees of an even sky (S, 1 = open), and diffuse light of a sky that is not even, from maps of
// heightlight bake: functions of its shaders command, which has them in one file with all others.
)";

constexpr const char* kLibraryHead =
    R"(// Irradiance is E/pi, that of an open place being 1. Two kinds of ambient occlusion, both 1 = open, which must not
// be taken for each other:
//   alpha  plain share of the hemisphere's solid angle that sees the sky
//   sky    A, the same, cosine weighted (the AO of GTAO)
// Measured errors: per texel on 43 map x relief cases of 17 materials, an even sky (plots/data/models.csv of
// Heightlight's sources), of its own forms on materials that their constants were not fitted to; of cones:
// plots/data/directional_*.csv. docs/shaders.md tells which function is for what. May be used without attribution.
)";

/// What the head of a file says of its language.
const char* describe_language(ShaderLanguage language) {
  switch (language) {
    case ShaderLanguage::glsl:
      return "// GLSL 1.30 and later, and GLSL ES 3.00, where precision must be highp. Compiled by glslang, "
             "executed "
             "and\n// compared with the C++ on Vulkan in Heightlight's tests.\n";
    case ShaderLanguage::hlsl:
      return "// HLSL, shader model 4 and later. Compiled by glslang, executed and compared with the C++ on "
             "Vulkan "
             "in\n// Heightlight's tests.\n";
    case ShaderLanguage::wgsl:
      return "// WGSL. Validated by Dawn's compiler in Heightlight's tests; not executed there. Functions "
             "for three "
             "albedos\n// end in _rgb.\n";
    case ShaderLanguage::godot:
      return "// Godot 4, to be included: #include \"heightlight.gdshaderinc\". Compiled by Godot 3.2 in "
             "Heightlight's tests, not\n// by Godot 4; as GLSL, which it is too, executed there and compared "
             "with "
             "the C++. Functions for three albedos\n// end in _rgb.\n";
  }
  return "";
}

/// Wraps text into comment lines that end before column 119, with all lines but the first indented.
std::string print_comment(const std::string& text, const std::string& indent = "") {
  constexpr std::size_t kColumns = 118;
  std::string printed;
  std::string line = "//";
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t end = std::min(text.find(' ', i), text.size());
    if (line.size() + 1 + end - i > kColumns) {
      printed += line + '\n';
      line = "//" + indent;
    }
    line += ' ' + text.substr(i, end - i);
    i = end + 1;
  }
  return printed + line + '\n';
}

std::string print_range(const ShaderInput& input) {
  if (input.is_unit) return std::string("a unit vector") + (input.is_above ? ", z not below 0" : "");
  constexpr int kDigits = 3;
  return in_digits(input.low, kDigits) + " to " + in_digits(input.high, kDigits) +
         (input.is_clamped ? ", clamped" : "");
}

std::string print_function(const ShaderFunction& function, ShaderLanguage language) {
  std::string text = print_comment(function.formula + '.');
  if (!function.source.empty()) text += print_comment("Source: " + function.source + '.');
  if (!function.error.empty()) text += print_comment("Measured error: " + function.error + '.');
  for (const ShaderInput& input : function.inputs)
    text += print_comment("  " + input.name + ": " + input.meaning + "; " + print_range(input), "    ");
  return text + print_source(function.text, language);
}

/// The shader functions that `text` calls, and those that these call, in the order of the list, without those
/// in `there`.
std::vector<ShaderFunction> called_in(std::string text, const std::vector<ShaderFunction>& there = {}) {
  const std::vector<ShaderFunction>& all = shader_functions();
  std::vector<ShaderFunction> called;
  for (auto function = all.rbegin(); function != all.rend(); ++function) {  // callers before what they call
    if (text.find(function->name + '(') == std::string::npos) continue;
    if (std::any_of(there.begin(), there.end(),
                    [&](const ShaderFunction& one) { return one.name == function->name; }))
      continue;
    text += function->text;
    called.insert(called.begin(), *function);
  }
  return called;
}

/// A form of the list of closed forms, and the shader calls that compute it.
struct ShadedForm {
  std::string form;
  std::string calls;
};

const std::vector<ShadedForm>& shaded_forms() {
  static const std::vector<ShadedForm> forms{
      {kNotesText.name, "heightlight_notes()"},
      {"notes_guarded", "heightlight_notes()"},
      {kUniformNeighbourhoodText.name, "heightlight_uniform_neighbourhood()"},
      {kCubicText.name, "heightlight_cubic()"},
      {kBouncedText.name, "heightlight_bounced()"},
      {kSeenFromSkyText.name, "heightlight_bounced(heightlight_seen_from_sky())"},
      {kSeenFromMapText.name, "heightlight_bounced(heightlight_seen_from_map())"},
      {kSeenFromDeepText.name, "heightlight_bounced(heightlight_seen_from_deep())"},
      {kSeenFromBlurText.name, "heightlight_bounced(heightlight_seen_from_blur())"},
  };
  return forms;
}

std::string forms_head() { return std::string(kFormsHead) + "//\n" + kCountOnce + '\n'; }

}  // namespace

std::string print_shader(const std::vector<ShaderFunction>& functions, ShaderLanguage language) {
  std::string text;
  std::string vectors;
  for (const ShaderFunction& function : functions) {
    text += print_function(function, language) + '\n';
    if (function.is_per_channel)
      vectors += print_source(for_three_albedos(function, language).text, language);
  }
  if (vectors.empty()) {
    text.pop_back();
    return text;
  }
  return text + "// The same for albedos of three channels.\n" + vectors;
}

std::string shader_library_mark() { return "// Heightlight's formulas as shader functions"; }

std::string shader_library(ShaderLanguage language) {
  return shader_library_mark() +
         ", version " HEIGHTLIGHT_VERSION ", written by: heightlight shaders, which replaces it\n" +
         describe_language(language) + "//\n" + kLibraryHead + "//\n" + kCountOnce + '\n' +
         print_shader(shader_functions(), language);
}

std::string shader_text(ShaderLanguage language, const ShaderConstants& constants,
                        const std::vector<ShaderFunction>& own) {
  std::vector<ShaderFunction> functions = fitted_shader_functions(constants);
  functions.insert(functions.end(), own.begin(), own.end());
  return forms_head() + print_shader(functions, language);
}

std::string own_shader(const std::vector<ShaderFunction>& own, ShaderLanguage language) {
  std::string text;
  for (const ShaderFunction& function : own) text += function.text;
  std::vector<ShaderFunction> functions = called_in(text, own);
  for (ShaderFunction& function : functions) function.is_per_channel = false;  // as parts of others
  functions.insert(functions.end(), own.begin(), own.end());
  return print_shader(functions, language);
}

std::string gloss_shader(ShaderLanguage language, int horizons) {
  return std::string(kGlossHead) + '\n' + own_shader(gloss_functions(horizons), language);
}

std::string form_shader(const std::string& name, ShaderLanguage language) {
  std::string known;
  for (const ShadedForm& form : shaded_forms()) {
    known += (known.empty() ? "" : ", ") + form.form;
    if (form.form == name) return forms_head() + print_shader(called_in(form.calls), language);
  }
  throw UsageError("form", name, "has no shader; these have: " + known);
}

std::string stored_pair_shader(ShaderLanguage language) {
  std::vector<ShaderFunction> functions = called_in("multi_bounce()");
  for (ShaderFunction& function : functions) function.is_per_channel = false;  // the pair's is
  return std::string(kStoredPairHead) + "//\n" + kCountOnce + '\n' + print_shader(functions, language);
}

}  // namespace heightlight
