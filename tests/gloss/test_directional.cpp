#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "base/gauss_legendre.h"
#include "heightlight/error.h"
#include "shading/counted.h"
#include "shading/directional_study.h"
#include "shading/specular_study.h"
#include "test_maps.h"
#include "visibility/triple_product.h"

// Studies of what shading by a direction errs by.

namespace heightlight {
namespace {

using std::numbers::pi;

const DirectionalRow& row_of(const DirectionalStudy& study, const char* sky, const char* input,
                             const char* method, bool as_harmonics) {
  for (const DirectionalRow& row : study.rows) {
    if (row.sky == sky && row.input == input && row.method == method && row.as_harmonics == as_harmonics)
      return row;
  }
  throw Error("no such row");
}

}  // namespace

TEST_CASE("the triple product is the integral of three functions", "[gloss]") {
  NineHarmonics<double> a{};
  NineHarmonics<double> b{};
  NineHarmonics<double> c{};
  for (std::size_t i = 0; i < 9; ++i) {
    a[i] = std::sin(1.0 + static_cast<double>(i));
    b[i] = std::cos(2.0 * static_cast<double>(i));
    c[i] = 0.3 + 0.1 * static_cast<double>(i * i % 7);
  }
  double expected = 0;
  for (const QuadratureNode& node : gauss_legendre(12)) {
    const double z = 2 * node.at - 1;
    const double sine = std::sqrt(1 - z * z);
    for (int k = 0; k < 24; ++k) {
      const double azimuth = 2 * pi * k / 24;
      const NineHarmonics<double> y =
          harmonics_along<double>({sine * std::cos(azimuth), sine * std::sin(azimuth), z});
      expected += node.weight * 4 * pi / 24 * dot(a, y) * dot(b, y) * dot(c, y);
    }
  }
  CHECK(triple_product(a, b, c) == Approx(expected).epsilon(1e-12));  // identity: the rules are exact
}

TEST_CASE("operations are counted as they are done", "[gloss]") {
  const OperationCount count = count_operations([] {
    const Counted a(2);
    const Counted b = a * a + a;
    sqrt(b);
  });
  CHECK(count.arithmetic == 2);
  CHECK(count.functions == 1);
}

TEST_CASE("errors of the cone's forms vanish where normal and bent normal are one", "[gloss]") {
  const std::vector<ConeFormError> forms = judge_cone_forms(30);
  REQUIRE(forms.size() == 900);
  for (const ConeFormError& form : forms) {
    // A cone turned away a little from the normal errs by about the turn; the product by what harmonics cut
    // off.
    if (form.turn < 0.06) CHECK(form.by_cone < 0.1);
    CHECK(form.by_product > 0.001);
  }
}

TEST_CASE("ways to shade agree under an even sky, and with exact harmonics under theirs", "[gloss]") {
  const Surface surface = build_surface(make_synth_map("fbm", 40, Boundary::tile, 0.25));
  const DirectionalStudy study = study_directional(surface, {});
  CHECK(study.grid.texels.size() == 40 * 40);
  for (const char* method :
       {kAoProbe, kBentProbe, kAoHarmonics, kBentHarmonics, kDirectionalGtao, kOwnHarmonics})
    CHECK(row_of(study, "uniform", kExactOpenness, method, false).rmse < 2e-5);  // identity, in floats
  for (const char* sky : {"overcast", "low-sun", "binary"}) {
    INFO(sky);
    CHECK(row_of(study, sky, kExactOpenness, kOwnHarmonics, true).rmse < 1e-12);  // identity
    CHECK(row_of(study, sky, kBakedOpenness, kOwnHarmonics, true).rmse < 0.005);  // what bake errs by
    CHECK(row_of(study, sky, kExactOpenness, kDirectionalGtao, true).rmse <
          0.5 * row_of(study, sky, kExactOpenness, kAoHarmonics, true).rmse);
    CHECK(row_of(study, sky, kGtaoOpenness, kDirectionalGtao, false).rmse >
          row_of(study, sky, kExactOpenness, kDirectionalGtao, false).rmse);
  }
  REQUIRE(study.costs.size() == 8);
  for (const ShadingCost& cost : study.costs) {
    INFO(cost.method);
    CHECK((cost.lookups > 0) == (cost.arithmetic == 0));
  }
}

TEST_CASE("ways to guess specular occlusion are ordered as they should be", "[gloss]") {
  const Surface surface = build_surface(make_synth_map("fbm", 40, Boundary::tile, 0.4));
  SpecularStudyOptions options{
      .roughness = {0.05, 0.3}, .views = {{0, 0, 1}, {0.6F, 0.3F, 0.7F}}, .rays = 256};
  options.tables.push_back({"GTSO, table of 8^4", make_specular_table(8)});
  const SpecularStudy study = study_specular(surface, options);
  REQUIRE(study.truths.size() == 4);
  const auto rmse = [&](const std::string& method, const SpecularTruth& truth) {
    for (const SpecularRow& row : study.rows) {
      if (row.method == method && row.roughness == truth.roughness && row.view == truth.view &&
          (row.input.empty() || row.input == kExactOpenness))
        return row.rmse;
    }
    throw Error("no such row");
  };
  for (const SpecularTruth& truth : study.truths) {
    INFO(truth.roughness << " " << truth.view);
    CHECK(truth.seen > 400);
    CHECK(truth.mean < 1);
    CHECK(rmse("16 horizons, 32 directions", truth) < rmse("GTSO, table of 8^4", truth));
    CHECK(rmse("16 horizons, 32 directions", truth) < 0.5 * rmse("AO", truth));
    CHECK(rmse("GTSO, table of 8^4", truth) < rmse("none", truth));
  }
  CHECK(study.fitted_share > 0);
  CHECK(study.fitted_share < 1);
  options.views = {{0, 0, -1}};
  CHECK_THROWS_AS(study_specular(surface, options), UsageError);
}

}  // namespace heightlight
