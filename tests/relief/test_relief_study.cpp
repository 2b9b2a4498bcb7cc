#include <catch2/catch.hpp>
#include <cmath>

#include "heightlight/curves.h"
#include "heightlight/error.h"
#include "heightlight/synth.h"
#include "relief/relief_study.h"

using namespace heightlight;

namespace {

Heightmap make_map(const std::string& shape, int size, double relief_share) {
  Heightmap map;
  map.height = synthesize(shape, size, 1);
  for (float& height : map.height.values) height = static_cast<float>(height * relief_share);
  map.spacing = {1.0 / size, 1.0 / size};
  return map;
}

double mean_ao(const BounceCurves& curves) {
  double sum = 0;
  double count = 0;
  for (const CurveBin& bin : curves.filled) {
    sum += bin.ao_mean * static_cast<double>(bin.count);
    count += static_cast<double>(bin.count);
  }
  return sum / count;
}

std::size_t texels_in(const BounceCurves& curves) {
  std::size_t texels = 0;
  for (const CurveBin& bin : curves.filled) texels += bin.count;
  return texels;
}

}  // namespace

TEST_CASE("At its own relief and size a map's study is the map's own curves", "[relief]") {
  const Heightmap map = make_map("sines", 32, 0.25);
  const double share = relief(map);  // the width is 1
  const std::vector<ReliefCurves> study =
      study_reliefs(map, {.relief_shares = {share}, .largest_side = 32, .bounces = 2, .bins = 20});
  const Surface surface = build_surface(map);
  const std::unique_ptr<Transport> transport = build_horizon_transport(surface, study_plan());
  CurveBuilder builder(transport->ambient_occlusion, AoKind::ambient_occlusion, 20);
  bounce(*transport, surface, 2, [&](int, const TexelVector& e) { builder.add(e); });
  const BounceCurves& own = builder.curves();
  REQUIRE(study.size() == 1);
  REQUIRE(study[0].curves.filled.size() == own.filled.size());
  for (std::size_t i = 0; i < own.filled.size(); ++i) {
    CHECK(study[0].curves.filled[i].count == own.filled[i].count);
    CHECK(study[0].curves.filled[i].bounces[2].mean == own.filled[i].bounces[2].mean);
  }
}

TEST_CASE("More relief leaves less sky, whatever the relief, extent and size of the map given", "[relief]") {
  const std::vector<double> shares{0.02, 0.1, 0.5};
  const std::vector<ReliefCurves> study = study_reliefs(
      make_map("sines", 32, 0.25), {.relief_shares = shares, .largest_side = 32, .bounces = 1, .bins = 50});
  REQUIRE(study.size() == 3);
  CHECK(study[1].relief_share == 0.1);
  CHECK(mean_ao(study[0].curves) > mean_ao(study[1].curves));
  CHECK(mean_ao(study[1].curves) > mean_ao(study[2].curves));

  Heightmap scaled = make_map("sines", 32, 0.25 * 3000);
  scaled.spacing = {3000.0 / 32, 3000.0 / 32};
  const std::vector<ReliefCurves> large =
      study_reliefs(scaled, {.relief_shares = {0.1}, .largest_side = 32, .bounces = 1, .bins = 50});
  // Identity: the same shape in other units; single rays at an edge may fall on its other side.
  CHECK(mean_ao(large[0].curves) == Approx(mean_ao(study[1].curves)).margin(1e-3));
}

TEST_CASE("A study's copy keeps the extent of the map, also where its sides do not divide", "[relief]") {
  const int size = GENERATE(128, 101);
  const Heightmap map = make_map("sines", size, 0.25);
  const std::vector<ReliefCurves> small =
      study_reliefs(map, {.relief_shares = {0.1}, .largest_side = 64, .bounces = 1, .bins = 50});
  const std::vector<ReliefCurves> whole =
      study_reliefs(map, {.relief_shares = {0.1}, .largest_side = size, .bounces = 1, .bins = 50});
  CHECK(texels_in(small[0].curves) == (size == 128 ? 64U * 64U : 50U * 50U));
  // Discretisation: at half the samples the slopes are a little less steep. A copy that lost its extent would
  // have twice the relief, and is told apart below.
  CHECK(mean_ao(small[0].curves) == Approx(mean_ao(whole[0].curves)).margin(0.02));
  const std::vector<ReliefCurves> twice =
      study_reliefs(map, {.relief_shares = {0.2}, .largest_side = size, .bounces = 1, .bins = 50});
  CHECK(mean_ao(small[0].curves) > mean_ao(twice[0].curves) + 0.05);
}

TEST_CASE("A level map stays level in a study", "[relief]") {
  const std::vector<ReliefCurves> study = study_reliefs(
      make_map("flat", 8, 1), {.relief_shares = {0.1, 1}, .largest_side = 8, .bounces = 1, .bins = 10});
  for (const ReliefCurves& one : study) {
    REQUIRE(one.curves.filled.size() == 1);
    CHECK(one.curves.filled[0].bin == 9);
    CHECK(one.curves.filled[0].bounces[1].mean == 0);
  }
}

TEST_CASE("A study refuses what makes no sense", "[relief]") {
  const Heightmap map = make_map("sines", 8, 0.1);
  for (const double share : {0.0, -0.1, std::nan(""), HUGE_VAL}) {
    CHECK_THROWS_AS(
        study_reliefs(map, {.relief_shares = {share}, .largest_side = 8, .bounces = 1, .bins = 10}),
        UsageError);
  }
  CHECK_THROWS_AS(study_reliefs(map, {.relief_shares = {0.1}, .largest_side = 0, .bounces = 1, .bins = 10}),
                  UsageError);
  for (const int bounces : {-1, 0}) {
    const ReliefStudy study{.relief_shares = {0.1}, .largest_side = 8, .bounces = bounces, .bins = 10};
    CHECK_THROWS_AS(study_reliefs(map, study), UsageError);
  }
  CHECK_THROWS_AS(study_reliefs(map, {.relief_shares = {0.1}, .largest_side = 8, .bounces = 1, .bins = 0}),
                  UsageError);
}
