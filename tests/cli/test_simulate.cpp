#include <catch2/catch.hpp>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "command.h"
#include "results.h"
#include "running_command.h"
#include "shared_data.h"

namespace heightlight {
namespace {

TEST_CASE("simulate writes obscurance and ambient transfer from links, and refuses them without",
          "[cli][simulate]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth fbm -o map.png --size 32", folder).exit_code == 0);
  const CommandResult run = run_command(
      "simulate map.png -o out --error 0 --azimuths 16 --bounces 2 --obscurance 20% --falloff exponential "
      "--albedo 0.6,0.3,0.1 --quiet",
      folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  for (const char* name : {"out/obscurance.exr", "out/ambient_transfer.exr"})
    CHECK(std::filesystem::file_size(folder / name) > 1000);
  for (const auto& [options, fault] :
       {std::pair{"--obscurance 20%", "--obscurance: needs --visibility rays or --error 0"},
        std::pair{"--rays 8 --obscurance 60%", "is more than half of the shorter side of a map that tiles"},
        std::pair{"--rays 8 --obscurance near", "must be a length in world units"},
        std::pair{"--rays 8 --obscurance -1", "must be positive"}}) {
    const CommandResult refused =
        run_command(std::string("simulate map.png -o no --bounces 2 ") + options, folder);
    INFO(refused.error);
    CHECK(refused.exit_code == 2);
    CHECK(refused.error.find(fault) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder / "no"));
  }
}

TEST_CASE("simulate writes every file that the design names, and says what it did", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o 'a wall.png' --size 40 --seed 3", folder).exit_code == 0);
  const CommandResult run = run_command(
      "simulate 'a wall.png' -o 'the results' --rays 64 --albedo 0.8,0.5,0.2 --save-bounces --bounces 4",
      folder);
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(has_only_warnings(run.error));
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

TEST_CASE("simulate gives the same files for any number of threads", "[cli][slow]") {
  const ScratchFolder folder;
  const std::string method = GENERATE("", "--rays 48", "--error 0 --azimuths 8");
  CAPTURE(method);
  REQUIRE(run_command("synth cobbles -o c.exr --size 70", folder).exit_code == 0);
  for (const std::string threads : {"1", "2", "7"}) {
    const std::string options =
        "simulate c.exr --relief 0.2 --quiet -o out" + threads + " --threads " + threads + " " + method;
    REQUIRE(run_command(options, folder).exit_code == 0);
  }
  for (const char* name :
       {"ambient_occlusion.exr", "sky_view_factor.exr", "irradiance_total.exr", "curves.csv"}) {
    const std::string one = read_text(folder / "out1" / name);
    CHECK((one == read_text(folder / "out2" / name)));
    CHECK((one == read_text(folder / "out7" / name)));
  }
}

TEST_CASE("an albedo image is decoded from sRGB and scales the light that it sends on", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth trench -o t.png --size 24", folder).exit_code == 0);
  REQUIRE(run_command("synth flat -o black.png --size 24", folder).exit_code == 0);
  const std::string method = GENERATE("", "--rays 32", "--error 0 --azimuths 8");
  CAPTURE(method);
  REQUIRE(run_command("simulate t.png -o out --albedo black.png " + method, folder).exit_code == 0);
  CHECK(read_picture(folder / "out" / "irradiance_total.exr").values ==
        read_picture(folder / "out" / "sky_view_factor.exr").values);
}

TEST_CASE("form factors that are saved bring the first bounce, as scipy reads them", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 24", folder).exit_code == 0);
  const std::string method = GENERATE("--visibility rays --rays 64", "--error 0 --azimuths 8");
  const std::string boundary = GENERATE("tile", "open");
  CAPTURE(method, boundary);
  REQUIRE(run_command("simulate b.png -o out --save-links --save-bounces --quiet --boundary " + boundary +
                          " " + method,
                      folder)
              .exit_code == 0);
  write_text(folder / "multiply.py", R"(
import sys, numpy, scipy.sparse
links = scipy.sparse.load_npz(sys.argv[1])
beside = numpy.load(sys.argv[1])
sky = beside["sky_view_factor"]
assert links.has_sorted_indices and links.has_canonical_format and links.min() >= 0
assert tuple(beside["map_shape"]) == (24, 24) and links.shape == (576, 576)
assert numpy.abs(numpy.asarray(links.sum(axis=1)).ravel() + sky - 1).max() < 1e-12
(links @ sky).tofile(sys.argv[2])
)");
  const std::string python = "/usr/bin/python3 '" + (folder / "multiply.py").string() + "' '" +
                             (folder / "out" / "links.npz").string() + "' '" + (folder / "product").string() +
                             "'";
  REQUIRE(std::system(python.c_str()) == 0);
  const std::string bytes = read_text(folder / "product");
  const Picture first = read_picture(folder / "out" / "irradiance_01.exr");
  REQUIRE(bytes.size() == first.values.size() * sizeof(double));
  for (std::size_t i = 0; i < first.values.size(); ++i) {
    double product = 0;
    std::memcpy(&product, bytes.data() + i * sizeof(double), sizeof(double));
    REQUIRE(product ==
            Approx(double{first.values[i]}).epsilon(1e-6).margin(1e-9));  // rounding, single precision
  }
}

TEST_CASE("horizon walks have no links to save", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 16", folder).exit_code == 0);
  const CommandResult run = run_command("simulate b.png -o out --save-links", folder);
  CHECK(run.exit_code == 2);
  CHECK(run.error ==
        "heightlight: --save-links: needs --visibility rays or --error 0: horizon walks store no links\n");
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
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
  const std::string options = GENERATE("--boundary tile", "--boundary open", "--boundary tile --rays 64",
                                       "--boundary open --error 0");
  write_text(folder / name, grid);
  const CommandResult run = run_command(std::string("simulate ") + name + " -o out " + options, folder);
  INFO(name << " " << options << " " << run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(has_only_warnings(run.error));
  check_energy(read_summary(folder / "out"));
}

TEST_CASE("every real map simulates, with its energy in balance", "[cli][deep]") {
  const auto [name, options] = GENERATE(
      std::pair{"material/Ground054_height16.png", ""}, std::pair{"material/Bricks102_height.jpg", ""},
      std::pair{"material/MetalWalkway006_height16.png", "--boundary tile"},
      std::pair{"terrain/lakes_dem.tif", "--texel 50 --boundary open"},
      std::pair{"terrain/SRTMGL3_boulder.asc", "--texel 70.8x92.6"},
      std::pair{"terrain/DSM_PHR_Dunkerque.tif", "--texel 0.5 --boundary open"},
      std::pair{"terrain/hugo_site_filled.asc", "--no-data -9999"});
  const std::string method = GENERATE("", " --rays 16 --bounces 5");
  const auto path = find_shared_data(name);
  if (!path) return;
  const ScratchFolder folder;
  const CommandResult run =
      run_command("simulate '" + path->string() + "' -o out --quiet " + options + method, folder);
  INFO(name << method << ": " << run.error);
  REQUIRE(run.exit_code == 0);
  check_energy(read_summary(folder / "out"));
}

TEST_CASE("an interrupted simulation stops with 130 and leaves nothing", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o b.png --size 256", folder).exit_code == 0);
  RunningCommand command({"simulate", "b.png", "-o", "out", "--rays", "20000"}, folder.path());
  CHECK(command.interrupt_after(1, SIGINT).exit_code == 130);
  CHECK_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
}  // namespace heightlight
