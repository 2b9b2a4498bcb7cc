#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "heightlight/closed_forms.h"
#include "heightlight/screenspace.h"
#include "heightlight/transport.h"
#include "test_maps.h"

// Errors of the kind that docs/accuracy.md states, on maps small enough for every run, against figures.csv
// beside this file. Two thresholds for each: past `typical` the test warns, and the handbook's figures want a
// new look; past `hard` it fails.

namespace heightlight {
namespace {

constexpr double kAlbedo = 0.8;

struct GoldenFigure {
  std::string name;
  double value = 0;  ///< when it was entered
  double typical = 0;
  double hard = 0;
};

std::vector<GoldenFigure> read_figures() {
  std::ifstream file(std::string(HEIGHTLIGHT_SOURCE_DIR) + "/tests/golden/figures.csv");
  std::vector<GoldenFigure> figures;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    GoldenFigure& figure = figures.emplace_back();
    char comma = 0;
    std::getline(fields, figure.name, ',');
    fields >> figure.value >> comma >> figure.typical >> comma >> figure.hard;
    REQUIRE(fields);
  }
  return figures;
}

/// RMS over the texels of what `value_of` says less the simulation's.
double rms_error(const TexelVector& truth, const std::function<double(std::size_t)>& value_of) {
  double squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double error = value_of(i) - truth[i];
    squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(truth.size()));
}

/// In the order of figures.csv.
std::vector<double> measure(const char* shape) {
  const Surface surface = build_surface(make_synth_map(shape, 256, Boundary::tile, 0.1));
  const PlannedTransport planned = plan_horizon_transport(surface, {});
  const Transport& transport = *planned.transport;
  const TexelVector total = transport.solve({{.albedo = kAlbedo}}, {}).irradiance[0];
  const HorizonCheck check =
      check_by_exact_walks(surface, transport.direct, {{.total = total, .albedo = kAlbedo}})[0];
  GtaoOptions preset;
  preset.radius = 0.1;
  const ScreenSpaceView view = gtao(make_depth_buffer(surface), preset);
  const auto sky = [&](std::size_t i) { return SkyViewFactor(double{transport.sky_view_factor.values[i]}); };
  return {
      check.sky_rmse, check.total_rmse,
      rms_error(transport.direct, [&](std::size_t i) { return double{view.sky_view_factor.values[i]}; }),
      rms_error(total, [&](std::size_t i) { return uniform_neighbourhood(sky(i), kAlbedo); }),
      rms_error(total, [&](std::size_t i) { return bounced_total(sky(i), guess_seen(sky(i)), kAlbedo); })};
}

TEST_CASE("errors on the project's own maps are what they were", "[golden][slow]") {
  const std::vector<GoldenFigure> figures = read_figures();
  std::size_t next = 0;
  for (const char* shape : {"brick", "fbm", "cobbles"}) {
    for (const double value : measure(shape)) {
      REQUIRE(next < figures.size());
      const GoldenFigure& figure = figures[next++];
      INFO(figure.name << ": " << value << ", was " << figure.value << ", typically up to " << figure.typical
                       << ", at most " << figure.hard);
      REQUIRE(figure.name.starts_with(shape));
      CHECK(value <= figure.hard);
      if (value > figure.typical) WARN(figure.name << " is " << value << ", typically " << figure.typical);
    }
  }
  CHECK(next == figures.size());
}

}  // namespace
}  // namespace heightlight
