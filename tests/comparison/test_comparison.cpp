#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/texel_algebra.h"
#include "comparison/answer.h"
#include "comparison/closed_form_totals.h"
#include "comparison/compare_methods.h"
#include "comparison/comparison_csv.h"
#include "comparison/pareto_front.h"
#include "heightlight/error.h"
#include "plot/error_pictures.h"
#include "plot/previews.h"
#include "scratch_folder.h"
#include "test_maps.h"

namespace heightlight {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

TEST_CASE("error statistics leave out what has no value", "[comparison]") {
  Map map(5, 1);
  Map reference(5, 1);
  map.values = {0.5F, 0.25F, 1, kMissing, 0.75F};
  reference.values = {0.25F, 0.5F, 1, 0.5F, 0.5F};
  const ErrorStatistics error = measure(subtract(map, reference));
  CHECK(error.rmse == Approx(std::sqrt(3 * 0.0625 / 4)));
  CHECK(error.bias == Approx(0.0625));
  CHECK(error.largest == 0.25);
  CHECK(error.p99 == 0.25);
  CHECK(peak_signal_to_noise(error) == Approx(-20 * std::log10(error.rmse)));
  const ErrorStatistics none = measure(Map(3, 1, kMissing));
  CHECK((none.rmse == 0 && none.largest == 0));
}

TEST_CASE("the 99th percentile leaves the worst hundredth out", "[comparison]") {
  Map differences(200, 1);
  for (std::size_t i = 0; i < 200; ++i) differences.values[i] = static_cast<float>(i + 1) * (i % 2 ? 1 : -1);
  // Sizes are 1 … 200: at place 0.99 × 199 = 197.01, counted from 0, a hundredth of the way from 198 to 199.
  CHECK(measure(differences).p99 == Approx(198.01).epsilon(1e-12));
  CHECK(measure(differences).largest == 200);
}

TEST_CASE("angles between unit vectors are in degrees, small ones too", "[comparison]") {
  Image<Vector3> a(2, 1, Vector3{0, 0, 1});
  Image<Vector3> b(2, 1, Vector3{1, 0, 0});
  b(0, 1) = to_vector3(Eigen::Vector3f(1e-4F, 0, 1).normalized());
  const Map angles = angles_deg(a, b);
  CHECK(angles(0, 0) == Approx(90));
  CHECK(angles(0, 1) == Approx(1e-4 * 180 / std::numbers::pi).epsilon(1e-4));
}

ComparisonRow row(const char* method, double core_seconds, double rmse, const char* quantity = "q") {
  ComparisonRow result;
  result.method = method;
  result.quantity = quantity;
  result.cost.core = core_seconds;
  result.error.rmse = rmse;
  return result;
}

TEST_CASE("the Pareto front holds what nothing beats in both time and error", "[comparison]") {
  const std::vector<ComparisonRow> rows{row("slow", 3, 0.01),        row("fast", 1, 0.1),
                                        row("beaten", 2, 0.2),       row("middle", 2, 0.05),
                                        row("twin", 3, 0.01),        row("other", 0.1, 0.001, "r"),
                                        row(kExactMethod, 0.5, 1e-9)};
  const std::vector<const ComparisonRow*> front = pareto_front(rows, "q");
  REQUIRE(front.size() == 3);
  CHECK(front[0]->method == "fast");
  CHECK(front[1]->method == "middle");
  CHECK(front[2]->method == "slow");
  CHECK(cheapest(rows, "q", 0.1)->method == "fast");
  CHECK(cheapest(rows, "q", 0.06)->method == "middle");
  CHECK(cheapest(rows, "q", 0.001) == nullptr);
  CHECK(pareto_front(rows, "none of them").empty());
}

TEST_CASE("the table has one line per row, bent normals without a psnr", "[comparison]") {
  const ScratchFolder folder;
  std::vector<ComparisonRow> rows{row("gtao", 0.5, 0.1, kSkyQuantity), row("gtao", 0.5, 2, kBentQuantity)};
  rows[0].parameters = "3 x 3";
  rows[0].samples_per_texel = 18;
  write_comparison_csv(folder / "compare.csv", rows);
  CHECK(read_text(folder / "compare.csv") ==
        "method,parameters,quantity,seconds,core_seconds,samples_per_texel,rmse,bias,p99,max,psnr\n"
        "gtao,3 x 3,sky_view_factor,0,0.5,18,0.1,0,0,0,20\n"
        "gtao,,bent_normal_deg,0,0.5,,2,0,0,0,\n");
}

TEST_CASE("differences are blue below, white at and red above the reference, on one scale", "[comparison]") {
  Map differences(5, 1);
  differences.values = {-1, -0.1F, 0, 0.2F, kMissing};
  const Image<Rgb8> picture = difference_picture(differences);
  CHECK(picture(0, 0) == Rgb8{33, 102, 172});  // clipped
  CHECK(picture(0, 2) == Rgb8{255, 255, 255});
  CHECK(picture(0, 3) == Rgb8{178, 24, 43});
  CHECK(picture(0, 1)[2] > picture(0, 1)[0]);
  CHECK(picture(0, 4) == kMissingColour);
}

/// A scene small enough to compare all methods on.
struct SmallScene {
  Surface surface;
  std::vector<ComparedAlbedo> albedos;
  ComparisonReference reference;

