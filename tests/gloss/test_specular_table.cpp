#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/hash.h"
#include "base/parallel.h"
#include "files/specular_table_file.h"
#include "gloss/cone_share.h"
#include "heightlight/error.h"
#include "heightlight/gloss.h"
#include "scratch_folder.h"

// GTSO's table, and the integral that it is of.

namespace heightlight {
namespace {

using Catch::Contains;
using std::numbers::pi;

}  // namespace

TEST_CASE("a cone's share of a lobe agrees with an integral over the cone", "[gloss]") {
  for (const double roughness : {0.2, 0.6}) {
    for (const ConeArguments& arguments :
         {ConeArguments{0.5, 0.3, roughness, 0.7}, ConeArguments{1.1, 0.8, roughness, 0.2},
          ConeArguments{0.9, 1.2, roughness, 1.3}}) {
      const double tilt = arguments.view_angle - arguments.apart;
      const Eigen::Vector3d bent(std::sin(tilt), 0, std::cos(tilt));
      const Eigen::Vector3d view(-std::sin(arguments.view_angle), 0, std::cos(arguments.view_angle));
      double whole = 0;
      double inside = 0;
      constexpr int kRings = 1200;
      for (int i = 0; i < kRings; ++i) {
        const double z = (i + 0.5) / kRings;
        for (int k = 0; k < kRings; ++k) {
          const double azimuth = 2 * pi * (k + 0.5) / kRings;
          const double sine = std::sqrt(1 - z * z);
          const Eigen::Vector3d light(sine * std::cos(azimuth), sine * std::sin(azimuth), z);
          const double value = ggx_lobe({.roughness = roughness}, view, light);
          whole += value;
          if (light.dot(bent) >= std::cos(arguments.half_angle)) inside += value;
        }
      }
      const ConeLobe lobe = make_cone_lobe({.roughness = roughness}, arguments.view_angle, 65536, {});
      INFO(arguments.half_angle << " " << roughness);
      CHECK(cone_share(lobe, arguments) ==
            Approx(inside / whole).margin(2e-3));  // Monte Carlo, 65536 samples
    }
  }
}

TEST_CASE("tables of GTSO are within what they are said to err by", "[gloss]") {
  // Of docs/specular.md.
  const TableError of_16 = judge_specular_table(make_specular_table(16), 10000, 3);
  CHECK(of_16.rmse < 0.006);
  CHECK(of_16.largest < 0.3);  // where cone and lobe are both narrower than the steps of the table
  const TableError of_8 = judge_specular_table(make_specular_table(8), 2000, 3);
  CHECK(of_8.rmse < 0.025);
  CHECK(of_8.rmse > 2 * of_16.rmse);
}

TEST_CASE("a table is exact where it has values, and does not depend on threads", "[gloss]") {
  const auto with_threads = [](int threads) {
    const ThreadScope scope(threads);
    return make_specular_table(8).values;
  };
  const std::vector<std::uint8_t> values = with_threads(1);
  CHECK(values == with_threads(3));
  const SpecularTable table{.side = 8, .values = values};
  // An open hemisphere about the normal, looked at from above: all of the lobe.
  CHECK(look_up(table, {.half_angle = pi / 2, .apart = 0, .roughness = 1, .view_angle = 0}) ==
        Approx(1).margin(0.5 / 255 + 1e-12));
  CHECK(look_up(table, {.half_angle = 0, .apart = 0.5, .roughness = 0.1, .view_angle = 0.5}) ==
        Approx(0).margin(0.01));
  CHECK_THROWS_AS(make_specular_table(10), UsageError);
  CHECK_THROWS_AS(make_specular_table(0), UsageError);
  CHECK_THROWS_AS(make_specular_table(128), UsageError);
}

TEST_CASE("a table comes back from its file, and files that hold none are refused", "[gloss][files]") {
  const ScratchFolder folder;
  const SpecularTable table = make_specular_table(4);
  write_specular_table(folder / "table.ktx", table);
  const SpecularTable back = read_specular_table(folder / "table.ktx");
  CHECK(back.side == 4);
  CHECK(back.values == table.values);
  const std::string bytes = read_text(folder / "table.ktx");
  CHECK_THAT(bytes, Contains("mirrored view"));
  CHECK((bytes.size() - table.values.size()) % 4 == 0);
  const auto refused = [&](const std::string& content) {
    write_text(folder / "bad.ktx", content);
    try {
      read_specular_table(folder / "bad.ktx");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  CHECK_THAT(refused(bytes.substr(0, bytes.size() - 1)), Contains("bad.ktx: holds") && Contains("side 4"));
  CHECK_THAT(refused(bytes + 'x'), Contains("bad.ktx: holds"));
  CHECK_THAT(refused("no texture at all"), Contains("bad.ktx: is no KTX texture"));
  std::string other = bytes;
  other[36] = 8;  // the width
  CHECK_THAT(refused(other), Contains("8 x 4 x 16"));
}

}  // namespace heightlight
