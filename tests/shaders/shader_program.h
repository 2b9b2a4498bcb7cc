#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "heightlight/shaders.h"

namespace heightlight {

/// Whether a command is there to be run.
bool has_command(const std::string& name);

/// A compute shader that applies one function of `text`, in a language that glslang reads or, as Godot's
/// text, is GLSL as well, to samples, as ComputeDevice runs it.
std::string program_text(const std::string& text, const ShaderFunction& function, ShaderLanguage language);

/// What glslang makes of it, found valid by spirv-val; empty, and what is wrong, where it is not.
std::vector<std::uint32_t> compile_program(const std::string& program, ShaderLanguage language,
                                           std::string& fault);

int input_floats(const ShaderFunction& function);

}  // namespace heightlight
