#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "heightlight/gloss.h"
#include "heightlight/occlusion_forms.h"
#include "heightlight/shaders.h"

// GTSO's table as shaders read it, which the list of shader functions says where, and look_up in C++.

namespace heightlight {
namespace {

/// The table at texture coordinates, filtered as textures are.
double filter(const SpecularTable& table, double x, double y, double z) {
  const auto side = static_cast<std::size_t>(table.side);
  const double places[] = {x * table.side - 0.5, y * table.side - 0.5, z * table.side * table.side - 0.5};
  double sum = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::size_t at[3];
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double below = std::floor(places[axis]);
      const bool is_upper = (corner >> axis & 1U) != 0;
      const double largest = (axis == 2 ? table.side : 1) * table.side - 1;
      weight *= is_upper ? places[axis] - below : 1 - (places[axis] - below);
      at[axis] = static_cast<std::size_t>(std::clamp(below + (is_upper ? 1 : 0), 0.0, largest));
    }
    sum += weight * table.values[(at[2] * side + at[1]) * side + at[0]];
  }
  return sum / 255;
}

const ShaderFunction& find_function(const std::string& name) {
  for (const ShaderFunction& function : shader_functions()) {
    if (function.name == name) return function;
  }
  throw std::runtime_error("there is no " + name);
}

}  // namespace

TEST_CASE("GTSO's table, read where shaders read it, says what look_up says", "[gloss]") {
  const ShaderFunction& place = find_function("heightlight_table_place");
  const ShaderFunction& weigh = find_function("heightlight_table_weight");
  for (const int side : {8, 16}) {
    const SpecularTable table = make_specular_table(side);
    for (int i = 0; i <= 20; ++i) {
      for (int j = 1; j <= 10; ++j) {
        const float inputs[] = {static_cast<float>(i) / 20, static_cast<float>(7 * i % 21) / 14,
                                static_cast<float>(j) / 10, static_cast<float>(3 * i % 19 + 1) / 20,
                                static_cast<float>(side)};
        float at[4];
        float weight = 0;
        place.evaluate(inputs, at);
        weigh.evaluate(inputs + 3, &weight);
        const double found =
            (1 - weight) * filter(table, at[0], at[1], at[2]) + weight * filter(table, at[0], at[1], at[3]);
        const double expected =
            look_up(table, {.half_angle = angle_of_cosine(cone_cosine(SkyViewFactor<double>(inputs[0]))),
                            .apart = inputs[1],
                            .roughness = inputs[2],
                            .view_angle = std::acos(double{inputs[3]})});
        CAPTURE(side, i, j);
        CHECK(found == Approx(expected).margin(2e-5));  // places are of single precision
      }
    }
  }
}

}  // namespace heightlight
