// A, the sky view factor, of an array of floats.
#include <heightlight/solve.h>

#include <cstdio>

int main() {
  using namespace heightlight;
  Image<float> heights(256, 256);
  for (int i = 0; i < 256; ++i) heights(i, 128) = 0.05F;  // a wall of 5 cm across a metre that repeats
  const Surface surface = build_surface({.height = heights, .spacing = {1.0 / 256, 1.0 / 256}});
  const Results results = solve(surface, {.wanted = {.sky = true}});
  std::printf("A beside the wall: %.4f\n", static_cast<double>(results.sky_view_factor(0, 127)));
  std::printf("RMSE against exact walks: %.1e\n", results.evidence.sky_check->sky_view_factor);
}
