#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/terrain_forms.h"
#include "scratch_folder.h"
#include "terrain/terrain_csv.h"
#include "terrain/terrain_report.h"
#include "terrain/terrain_study.h"
#include "test_maps.h"
#include "visibility/exact_walk.h"

// The study of terrain: its truth, its tables, and what it refuses.

namespace heightlight {
namespace {

const Sun kMorning{.azimuth_rad = -0.3, .elevation_rad = 0.5};

Surface rugged_surface() { return build_surface(make_synth_map("fbm", 48, Boundary::open, 0.3)); }

TrialOptions small_options() {
  return {.albedos = {0.2, 0.9}, .sun = kMorning, .window_cells = {2, 8}, .error = 0.002};
}

const TerrainFormRow& row_of(const TerrainTrial& trial, const std::string& light, double albedo,
                             const std::string& form) {
  return *std::find_if(trial.rows.begin(), trial.rows.end(), [&](const TerrainFormRow& row) {
    return row.light == light && row.albedo == albedo && row.form == form;
  });
}

TEST_CASE("the truth of definitions is that of exact walks", "[terrain]") {
  const Surface surface = build_surface(make_rough_map(20, 14, Boundary::open, 0.2, 0.2, 2));
  const std::vector<std::size_t> receivers = pick_receivers(surface, 60, 1);
  REQUIRE(receivers.size() == 60);
  CHECK(std::set<std::size_t>(receivers.begin(), receivers.end()).size() == 60);
  CHECK(std::is_sorted(receivers.begin(), receivers.end()));
  const std::vector<double> values = find_exactly(surface, 32, receivers, {SkyDefinition::svf_tilted});
  const ExactWalker walker(surface, 32);
  SliceView view;
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    walker.view(static_cast<int>(receivers[i]) / 20, static_cast<int>(receivers[i]) % 20, view);
    CHECK(values[i] == Approx(view.sky_view_factor).margin(1e-9));  // identity
  }
  CHECK(pick_receivers(surface, 10000, 1).size() == surface.map.height.size() - count_missing(surface.map));
}

TEST_CASE("differences are measured", "[terrain]") {
  std::vector<double> differences{0.1, -0.3, 0.1, 0.1};
  const QuantityError error = measure_differences(differences);
  CHECK(error.bias == Approx(0).margin(1e-15));
  CHECK(error.rmse == Approx(std::sqrt(0.03)));
  CHECK(error.p95 == Approx(0.3 - 0.15 * 0.2));
}

TEST_CASE("forms are tried under the sky and the sun, and their table agrees with itself", "[terrain]") {
  const Surface surface = rugged_surface();
  const TrialOptions options = small_options();
  const TerrainTrial trial = try_terrain_forms(surface, options);
  std::size_t expected = 0;
  for (const TerrainForm& form : terrain_forms())
    expected += (form.even_sky_only ? 1 : 2) * (form.wants_window ? 2 : 1) * options.albedos.size();
  CHECK(trial.rows.size() == expected);
  for (const TerrainFormRow& row : trial.rows) {
    INFO(row.light << " " << row.albedo << " " << row.form << " " << row.window);
    CHECK(row.error.rmse >= std::fabs(row.error.bias));
    CHECK(row.reflected > 0);
    CHECK(row.reflected == row_of(trial, row.light, row.albedo, "none").reflected);
    CHECK(std::isfinite(row.error.rmse));
  }
  for (const std::string light : {"sky", "sun"}) {
    const double most = light == "sky" ? 0.5 : 0.85;  // where a sun leaves shadows, no mean is everybody's
    for (const double albedo : options.albedos) {
      const TerrainFormRow& none = row_of(trial, light, albedo, "none");
      CHECK(none.error.bias == Approx(-none.reflected));  // identity: direct irradiance is all that it has
      CHECK(row_of(trial, light, albedo, "seen_from_deep").error.rmse < most * none.error.rmse);
      CHECK(row_of(trial, light, albedo, "window_series").error.rmse < most * none.error.rmse);
    }
  }
  CHECK(row_of(trial, "sky", 0.9, "seen_from_deep").error.rmse < 0.01);
  REQUIRE(trial.lights.size() == 2);
  CHECK(trial.lights[1].level == Approx(std::sin(kMorning.elevation_rad)));
  CHECK(trial.lights[0].mean_direct == Approx(trial.mean_sky).margin(1e-6));
  CHECK(trial.mean_upper_sky < trial.mean_sky);
  for (const TrialLight& light : trial.lights) CHECK(light.evidence.total_checks.size() == 2);
}

TEST_CASE("a level plain reflects nothing that anybody sees", "[terrain]") {
  const Surface plain = build_surface(make_map(12, 9, Boundary::open, [](int, int) { return 1; }));
  for (const TerrainFormRow& row : try_terrain_forms(plain, small_options()).rows) {
    INFO(row.form);
    CHECK(row.reflected == Approx(0).margin(1e-7));  // gathers hold light in floats
    CHECK(row.error.rmse == Approx(0).margin(row.form == "cubic" ? 1e-3 : 1e-7));
  }
}

TEST_CASE("a study compares methods, and its errors do not depend on threads", "[terrain]") {
  const Surface surface = rugged_surface();
  const auto with_threads = [&](int threads) {
    const ThreadScope scope(threads);
    return study_terrain(surface, small_options());
  };
  const TerrainStudy study = with_threads(1);
  const TerrainStudy other = with_threads(2);
  REQUIRE(study.trial.rows.size() == other.trial.rows.size());
  for (std::size_t i = 0; i < study.trial.rows.size(); ++i)
    CHECK(study.trial.rows[i].error.rmse == other.trial.rows[i].error.rmse);
  CHECK(study.receivers == surface.map.height.size());
  // Two marches of four azimuths and two reaches, the second all; walks, and exact horizons; three plans.
  REQUIRE(study.methods.size() == terrain_quantities().size() * (2 * 4 * 2 + 4 + 4 + 3));
  REQUIRE(study.methods.size() == other.methods.size());
  const auto rmse = [&](const std::string& method, int azimuths, const TerrainQuantity& quantity) {
    const auto row =
        std::find_if(study.methods.begin(), study.methods.end(), [&](const TerrainMethodRow& one) {
          return one.method == method && one.azimuths == azimuths && one.cells == 0 &&
                 one.quantity == quantity;
        });
    REQUIRE(row != study.methods.end());
    return row->error.rmse;
  };
  for (std::size_t i = 0; i < study.methods.size(); ++i) {
    const TerrainMethodRow& row = study.methods[i];
    CHECK(row.error.rmse == other.methods[i].error.rmse);
    CHECK(row.error.rmse >= std::fabs(row.error.bias));
    CHECK(row.cost.core > 0);
    CHECK(row.per_megatexel == Approx(row.cost.core / (48 * 48 * 1e-6)));
    if (row.error_wanted > 0) CHECK(row.error.rmse < 1.5 * row.error_wanted);
  }
  for (const TerrainQuantity& quantity : terrain_quantities()) {
    INFO(name_of(quantity));
    CHECK(rmse(kExactHorizonMethod, 64, quantity) < 0.2 * rmse(kExactHorizonMethod, 8, quantity));
    CHECK(rmse(kExactHorizonMethod, 64, quantity) < 0.2 * rmse(kRayMarchMethod, 64, quantity));
    CHECK(rmse(kWalkMethod, 64, quantity) < 0.3 * rmse(kRayMarchMethod, 64, quantity));
  }
  const ScratchFolder folder;
  write_terrain_forms_csv(folder / "forms.csv", study.trial.rows);
  write_terrain_methods_csv(folder / "methods.csv", study.methods);
  const std::vector<Warning> warnings{{.message = "a *warning*", .remedy = {}}};
  write_terrain_report(folder / "terrain.md",
                       {.map_name = "map", .surface = surface, .study = study, .warnings = warnings});
  const auto lines_of = [&](const char* name) {
    const std::string text = read_text(folder / name);
    CHECK(text.find("nan") == std::string::npos);
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
  };
  CHECK(lines_of("forms.csv") == study.trial.rows.size() + 1);
  CHECK(lines_of("methods.csv") == study.methods.size() + 1);
  CHECK(lines_of("terrain.md") > 150);
}

TEST_CASE("a study refuses maps that tile, suns that cannot be, albedos that are none", "[terrain]") {
  const Surface tile = build_surface(make_synth_map("sines", 16, Boundary::tile, 0.2));
  CHECK_THROWS_AS(study_terrain(tile, small_options()), UsageError);
  const Surface open = build_surface(make_synth_map("sines", 16, Boundary::open, 0.2));
  TrialOptions options = small_options();
  options.sun.elevation_rad = -0.1;
  CHECK_THROWS_AS(study_terrain(open, options), UsageError);
  options = small_options();
  options.albedos = {1.5};
  CHECK_THROWS_AS(study_terrain(open, options), UsageError);
  const Surface missing =
      build_surface(make_map(4, 4, Boundary::open, [](int, int) { return std::nan(""); }));
  CHECK_THROWS_AS(study_terrain(missing, small_options()), Error);
}

}  // namespace
}  // namespace heightlight
