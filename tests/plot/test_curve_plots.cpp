#include <stdlib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "heightlight/error.h"
#include "plot/curve_plots.h"
#include "plot/curve_tables.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;

namespace {

constexpr const char* kTerminal = "svg size 1400,2250 font 'sans-serif,17'";

/// Curves of `count` texels whose AO runs evenly from `from` to `to`; E_b/π = (1 − α) α^b.
BounceCurves make_curves(int count, float from, float to, int bounces, int bins = 100) {
  Map ao(count, 1);
  for (int i = 0; i < count; ++i)
    ao(0, i) = from + (to - from) * static_cast<float>(i) / static_cast<float>(count);
  CurveBuilder builder(ao, AoKind::ambient_occlusion, bins);
  TexelVector irradiance(static_cast<std::size_t>(count), 1);
  for (int i = 0; i < count; ++i) irradiance[static_cast<std::size_t>(i)] -= static_cast<double>(ao(0, i));
  for (int b = 0; b <= bounces; ++b) {
    builder.add(irradiance);
    for (int i = 0; i < count; ++i) irradiance[static_cast<std::size_t>(i)] *= static_cast<double>(ao(0, i));
  }
  builder.add_tail(irradiance);
  return builder.curves();
}

CurvePlotInput input_of(const BounceCurves& curves) {
  return {curves, curves, {{0.1, curves, 8, 8}, {0.5, curves, 8, 8}}, {}};
}

/// Gives PATH back its value.
class ScopedPath {
 public:
  explicit ScopedPath(const std::string& value) {
    if (const char* path = getenv("PATH")) before_ = path;
    setenv("PATH", value.c_str(), 1);
  }
  ~ScopedPath() { before_ ? setenv("PATH", before_->c_str(), 1) : unsetenv("PATH"); }
  ScopedPath(const ScopedPath&) = delete;
  ScopedPath& operator=(const ScopedPath&) = delete;

 private:
  std::optional<std::string> before_;
};

}  // namespace

TEST_CASE("The figure is written whole as SVG and PNG, under any name and title", "[plot]") {
  const ScratchFolder scratch;
  const auto svg = scratch / "it's a \"curve\" {x}_1.svg";
  const auto png = scratch / "it's a \"curve\" {x}_1.png";
  CurvePlotInput input = input_of(make_curves(5000, 0, 1, 20));
  input.title = "it's \"5 < 6\" & {a_b}^2 \\n\nend";
  plot_curves(svg, png, input);
  CHECK_THAT(read_text(svg), Catch::StartsWith("<?xml") && Catch::EndsWith("</svg>\n\n") &&
                                 Contains("Sum of the bounces") &&
                                 Contains("it's \"5 &lt; 6\" &amp; {a_b}^2 \\n"));
  const std::string pixels = read_text(png);
  CHECK_THAT(pixels, Catch::StartsWith("\x89PNG") && Contains("IEND"));
  CHECK(scratch.entry_count() == 2);
}

TEST_CASE("gnuplot has nothing to complain of, whichever bins are filled", "[plot]") {
  const int bins = GENERATE(1, 100, 10000);
  const int bounces = GENERATE(0, 1, 2, 20);
  const auto draw = [&](const BounceCurves& curves) { return draw_curves(kTerminal, input_of(curves)); };
  CHECK(draw(make_curves(300, 0, 1, bounces, bins)).messages == "");
  CHECK(draw(make_curves(9, 1, 1, bounces, bins)).messages == "");  // a level map: all at α = 1
  CHECK(draw(make_curves(9, NAN, NAN, bounces, bins)).messages == "");
  CHECK(draw_curves(kTerminal, CurvePlotInput{}).messages.empty());
}

TEST_CASE("the figure does not depend on the user's locale", "[plot]") {
  const CurvePlotInput input = input_of(make_curves(300, 0, 1, 3));
  const GnuplotResult here = draw_curves(kTerminal, input);
  const char* locale = std::getenv("LC_ALL");
  const std::string before = locale ? locale : "";
  setenv("LC_ALL", "C", 1);
  const GnuplotResult plain = draw_curves(kTerminal, input);
  if (locale) {
    setenv("LC_ALL", before.c_str(), 1);
  } else {
    unsetenv("LC_ALL");
  }
  CHECK(plain.messages == "");
  CHECK((plain.output == here.output));
}

TEST_CASE("Without gnuplot the figure is an error which names it, and no file", "[plot]") {
  const ScratchFolder scratch;
  const ScopedPath no_path("");
  CHECK_THROWS_WITH(plot_curves(scratch / "a.svg", scratch / "a.png", CurvePlotInput{}),
                    Contains("gnuplot") && Contains("installed") && !Contains("\n"));
  CHECK(scratch.entry_count() == 0);
}

TEST_CASE("A failure of gnuplot is an error with its own words", "[plot]") {
  CHECK_THROWS_WITH(draw_curves("no_such_terminal", CurvePlotInput{}),
                    Contains("gnuplot") && Contains("terminal") && !Contains("\n"));
}

TEST_CASE("A figure that cannot be written is an error which names it", "[plot]") {
  const ScratchFolder scratch;
  CHECK_THROWS_WITH(plot_curves(scratch / "absent/a.svg", scratch / "a.png", CurvePlotInput{}),
                    Contains("absent/a.svg"));
}

TEST_CASE("Empty bins break a curve, and a bin alone becomes a dash", "[plot]") {
  BounceCurves curves;
  curves.bins = 10;
  for (const int bin : {2, 3, 7}) {
    curves.filled.push_back(
        {bin, bin / 10.0, (bin + 1) / 10.0, (bin + 0.4) / 10, 5, {{0.5, 0, 0.4, 0.5, 0.6}}, {}});
  }
  const PlotTable table = bounce_table(curves);
  REQUIRE(table.size() == 5);
  CHECK(table[0] == std::vector<double>{(2 + 0.4) / 10, (0.2 + 0.3) / 2, 0.3 - 0.2, 5, 0.4, 0.6, 0.5});
  CHECK(table[1][0] == (3 + 0.4) / 10);
  CHECK(std::isnan(table[2][0]));
  CHECK(table[3][0] == 0.7);
  CHECK(table[4][0] == 0.8);
}

TEST_CASE("The sum of the bounces grows by each of them and ends with the tail", "[plot]") {
  const PlotTable table = sum_table(make_curves(400, 0, 1, 3, 10));
  REQUIRE(table.size() == 10);
  // Identity: (1 − α) Σ α^b over b ≤ 3 is 1 − α⁴; the tail here is the next bounce alone, (1 − α) α⁴.
  for (const std::vector<double>& row : table) {
    REQUIRE(row.size() == 6);
    for (std::size_t i = 2; i < row.size(); ++i) CHECK(row[i] >= row[i - 1]);
    CHECK(row[5] <= 1 + 1e-12);
  }
  CHECK(table[0][5] == Approx(1).margin(1e-4));  // truncation: α⁵ at α < 0.1
}

TEST_CASE("More than a hundred bins are taken together for the surface", "[plot]") {
  const std::vector<PlotTable> scans = surface_table(make_curves(30000, 0, 1, 2, 1000));
  REQUIRE(scans.size() == 2);
  REQUIRE(scans[0].size() == 100);
  CHECK(scans[1][40][1] == 2);
  CHECK(scans[0][40][0] == Approx(0.405).margin(0.001));         // discretisation: 300 texels a bin
  CHECK(scans[0][40][2] == Approx(0.595 * 0.405).margin(1e-3));  // likewise
}
