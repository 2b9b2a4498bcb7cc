// How far closed forms are from the simulation, on a heightmap of yours: judge_a_form HEIGHTMAP
#include <heightlight/closed_forms.h>
#include <heightlight/error.h>
#include <heightlight/files.h>
#include <heightlight/solve.h>

#include <cmath>
#include <cstdio>

int main(int argument_count, char** arguments) try {
  using namespace heightlight;
  if (argument_count != 2) return std::fputs("usage: judge_a_form HEIGHTMAP\n", stderr), 2;
  const LoadedHeightmap loaded = load_heightmap(arguments[1], {}, std::uint64_t{4} << 30);
  const Surface surface = build_surface(loaded.map);
  const double albedo = 0.8;
  const Results truth = solve(surface, {.wanted = {.sky = true, .totals = {{.constant = {albedo}}}}});

  for (const ClosedForm& form : closed_forms()) {
    if (form.extra != ExtraInput::none) continue;  // of AO alone
    double squares = 0;
    double texels = 0;
    for (std::size_t i = 0; i < truth.sky_view_factor.size(); ++i) {
      ModelInputs inputs;
      inputs.ambient_occlusion = AmbientOcclusion<double>(truth.ambient_occlusion.values[i]);
      inputs.sky_view_factor = SkyViewFactor<double>(truth.sky_view_factor.values[i]);
      const std::optional<double> total = form.evaluate(inputs, albedo);
      if (!total) continue;  // outside the form's domain, or a missing sample
      squares += std::pow(*total - truth.totals[0][0][i], 2);
      ++texels;
    }
    std::printf("%-24s %.4f  %s\n", form.name.c_str(), std::sqrt(squares / texels), form.description.c_str());
  }
  std::printf("the simulation's own RMSE %.1e\n", truth.evidence.total_checks[0].total_rmse);
} catch (const heightlight::Error& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
