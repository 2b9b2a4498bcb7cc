// Light after all bounces on a brick wall of one colour, with the evidence for it.
#include <heightlight/solve.h>
#include <heightlight/synth.h>

#include <cstdio>
#include <vector>

int main() {
  using namespace heightlight;
  Image<float> heights = synthesize("brick", 256, 1);
  for (float& height : heights.values) height *= 0.1F;  // a tenth of the width
  const Surface surface = build_surface({.height = heights, .spacing = {1.0 / 256, 1.0 / 256}});

  Request request;
  request.wanted.totals = {{.constant = {0.63, 0.32, 0.18}}};  // a brick's reflectance, linear R, G, B
  request.accuracy.error = 0.005;
  request.limits = {.memory = std::uint64_t{1} << 30, .threads = 2};
  request.watch.tell = [](const Step& step) {
    if (step.ended) std::printf("done: %.*s\n", static_cast<int>(step.name.size()), step.name.data());
  };
  const Results results = solve(surface, request);

  for (const TexelVector& channel : results.totals[0]) {
    double sum = 0;
    for (const double value : channel) sum += value;
    std::printf("mean E/pi %.4f\n", sum / static_cast<double>(channel.size()));
  }
  const Evidence& evidence = results.evidence;
  std::printf("RMSE of red %.1e, on %d receivers; %d azimuths for the sky, %llu links in %.1f MB\n",
              evidence.total_checks[0].total_rmse, evidence.total_checks[0].receivers, evidence.azimuths,
              static_cast<unsigned long long>(evidence.links),
              static_cast<double>(evidence.link_bytes) / 1e6);
}
