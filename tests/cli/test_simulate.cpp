#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "command.h"
#include "shared_data.h"

namespace heightlight {
namespace {

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::vector<float> values;
};

Picture read_picture(const std::filesystem::path& path) {
  const auto file = OIIO::ImageInput::open(path.string());
  REQUIRE(file);
  const OIIO::ImageSpec& spec = file->spec();
  Picture picture{spec.width, spec.height, spec.channelnames, {}};
  picture.values.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                        static_cast<std::size_t>(spec.nchannels));
  REQUIRE(file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.values.data()));
  return picture;
}

nlohmann::json read_summary(const std::filesystem::path& folder) {
  return nlohmann::json::parse(read_text(folder / "summary.json"));
}

/// What must hold of any map, as the command itself reports it.
void check_energy(const nlohmann::json& summary) {
  CHECK(summary["energy"]["row_sum_max_error"].get<double>() <= 1e-6);
  CHECK(summary["energy"]["sum_max_error"].get<double>() <= 1e-5);
}

TEST_CASE("simulate writes every file that the design names, and says what it did", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o 'a wall.png' --size 40 --seed 3", folder).exit_code == 0);
  const CommandResult run = run_command(
      "simulate 'a wall.png' -o 'the results' --rays 64 --albedo 0.8,0.5,0.2 --save-bounces --bounces 4",
      folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.error.empty());
  const std::filesystem::path results = folder / "the results";
  for (const char* name :
       {"ambient_occlusion.exr", "sky_view_factor.exr", "irradiance_total.exr", "curves.csv", "curves.svg",
        "curves.png", "summary.json", "irradiance_00.exr", "irradiance_04.exr", "height.png",
        "ambient_occlusion.png", "sky_view_factor.png", "irradiance_total.png", "bounces.png"}) {
    CHECK(std::filesystem::file_size(results / name) > 0);
  }
  CHECK_FALSE(std::filesystem::exists(results / "irradiance_05.exr"));
  const Picture direct = read_picture(results / "irradiance_00.exr");
  const Picture sky = read_picture(results / "sky_view_factor.exr");
  CHECK(direct.values == sky.values);
  CHECK(sky.channels == std::vector<std::string>{"Y"});
  const Picture total = read_picture(results / "irradiance_total.exr");
  CHECK(total.channels == std::vector<std::string>{"R", "G", "B"});
  for (std::size_t i = 0; i < sky.values.size(); ++i) {
    // brighter albedo, more light; never more than an open place gets
    CHECK(total.values[3 * i] >= total.values[3 * i + 1]);
    CHECK(total.values[3 * i + 1] >= total.values[3 * i + 2]);
    CHECK(total.values[3 * i + 2] >= sky.values[i] - 1e-6F);
    CHECK(total.values[3 * i] <= 1 + 1e-6F);
  }
  const nlohmann::json summary = read_summary(results);
  check_energy(summary);
  CHECK(summary["map"]["width"] == 40);
  CHECK(summary["map"]["boundary"] == "tile");
  CHECK(summary["visibility"]["method"] == "rays");
  CHECK(summary["links"]["count"].get<std::uint64_t>() > 0);
  for (const char* key : {"load", "visibility", "transport", "bounces", "curves", "total"})
    CHECK(summary["time_s"].contains(key));
  CHECK(summary["memory"]["peak_bytes"].get<std::uint64_t>() > 1'000'000);
}

TEST_CASE("simulate gives the same files for any number of threads", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth cobbles -o c.exr --size 33", folder).exit_code == 0);
  for (const char* threads : {"1", "2", "7"}) {
    const std::string options = std::string("simulate c.exr --relief 0.2 --rays 48 --quiet -o out") +
                                threads + " --threads " + threads;
    REQUIRE(run_command(options, folder).exit_code == 0);
  }
  for (const char* name :
       {"ambient_occlusion.exr", "sky_view_factor.exr", "irradiance_total.exr", "curves.csv"}) {
    const std::string one = read_text(folder / "out1" / name);
    CHECK((one == read_text(folder / "out2" / name)));
    CHECK((one == read_text(folder / "out7" / name)));
  }
}

TEST_CASE("simulate walks horizons unless told otherwise, and says what that reached", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 96", folder).exit_code == 0);
  REQUIRE(run_command("simulate b.png -o out --albedo 0.8 --error 0.004", folder).exit_code == 0);
  const nlohmann::json summary = read_summary(folder / "out");
  check_energy(summary);
  const nlohmann::json& visibility = summary["visibility"];
  CHECK(visibility["method"] == "horizon");
  CHECK(visibility["azimuths"].get<int>() > 0);
  CHECK(visibility["rays"].is_null());
  CHECK(visibility["checked"]["receivers"].get<int>() > 100);
  // Monte Carlo: the pilot's sample against the check's; half as much again as was wanted
  CHECK(visibility["checked"]["sky_view_factor_rmse"].get<double>() < 1.5 * 0.004);
  CHECK(visibility["checked"]["total_rmse"].get<double>() < 1.5 * 0.004);
  CHECK(visibility["rmse_estimate"] == visibility["checked"]["sky_view_factor_rmse"]);
}