  explicit SmallScene(const char* shape)
      : surface(build_surface(make_synth_map(shape, 32, Boundary::tile, 0.1))),
        albedos{{.label = "0.5", .reflectance = TexelVector(std::size_t{32} * 32, 0.5)}},
        reference(build_reference(surface, {.azimuths = 64, .albedos = albedos})) {}
};

TEST_CASE("the reference knows its own error, and halves of the sky send half of the light",
          "[comparison][slow]") {
  const SmallScene scene("cobbles");
  CHECK(scene.reference.checked == 256);
  CHECK(scene.reference.sky_rmse < 1e-3);    // discretisation: 64 azimuths
  CHECK(scene.reference.ray_rmse < 1.5e-3);  // and 65536 rays
  REQUIRE(scene.reference.total_evidence.total_checks.size() == 1);
  CHECK(scene.reference.total_evidence.total_checks[0].total_rmse < 5e-3);
  // The halves of the sky send half of the light each: slopes towards either side are as frequent on a tile.
  const Vector3 both{0.65F / 0.633333F, 0.6F / 0.633333F, 0.65F / 0.633333F};
  Eigen::Vector3d light = Eigen::Vector3d::Zero();
  double whole = 0;
  for (std::size_t i = 0; i < scene.reference.sky_light.size(); ++i) {
    light += as_eigen(scene.reference.sky_light.values[i]).cast<double>();
    whole += double{scene.reference.sky_view_factor.values[i]};
  }
  for (int c = 0; c < 3; ++c) CHECK(light[c] / whole == Approx(as_eigen(both)[c]).epsilon(0.02));
}

TEST_CASE("a sky that would not fit along so many azimuths is refused", "[comparison]") {
  const Surface surface = build_surface(make_synth_map("flat", 4, Boundary::tile, 0.1));
  ReferenceOptions options;
  options.azimuths = 65536;
  options.memory = 1 << 24;
  options.sky.light = {Image<Vector3>(128, 64, {1, 1, 1})};
  CHECK_THROWS_AS(build_reference(surface, options), MemoryError);
}

TEST_CASE("every method is compared, and the exact ones come out exact", "[comparison][slow]") {
  const SmallScene scene("brick");
  const DepthBuffer depth = make_depth_buffer(scene.surface);
  const ComparedScene compared{.surface = scene.surface, .depth = depth, .albedos = scene.albedos};
  const Comparison comparison = compare_methods(compared, scene.reference, make_contenders(compared), {});
  const auto rmse = [&](const std::string& method, const std::string& quantity) {
    double least = 1;
    for (const ComparisonRow& r : comparison.rows) {
      if (r.method == method && r.quantity == quantity) least = std::min(least, r.error.rmse);
    }
    return least;
  };
  CHECK(rmse("rays", kSkyQuantity) < 0.01);  // Monte Carlo: 256 rays
  CHECK(rmse("horizon walk planned", kSkyQuantity) < 0.004);
  CHECK(rmse("gtao", kSkyQuantity) < 0.002);  // converged; the reference has 64 azimuths
  CHECK(rmse("gtao", kBentQuantity) < 0.5);
  CHECK(rmse("hbao", kOcclusionQuantity) < 0.005);
  CHECK(rmse("hbao", kSkyQuantity) > 0.01);
  CHECK(rmse("rays with links", "total_irradiance_0.5") < 0.01);
  CHECK(rmse("ambient transfer", "total_irradiance_0.5") < 0.3);
  CHECK(rmse("ssdo", scene.reference.sky.quantity) < 0.3);
  CHECK(rmse(kExactMethod, scene.reference.sky.quantity) < 0.03);  // by the bent normal
  CHECK(comparison.sky_light.size() >= 6);
  CHECK(comparison.shown.size() >= 8);
  // What is found without a bounce costs no bounce: A has one price, whatever the albedo.
  REQUIRE(comparison.stages.size() > 5);
  for (const StageCost& stage : comparison.stages) {
    CHECK((stage.method == "ssdo" || stage.method == "ambient transfer"));
    CHECK(stage.bounce_core_seconds.size() == 1);
  }
  REQUIRE(comparison.roles.size() == 4);
  CHECK(comparison.roles[0].role == kExactMethod);
  const Answer answer = find_answer(comparison, compared);
  REQUIRE(answer.groups.size() == 4);
  CHECK(answer.groups[0].lines.size() == answering_forms(closed_forms()).size());
  CHECK(best_line(answer.groups[0], 0)->errors[0].rmse < 0.05);
  CHECK(answer.groups[0].lines.back().label == "G, n stored");
  CHECK(answer.groups[0].lines.back().errors[0].rmse < best_line(answer.groups[0], 0)->errors[0].rmse);
  for (const ComparisonRow& r : comparison.rows) {
    INFO(r.method << ", " << r.parameters << ", " << r.quantity);
    CHECK(r.parameters.find(',') == std::string::npos);
    CHECK(r.variant.find(',') == std::string::npos);
    CHECK(std::isfinite(r.error.rmse));
    CHECK(r.error.rmse < (r.quantity == kBentQuantity ? 60 : 0.6));
  }
}

TEST_CASE("panels of forms hold bin means, and the forms of their kind of AO", "[comparison]") {
  const Surface surface = build_surface(make_synth_map("flat", 32, Boundary::tile, 0.1));
  const DepthBuffer depth = make_depth_buffer(surface);
  const std::vector<ComparedAlbedo> albedos{{.label = "0.5", .reflectance = TexelVector(32 * 32, 0.5)}};
  const ComparedScene scene{.surface = surface, .depth = depth, .albedos = albedos};
  Estimate estimate;
  estimate.sky_view_factor = estimate.ambient_occlusion = Map(32, 32, 0.25F);
  for (std::size_t i = 512; i < 1024; ++i) estimate.sky_view_factor.values[i] = 0.75F;
  estimate.ambient_occlusion.values[7] = 0.99F;  // alone in its bin: not drawn
  ComparisonReference reference;
  reference.totals = {Map(32, 32, 0.5F)};
  for (std::size_t i = 0; i < 512; ++i) reference.totals[0].values[i] = i % 2 == 0 ? 0.4F : 0.2F;
  const std::vector<FormPanel> panels = make_form_panels("mine", estimate, scene, reference);
  REQUIRE(panels.size() == 2);
  CHECK(panels[0].kind == AoKind::sky_view_factor);
  REQUIRE(panels[0].measured.size() == 2);
  CHECK(panels[0].measured[0].ao == Approx(0.25));
  CHECK(panels[0].measured[0].mean == Approx(0.3));
  CHECK(panels[0].measured[0].low == Approx(0.2));
  CHECK(panels[0].measured[0].high == Approx(0.4));
  REQUIRE(panels[0].curves.size() == 4);  // no n is known
  CHECK(panels[0].curves[1].label == "eq. 12");
  CHECK(panels[0].curves[1].points[1][1] == Approx(0.75 / (1 - 0.5 * 0.25)));
  REQUIRE(panels[1].measured.size() == 1);
  REQUIRE(panels[1].curves.size() == 1);
  CHECK(panels[1].curves[0].form == "notes");
}

TEST_CASE("closed forms on the reference's own A are what the models say", "[comparison][slow]") {
  const SmallScene scene("sines");
  Estimate exact;
  exact.sky_view_factor = scene.reference.sky_view_factor;
  for (const ClosedForm& form : closed_forms()) {
    const bool wants_alpha = form.kind == AoKind::ambient_occlusion;
    const bool wants_seen = form.extra == ExtraInput::seen || form.extra == ExtraInput::deep_seen;
    CHECK(can_evaluate(form, exact) == (!wants_alpha && !wants_seen));
    if (form.name != "uniform_neighbourhood") continue;
    const Map total = evaluate_closed_form(form, exact, scene.surface, scene.albedos[0]);
    for (std::size_t i = 0; i < total.size(); ++i) {
      const float open = exact.sky_view_factor.values[i];
      REQUIRE(total.values[i] == Approx(open / (1 - 0.5F * (1 - open))).margin(1e-6));
    }
  }
}

}  // namespace
}  // namespace heightlight
