#pragma once

#include <string>

#include "heightlight/shaders.h"

namespace heightlight {

/// Text as the head of shaders.h says, in a language. Lines that begin with // stay as they are.
std::string print_source(const std::string& text, ShaderLanguage language);

/// The function for albedos of three channels, made of the one for one.
ShaderFunction for_three_albedos(const ShaderFunction& function, ShaderLanguage language);

}  // namespace heightlight