TEST_CASE("an error of 0 means exact slices, whose energy balances, and rays are the reference", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 40", folder).exit_code == 0);
  REQUIRE(run_command("simulate b.png -o exact --error 0 --azimuths 32", folder).exit_code == 0);
  REQUIRE(run_command("simulate b.png -o rays --visibility rays", folder).exit_code == 0);
  const nlohmann::json exact = read_summary(folder / "exact");
  const nlohmann::json rays = read_summary(folder / "rays");
  check_energy(exact);
  check_energy(rays);
  CHECK(exact["visibility"]["azimuths"] == 32);
  CHECK(rays["visibility"]["method"] == "rays");
  CHECK(rays["visibility"]["rays"] == 300);
}

TEST_CASE("links walked again for lack of memory give the same files", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 192", folder).exit_code == 0);
  REQUIRE(run_command("simulate b.png -o kept", folder).exit_code == 0);
  REQUIRE(run_command("simulate b.png -o again --memory 9M", folder).exit_code == 0);
  CHECK(read_summary(folder / "again")["links"]["bytes"].get<std::uint64_t>() <
        read_summary(folder / "kept")["links"]["bytes"].get<std::uint64_t>());
  for (const char* name : {"sky_view_factor.exr", "irradiance_total.exr", "curves.csv"}) {
    CHECK((read_text(folder / "kept" / name) == read_text(folder / "again" / name)));
  }
}

TEST_CASE("an albedo image is decoded from sRGB and scales the light that it sends on", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth trench -o t.png --size 24", folder).exit_code == 0);
  REQUIRE(run_command("synth flat -o black.png --size 24", folder).exit_code == 0);
  REQUIRE(run_command("simulate t.png -o out --rays 32 --albedo black.png", folder).exit_code == 0);
  CHECK(read_picture(folder / "out" / "irradiance_total.exr").values ==
        read_picture(folder / "out" / "sky_view_factor.exr").values);
}

TEST_CASE("one-dimensional and tiny maps simulate", "[cli]") {
  const ScratchFolder folder;
  const auto [name, grid] = GENERATE(
      std::pair{"row.asc", "ncols 6\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n0 3 1 4 1 5\n"},
      std::pair{"column.asc", "ncols 1\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\n0\n3\n1\n4\n"},
      std::pair{"one.asc", "ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\n7\n"},
      std::pair{
          "island.asc",
          "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -1\n-1 -1 -1\n-1 7 -1\n"});
  const std::string boundary = GENERATE("tile", "open");
  write_text(folder / name, grid);
  const CommandResult run =
      run_command(std::string("simulate ") + name + " -o out --rays 64 --boundary " + boundary, folder);
  INFO(name << " " << boundary << " " << run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(run.error.empty());
  check_energy(read_summary(folder / "out"));
}

TEST_CASE("every real map simulates, with its energy in balance", "[cli][slow]") {
  const auto [name, options] = GENERATE(
      std::pair{"material/Ground054_height16.png", ""}, std::pair{"material/Bricks102_height.jpg", ""},
      std::pair{"material/MetalWalkway006_height16.png", "--boundary tile"},
      std::pair{"terrain/lakes_dem.tif", "--texel 50 --boundary open"},
      std::pair{"terrain/SRTMGL3_boulder.asc", "--texel 70.8x92.6"},
      std::pair{"terrain/DSM_PHR_Dunkerque.tif", "--texel 0.5 --boundary open"},
      std::pair{"terrain/hugo_site_filled.asc", "--no-data -9999"});
  const auto path = find_shared_data(name);
  if (!path) return;
  const ScratchFolder folder;
  const CommandResult run =
      run_command("simulate '" + path->string() + "' -o out --rays 48 --quiet " + options, folder);
  INFO(name << ": " << run.error);
  REQUIRE(run.exit_code == 0);
  check_energy(read_summary(folder / "out"));
}

TEST_CASE("an interrupted simulation stops with 130 and leaves nothing", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 256", folder).exit_code == 0);
  const ScratchFolder streams;
  const std::string line =
      "cd '" + folder.path().string() +
      "' && '" HEIGHTLIGHT_COMMAND
      "' simulate b.png -o out --rays 20000 > /dev/null 2>&1 & PID=$!; sleep 1; kill -INT $PID; "
      "wait $PID; echo $? > '" +
      (streams / "code").string() + "'";
  // A background job of a shell without job control ignores SIGINT unless it asks for it, which the command
  // does.
  REQUIRE(std::system(line.c_str()) == 0);
  CHECK(read_text(streams / "code") == "130\n");
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace heightlight
