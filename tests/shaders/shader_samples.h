#pragma once

#include <vector>

#include "heightlight/shaders.h"

namespace heightlight {

/// Inputs of a function, sample behind sample: all combinations of values at and beside the ends of their
/// ranges or, where these are more than half of the samples, some of them; and the rest drawn from all of the
/// range, and beyond it where they are clamped, by a fixed seed.
std::vector<float> sample_inputs(const ShaderFunction& function, std::size_t samples);

}  // namespace heightlight
