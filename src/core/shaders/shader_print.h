#pragma once

#include <string>

#include "heightlight/shaders.h"

namespace heightlight {

/// Translates text in the dialect that the head of shaders.h describes into a language. Lines that begin with
/// // stay as they are.
std::string print_source(const std::string& text, ShaderLanguage language);

/// Makes the function for albedos of three channels from the function for one.
ShaderFunction for_three_albedos(const ShaderFunction& function, ShaderLanguage language);

}  // namespace heightlight
