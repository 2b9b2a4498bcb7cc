#include <catch2/catch.hpp>
#include <sstream>

#include "heightlight/error.h"
#include "heightlight/files.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;

namespace {

constexpr const char* kExpectedHeader =
    "ao_kind,bin,ao_lo,ao_hi,ao_mean,count,bounce,mean,stddev,p05,p50,p95\n";

BounceCurves two_bins(AoKind kind) {
  BounceCurves curves;
  curves.kind = kind;
  curves.bins = 3;
  curves.filled = {{0, 0.0, 1.0 / 3, 0.1, 4, {{0.1, 0.2, 0.3, 0.4, 0.5}, {1e-300, 0, 1.0 / 3, 2, 1e22}}, {}},
                   {2, 2.0 / 3, 1.0, 0.75, 1, {{0.25, 0, 0.25, 0.25, 0.25}, {0, 0, 0, 0, 0}}, {}}};
  return curves;
}

}  // namespace

TEST_CASE("A curves file is one line per filled bin and bounce, one kind below the other", "[files]") {
  const ScratchFolder scratch;
  const auto path = scratch / "curves.csv";
  write_curves_csv(path, {two_bins(AoKind::ambient_occlusion), two_bins(AoKind::sky_view_factor)});
  const std::string text = read_text(path);
  const std::string lines =
      ",0,0,0.3333333333333333,0.1,4,0,0.1,0.2,0.3,0.4,0.5\n"
      ",0,0,0.3333333333333333,0.1,4,1,1e-300,0,0.3333333333333333,2,1e+22\n"
      ",2,0.6666666666666666,1,0.75,1,0,0.25,0,0.25,0.25,0.25\n"
      ",2,0.6666666666666666,1,0.75,1,1,0,0,0,0,0\n";
  std::string expected = kExpectedHeader;
  for (const char* kind : {"ambient_occlusion", "sky_view_factor"}) {
    std::istringstream stream(lines);
    for (std::string line; std::getline(stream, line);) expected += kind + line + '\n';
  }
  CHECK(text == expected);
}

TEST_CASE("Every double of a curves file reads back as it was", "[files]") {
  const ScratchFolder scratch;
  const auto path = scratch / "curves.csv";
  const BounceStatistics odd{0.1 + 0.2, 1.0 / 7, 2.0 / 3, 4.9406564584124654e-324, 0.30000000000000004};
  BounceCurves curves;
  curves.filled = {{0, 0, 0.01, 0.1 / 30, 1, {odd}, {}}};
  write_curves_csv(path, {curves});
  std::string text = read_text(path);
  text.erase(0, text.find('\n') + 1);
  std::vector<std::string> fields;
  std::istringstream stream(text);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  REQUIRE(fields.size() == 12);
  CHECK(std::stod(fields[4]) == 0.1 / 30);
  CHECK(std::stod(fields[7]) == odd.mean);
  CHECK(std::stod(fields[8]) == odd.stddev);
  CHECK(std::stod(fields[9]) == odd.p05);
  CHECK(std::strtod(fields[10].c_str(), nullptr) == odd.p50);  // std::stod refuses the smallest double
  CHECK(std::stod(fields[11]) == odd.p95);
}

TEST_CASE("Without filled bins a curves file is its header", "[files]") {
  const ScratchFolder scratch;
  write_curves_csv(scratch / "curves.csv", {BounceCurves{}});
  CHECK(read_text(scratch / "curves.csv") == kExpectedHeader);
}

TEST_CASE("A curves file that cannot be written is an error which names it", "[files]") {
  const ScratchFolder scratch;
  CHECK_THROWS_WITH(write_curves_csv(scratch / "absent/curves.csv", {}), Contains("absent/curves.csv"));
  if (!std::filesystem::exists("/dev/full")) {
    WARN("SKIPPED: no /dev/full");
    return;
  }
  CHECK_THROWS_WITH(write_curves_csv("/dev/full", {}), Contains("/dev/full") && Contains("No space left"));
}
