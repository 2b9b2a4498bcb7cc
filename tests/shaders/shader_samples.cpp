#include "shaders/shader_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace heightlight {
namespace {

/// Places in a range, 0 to 1: its ends, and what is beside them. The first are those that matter most.
constexpr std::array kPlaces{0.0, 1.0, 1e-3, 1 - 1e-3, 0.5, 1e-6, 1 - 1e-6};

/// Of unit vectors.
constexpr std::array<std::array<float, 3>, 7> kDirections{
    {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0.6F, 0, 0.8F}}};

float at_place(const ShaderInput& input, double place) {
  return static_cast<float>(input.low + place * (input.high - input.low));
}

/// Values that stand for an input: one number per component.
using Values = std::vector<float>;

/// The value of an edge's number; vectors that are no unit vectors count by component.
Values edge_values(const ShaderInput& input, std::size_t number, std::size_t places) {
  if (input.is_unit) {
    const auto& direction = kDirections.at(number);
    return {direction[0], direction[1], input.is_above ? std::abs(direction[2]) : direction[2]};
  }
  Values values;
  for (int c = 0; c < float_count(input); ++c) {
    values.push_back(at_place(input, kPlaces.at(number % places)));
    number /= places;
  }
  return values;
}

Values drawn_values(const ShaderInput& input, std::mt19937& random) {
  const auto draw = [&] { return static_cast<double>(random()) / 4294967296.0; };
  if (input.is_unit) {
    const double z = input.is_above ? draw() : 2 * draw() - 1;
    const double azimuth = 2 * 3.141592653589793 * draw();
    const double r = std::sqrt(1 - z * z);
    return {static_cast<float>(r * std::cos(azimuth)), static_cast<float>(r * std::sin(azimuth)),
            static_cast<float>(z)};
  }
  Values values;
  for (int c = 0; c < float_count(input); ++c) {
    const double place = draw();
    constexpr double kBeyond = 0.1;
    values.push_back(at_place(input, input.is_clamped ? place * (1 + 2 * kBeyond) - kBeyond : place));
  }
  return values;
}

std::size_t edge_count(const ShaderInput& input, std::size_t places) {
  if (input.is_unit) return kDirections.size();
  return static_cast<std::size_t>(std::min(std::pow(static_cast<double>(places), float_count(input)), 1e9));
}

/// Values at edges, whichever.
Values drawn_edges(const ShaderInput& input, std::mt19937& random) {
  if (input.is_unit) return edge_values(input, random() % kDirections.size(), kPlaces.size());
  Values values;
  for (int c = 0; c < float_count(input); ++c)
    values.push_back(at_place(input, kPlaces[random() % kPlaces.size()]));
  return values;
}

}  // namespace

std::vector<float> sample_inputs(const ShaderFunction& function, std::size_t samples) {
  std::size_t places = kPlaces.size();
  const auto combinations = [&] {
    std::size_t count = 1;
    for (const ShaderInput& input : function.inputs) count *= std::min(edge_count(input, places), samples);
    return count;
  };
  while (places > 2 && 2 * combinations() > samples) --places;
  const bool are_all = 2 * combinations() <= samples;
  const std::size_t edges = are_all ? combinations() : samples / 2;
  std::mt19937 random(7);
  std::vector<float> inputs;
  for (std::size_t i = 0; i < samples; ++i) {
    std::size_t rest = i;
    for (const ShaderInput& input : function.inputs) {
      const std::size_t count = std::min(edge_count(input, places), samples);
      const Values values = i >= edges ? drawn_values(input, random)
                            : !are_all ? drawn_edges(input, random)
                                       : edge_values(input, rest % count, places);
      rest /= count;
      inputs.insert(inputs.end(), values.begin(), values.end());
    }
  }
  return inputs;
}

}  // namespace heightlight
