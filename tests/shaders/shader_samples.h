#pragma once

#include <vector>

#include "heightlight/shaders.h"

namespace heightlight {

/// Inputs of a function, sample behind sample: all combinations of values at and beside the ends of their
/// ranges, beyond them where they are clamped, and the rest drawn from all of the range, by a fixed seed.
/// `samples`: over twice as many as there are combinations.
std::vector<float> sample_inputs(const ShaderFunction& function, std::size_t samples);

}  // namespace heightlight
