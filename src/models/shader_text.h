#pragma once

#include <string>

#include "heightlight/models.h"

namespace heightlight {

enum class ShaderLanguage { glsl, hlsl };

/// Constants as fitted, to stand beside the published ones.
struct ShaderConstants {
  NotesConstants notes;
  CubicConstants cubic;
  SeenConstants seen;
};

/// The closed forms as functions to paste into a shader, for one albedo and for three (vec3, float3): names
/// begin with heightlight_, forms with fitted constants end in _fitted. They compute what
/// heightlight/models.h does, in the shader's precision.
std::string shader_text(ShaderLanguage language, const ShaderConstants& constants);

}  // namespace heightlight
