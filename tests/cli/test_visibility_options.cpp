#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "command.h"
#include "results.h"

namespace heightlight {
namespace {

/// Simulates `map`, which must succeed without a word of complaint, and returns the summary.
nlohmann::json simulate(const ScratchFolder& folder, const std::string& map, const std::string& results,
                        const std::string& options) {
  const CommandResult run = run_command("simulate " + map + " -o " + results + " " + options, folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.error.empty());
  nlohmann::json summary = read_summary(folder / results);
  check_energy(summary);
  return summary;
}

TEST_CASE("simulate walks horizons unless told otherwise, and says how, and how well", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 96", folder).exit_code == 0);
  const std::string options = GENERATE("", "--visibility horizon --error 0.002");
  const nlohmann::json visibility = simulate(folder, "b.png", "out", options)["visibility"];
  CHECK(visibility["method"] == "horizon");
  CHECK(visibility["rays"].is_null());
  CHECK(visibility["error_wanted"] == 0.002);
  CHECK(visibility["azimuths"].get<int>() >= 4);
  CHECK(visibility["azimuths"].get<int>() % 2 == 0);
  CHECK(visibility["fineness"].get<int>() >= 8);
  CHECK(visibility["gathers"]["azimuths"].get<int>() >= 2);
  CHECK(visibility["gathers"]["fineness"].get<int>() >= 8);
  CHECK(visibility["expected_rmse"]["sky_view_factor"].get<double>() > 0);
  CHECK(visibility["expected_rmse"]["total_from_gathers"].get<double>() > 0);
  CHECK(visibility["checked"]["receivers"].get<int>() >= 256);
  CHECK(visibility["rmse_estimate"] == visibility["checked"]["sky_view_factor_rmse"]);
  // Monte Carlo: as in the tests of plans
  CHECK(visibility["checked"]["sky_view_factor_rmse"].get<double>() < 1.5 * 0.002);
  CHECK(visibility["checked"]["total_rmse"].get<double>() < 1.5 * 0.002);
}

TEST_CASE("the option --error buys accuracy with azimuths, which --azimuths fixes", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o f.exr --size 96", folder).exit_code == 0);
  const nlohmann::json coarse = simulate(folder, "f.exr", "coarse", "--relief 0.3 --error 0.02");
  const nlohmann::json fine = simulate(folder, "f.exr", "fine", "--relief 0.3 --error 0.002");
  const nlohmann::json fixed = simulate(folder, "f.exr", "fixed", "--relief 0.3 --error 0.02 --azimuths 30");
  CHECK(coarse["visibility"]["azimuths"].get<int>() < fine["visibility"]["azimuths"].get<int>());
  CHECK(coarse["visibility"]["rmse_estimate"].get<double>() >
        fine["visibility"]["rmse_estimate"].get<double>());
  CHECK(fixed["visibility"]["azimuths"] == 30);
}

TEST_CASE("the option --error 0 takes exact slices, as many as --azimuths says", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 32", folder).exit_code == 0);
  const auto [options, azimuths] =
      GENERATE(std::pair{"--error 0", 128}, std::pair{"--error 0 --azimuths 32", 32});
  const nlohmann::json summary = simulate(folder, "b.png", "out", options);
  CHECK(summary["visibility"]["method"] == "horizon");
  CHECK(summary["visibility"]["azimuths"] == azimuths);
  CHECK(summary["visibility"]["error_wanted"] == 0);
  CHECK_FALSE(summary["visibility"].contains("fineness"));
  CHECK(summary["links"]["count"].get<std::uint64_t>() > 0);
  CHECK(summary["energy"]["row_sum_max_error"].get<double>() < 1e-12);  // identity: n·ε
  // 256 azimuths find what few of them cost, and rounding of the links' places
  CHECK(summary["visibility"]["checked"]["total_rmse"].get<double>() < 2e-3);
}

TEST_CASE("the option --rays N implies rays, and --visibility rays has a number of them", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 24", folder).exit_code == 0);
  const auto [options, rays] = GENERATE(std::pair{"--rays 40", 40}, std::pair{"--visibility rays", 300},
                                        std::pair{"--visibility rays --rays 50", 50});
  const nlohmann::json visibility = simulate(folder, "b.png", "out", options)["visibility"];
  CHECK(visibility["method"] == "rays");
  CHECK(visibility["rays"] == rays);
  CHECK(visibility["azimuths"].is_null());
  CHECK(visibility["rmse_estimate"].get<double>() > 0);
  CHECK_FALSE(visibility.contains("checked"));
}

TEST_CASE("horizon walks store no links", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 64", folder).exit_code == 0);
  const nlohmann::json summary = simulate(folder, "b.png", "out", "--error 0.01 --bounces 3");
  CHECK(summary["links"]["count"] == 0);
  CHECK(summary["links"]["bytes"] == 0);
}

TEST_CASE("under an albedo image horizon walks and rays give the same total", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 96", folder).exit_code == 0);
  REQUIRE(run_command("synth cobbles -o albedo.png --size 96", folder).exit_code == 0);
  simulate(folder, "b.png", "walks", "--albedo albedo.png");
  simulate(folder, "b.png", "rays", "--albedo albedo.png --rays 512");
  const Picture walks = read_picture(folder / "walks" / "irradiance_total.exr");
  const Picture rays = read_picture(folder / "rays" / "irradiance_total.exr");
  REQUIRE(walks.values.size() == rays.values.size());
  double squares = 0;
  for (std::size_t i = 0; i < rays.values.size(); ++i) {
    squares += std::pow(double{walks.values[i]} - double{rays.values[i]}, 2);
  }
  const double rmse = std::sqrt(squares / static_cast<double>(rays.values.size()));
  CAPTURE(rmse);
  CHECK(rmse <
        0.005);  // Monte Carlo: of 512 rays, 0.002; discretisation: of walks, 1.5 times the error of 0.002
}

}  // namespace
}  // namespace heightlight
