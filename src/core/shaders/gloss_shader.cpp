#include <cassert>

#include "heightlight/occlusion_forms.h"
#include "heightlight/shaders.h"
#include "shaders/shader_literal.h"
#include "shaders/text_template.h"

namespace heightlight {

std::string gloss_shader(ShaderLanguage language, int horizons) {
  assert(language == ShaderLanguage::glsl || language == ShaderLanguage::hlsl);
  const bool is_glsl = language == ShaderLanguage::glsl;
  const Replacements all{
      {"3", is_glsl ? "vec3" : "float3"},        {"4", is_glsl ? "vec4" : "float4"},
      {"atan2", is_glsl ? "atan" : "atan2"},     {"share", shader_literal(LobeConeConstants{}.share)},
      {"count", std::to_string(horizons)},       {"samples", std::to_string(kHorizonSamples)},
      {"side", std::to_string(kShaderTableSide)}};
  std::string text = kShareShader;
  for (const FormText* one : {&kDirectionalText, &kConeConeText, &kLagardeText, &kTableText, &kHorizonText})
    (text += '\n') += fill_in(one->shader, all);
  return text;
}

}  // namespace heightlight
