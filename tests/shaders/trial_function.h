#pragma once

#include <cmath>

#include "heightlight/shaders.h"

namespace heightlight {

/// A function of all that texts of shaders may have and the library's do without.
inline ShaderFunction trial_function() {
  return {
      .name = "turn",
      .formula = "a trial",
      .source = "",
      .error = "",
      .inputs =
          {{.name = "slope", .meaning = "slopes", .elements = 8},
           {.name = "d", .meaning = "a direction", .components = 3, .is_clamped = false, .is_unit = true}},
      .text = R"(float turn(float slope[8], vec3 d) {
  float sum = 0.0;
  float part = 0.125;
  int last = 7;
  if (d.z > 0.0) { last = 6; }
  for (int i = 0; i < 8; i++) {
    if (i > last) { continue; }
    sum += part * slope[i];
  }
  return sum + 0.1 * atan2(d.y, d.x) * float(last);
}
)",
      .twin = "this one",
      .evaluate =
          [](const float* in, float* out) {
            const float* d = in + 8;
            const int last = d[2] > 0 ? 6 : 7;
            float sum = 0;
            for (int i = 0; i <= last; ++i) sum += 0.125F * in[i];
            *out = sum +
                   0.1F * (d[0] == 0 && d[1] == 0 ? NAN : std::atan2(d[1], d[0])) * static_cast<float>(last);
          },
      .ulps = 32};  // Vulkan lets atan err by 4096
}

}  // namespace heightlight
