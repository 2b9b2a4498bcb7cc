#include <catch2/catch.hpp>
#include <cmath>

#include "base/hash.h"
#include "fit/bootstrap.h"
#include "fit/least_squares.h"
#include "fit/trial_forms.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "scratch_folder.h"

namespace heightlight {
namespace {

using Catch::Matchers::Contains;

const char* kHeader = "ao_kind,bin,ao_lo,ao_hi,ao_mean,count,bounce,mean,stddev,p05,p50,p95\n";

const NotesConstants kBounded{0.4, 1, 20, 3};  ///< F₀ stays below 1

/// A number about as often above as below 0, of standard deviation 1: the sum of twelve uniform ones less 6.
double noise(std::uint64_t seed) {
  double sum = -6;
  for (std::uint64_t i = 0; i < 12; ++i) sum += unit_real(hash_combine(seed, i));
  return sum;
}

/// Curves whose E₀ and E₁ over α are the notes' with these constants, and whose bounces over A are those of G
/// with n = offset + slope A; each mean with noise of this standard deviation.
std::vector<BounceCurves> synthetic_curves(const NotesConstants& notes, double offset, double slope,
                                           double sigma, std::uint64_t seed) {
  BounceCurves alpha{AoKind::ambient_occlusion, 100, {}};
  BounceCurves sky{AoKind::sky_view_factor, 100, {}};
  for (int bin = 2; bin < 98; ++bin) {
    const double ao = (bin + 0.4) / 100;
    CurveBin of_alpha{bin, bin / 100.0, (bin + 1) / 100.0, ao, 100 + static_cast<std::size_t>(bin), {}, {}};
    CurveBin of_sky = of_alpha;
    const auto value = [&](double exact, int which) {
      return exact + sigma * noise(hash_combine(seed, static_cast<std::uint64_t>(bin * 100 + which)));
    };
    const auto add = [](CurveBin& to, double mean) { to.bounces.push_back({mean, 0, mean, mean, mean}); };
    add(of_alpha, value(notes_direct(AmbientOcclusion(ao), notes), 0));
    add(of_alpha, value(notes_first_bounce(AmbientOcclusion(ao), notes), 1));
    const double n = offset + slope * ao;
    add(of_sky, value(ao, 2));
    for (int b = 1; b <= 20; ++b) add(of_sky, value((1 - ao) * n * std::pow(1 - n, b - 1), 2 + b));
    alpha.filled.push_back(of_alpha);
    sky.filled.push_back(of_sky);
  }
  return {alpha, sky};
}

JudgedMap synthetic_map(const std::string& name, const std::vector<BounceCurves>& curves) {
  JudgedMap map;
  map.name = name;
  map.material = name;
  map.over_alpha = curves[0];
  map.over_sky = curves[1];
  return map;
}

const FormFamily& family_named(const std::string& name) {
  for (const FormFamily& family : form_families()) {
    if (family.name == name) return family;
  }
  throw Error("no family " + name);
}

}  // namespace

TEST_CASE("known parameters are recovered within their stated intervals", "[fit]") {
  NotesConstants notes;
  notes.direct_gain = 0.42;
  notes.direct_power = 0.9;
  notes.first_gain = 21;
  notes.first_decay = 3.1;
  const std::vector<JudgedMap> maps{synthetic_map("made", synthetic_curves(notes, 0.1, 0.7, 0.002, 7))};
  const auto check = [&](const char* name, const std::vector<double>& truth) {
    const FormFamily& family = family_named(name);
    const std::vector<FitPoint> points = collect_points(family, maps);
    const LeastSquaresFit fit = fit_family(family, points, {1});
    const ParameterIntervals intervals = bootstrap_family(family, points, maps, fit.parameters, 200, 1);
    CHECK(intervals.unit == "bins");
    for (std::size_t p = 0; p < truth.size(); ++p) {
      const auto i = static_cast<Eigen::Index>(p);
      const double error = std::sqrt(fit.covariance(i, i));
      INFO(name << " " << family.parameters[p] << " " << fit.parameters[i] << " ± " << error << " in "
                << intervals.low[i] << " … " << intervals.high[i]);
      // Monte Carlo, fixed seed: within three standard errors, and in the 95 % interval widened by half of
      // itself
      CHECK(std::abs(fit.parameters[i] - truth[p]) < 3 * error);
      const double width = intervals.high[i] - intervals.low[i];
      CHECK(intervals.low[i] - width / 2 < truth[p]);
      CHECK(truth[p] < intervals.high[i] + width / 2);
      CHECK(width < 12 * error);
    }
  };
  check("notes_direct", {0.42, 0.9});
  check("notes_first_bounce", {21, 3.1});
  check("seen_from_sky", {0.1, 0.7});
}

TEST_CASE("without noise parameters come back exactly", "[fit]") {
  const SeenConstants seen;
  const std::vector<JudgedMap> maps{
      synthetic_map("made", synthetic_curves({}, seen.offset, seen.slope, 0, 1))};
  for (const char* name : {"notes_direct", "notes_first_bounce", "seen_from_sky"}) {
    const FormFamily& family = family_named(name);
    const std::vector<double>& truth = family.published;
    Eigen::VectorXd start(static_cast<Eigen::Index>(truth.size()));
    for (std::size_t p = 0; p < truth.size(); ++p) start[static_cast<Eigen::Index>(p)] = 1.3 * truth[p];
    const LeastSquaresFit fit = fit_family(family, collect_points(family, maps), {1}, {start});
    for (std::size_t p = 0; p < truth.size(); ++p) {
      // truncation: of Levenberg and Marquardt's steps, and of the tail after 20 bounces
      CHECK(fit.parameters[static_cast<Eigen::Index>(p)] == Approx(truth[p]).epsilon(1e-4));
    }
  }
}

TEST_CASE("a user's form is fitted wherever its constants lie", "[fit][user-form]") {
  const std::vector<JudgedMap> maps{synthetic_map("made", synthetic_curves({}, 0.1, 0.7, 0, 1))};
  const auto fitted = [&](const std::string& text) {
    const FormFamily family = make_user_family(parse_user_form(text));
    return fit_family(family, collect_points(family, maps), {1});
  };
  const LeastSquaresFit own = fitted("mine = A + rho*(1 - A)*(a + b*A)/(1 - rho*(1 - a - b*A))");
  CHECK(own.parameters[0] == Approx(0.1).epsilon(1e-4));  // truncation, as above
  CHECK(own.parameters[1] == Approx(0.7).epsilon(1e-4));
  const LeastSquaresFit squared = fitted("mine = A + rho*(1 - A)*(a*a + b*A)/(1 - rho*(1 - a*a - b*A))");
  CHECK(std::abs(squared.parameters[0]) == Approx(std::sqrt(0.1)).epsilon(1e-4));
  CHECK_THROWS_WITH(fitted("mine = A + k - j"), Contains("mine") && Contains("do not determine"));
  CHECK_THROWS_WITH(fitted("mine = k*log(A - 2)"), Contains("not finite at A = ") && Contains("rho = 0.1"));
  CHECK_THROWS_WITH(fitted("mine = k*n"), Contains("0 measurements"));  // curves do not tell n
}

TEST_CASE("what maps alike do not determine stays near what is known", "[fit]") {
  // Two maps of one t: slope and bend are told by their sum alone.
  std::vector<JudgedMap> maps;
  for (const char* name : {"one", "other"}) {
    maps.push_back(synthetic_map(name, synthetic_curves({}, 0.3, 0.5, 0.001, maps.size())));
    maps.back().deep_seen = 0.3;
  }
  const FormFamily& family = family_named("seen_from_deep");
  const std::vector<FitPoint> points = collect_points(family, maps);
  const LeastSquaresFit fit = fit_family(family, points, {1, 1});
  CHECK(fit.parameters[0] + 0.3 * fit.parameters[1] == Approx(0.5).margin(0.01));
  for (Eigen::Index p = 0; p < 2; ++p)
    CHECK(std::abs(fit.parameters[p] - family.published[static_cast<std::size_t>(p)]) < 0.3);
  const ParameterIntervals intervals = bootstrap_family(family, points, maps, fit.parameters, 50, 1);
  CHECK((intervals.high - intervals.low).maxCoeff() < 1);
  CHECK(is_determined(family, fit.parameters, intervals, 0));
  ParameterIntervals wide = intervals;
  wide.low[0] = -9;
  CHECK_FALSE(is_determined(family, fit.parameters, wide, 0));
}

TEST_CASE("fits that can't be are errors that name them", "[fit]") {
  const auto line = [](const Eigen::VectorXd& p, Eigen::VectorXd& left) {
    for (Eigen::Index i = 0; i < left.size(); ++i) left[i] = p[0] + p[1] * static_cast<double>(i) - 3;
  };
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(2);
  CHECK(fit_least_squares("a line", start, {10, 1, 10}, line).parameters[0] == Approx(3));
  CHECK_THROWS_WITH(fit_least_squares("a line", start, {2, 1, 2}, line),
                    Contains("a line") && Contains("2 measurements"));
  const auto flat = [](const Eigen::VectorXd& p, Eigen::VectorXd& left) {
    left.setConstant(p[0] + p[1] - 1);
  };
  CHECK_THROWS_WITH(fit_least_squares("twins", start, {10, 1, 10}, flat),
                    Contains("twins") && Contains("determine"));
  const auto nowhere = [](const Eigen::VectorXd&, Eigen::VectorXd& left) { left.setConstant(std::nan("")); };
  CHECK_THROWS_WITH(fit_least_squares("nothing", start, {10, 1, 10}, nowhere), Contains("does not converge"));
  const auto escaping = [](const Eigen::VectorXd& p, Eigen::VectorXd& left) {
    for (Eigen::Index i = 0; i < left.size(); ++i)
      left[i] = std::exp(-p[0]) + std::exp(-p[1] * static_cast<double>(i + 1));
  };
  CHECK_THROWS_AS(fit_least_squares("runaway", start, {10, 1, 10}, escaping), Error);
}

TEST_CASE("damaged curve files are refused by line", "[fit][curves]") {
  const ScratchFolder scratch;
  const auto path = scratch / "bad.csv";
  const auto refuses = [&](const std::string& text, const char* fault) {
    write_text(path, text);
    CHECK_THROWS_WITH(read_curves_csv(path), Contains("bad.csv") && Contains(fault));
  };
  const std::string header = kHeader;
  const std::string good = "ambient_occlusion,0,0,0.01,0.005,4,0,0.1,0,0.1,0.1,0.1\n";
  refuses("", "is empty");
  refuses(header, "holds no curves");
  refuses("ao_kind,bin,ao_lo,ao_hi,count,bounce,mean,stddev,p05,p50,p95\n", "no column 'ao_mean'");
  refuses(header + "ambient_occlusion,0,0,0.01,0.005,4,0,nan,0,0.1,0.1,0.1\n", "line 2: 'nan' is no mean");
  refuses(header + "ambient_occlusion,0,0,0.01,0.005,4,0,0.1x,0,0.1,0.1,0.1\n", "'0.1x' is no mean");
  refuses(header + "ambient_occlusion,0,0,0.01,0.005,0,0,0.1,0,0.1,0.1,0.1\n", "without texels");
  refuses(header + "ambient_occlusion,0,0,0.01,0.005,4,0,1.2,0,0.1,0.1,0.1\n", "from 0 to 1");
  refuses(header + "ambient_occlusion,0,0,0.01,0.5,4,0,0.1,0,0.1,0.1,0.1\n", "outside its bin");
  refuses(header + "occlusion,0,0,0.01,0.005,4,0,0.1,0,0.1,0.1,0.1\n", "'occlusion' is no ao_kind");
  refuses(header + "ambient_occlusion,0,0,0.01\n", "4 fields where the header has 12");
  refuses(header + good + good, "not in ascending order");
  refuses(header + good + "ambient_occlusion,0,0,0.01,0.005,4,2,0.1,0,0.1,0.1,0.1\n",
          "bounce 2 does not follow");
  refuses(header + good + "sky_view_factor,0,0,0.01,0.005,4,0,0.1,0,0.1,0.1,0.1\n" +
              "ambient_occlusion,1,0.01,0.02,0.015,4,0,0.1,0,0.1,0.1,0.1\n",
          "line 4: ambient_occlusion again: the two kinds of AO are mixed");
  refuses(header + good + "ambient_occlusion,0,0,0.01,0.005,4,1,0.1,0,0.1,0.1,0.1\n" +
              "ambient_occlusion,1,0.01,0.02,0.015,4,0,0.1,0,0.1,0.1,0.1\n",
          "has 1 bounces where the first bin has 2");
}

TEST_CASE("curves read back as they were written, columns in any order", "[fit][curves]") {
  const ScratchFolder scratch;
  const std::vector<BounceCurves> curves = synthetic_curves(kBounded, 0.1, 0.7, 0, 3);
  write_curves_csv(scratch / "curves.csv", curves);
  const std::vector<BounceCurves> read = read_curves_csv(scratch / "curves.csv");
  REQUIRE(read.size() == 2);
  for (std::size_t kind = 0; kind < 2; ++kind) {
    CHECK(read[kind].kind == curves[kind].kind);
    CHECK(read[kind].bins == 100);
    REQUIRE(read[kind].filled.size() == curves[kind].filled.size());
    for (std::size_t i = 0; i < read[kind].filled.size(); ++i) {
      const CurveBin& a = read[kind].filled[i];
      const CurveBin& b = curves[kind].filled[i];
      CHECK((a.bin == b.bin && a.ao_lo == b.ao_lo && a.ao_mean == b.ao_mean && a.count == b.count));
      REQUIRE(a.bounces.size() == b.bounces.size());
      for (std::size_t k = 0; k < a.bounces.size(); ++k) CHECK(a.bounces[k].mean == b.bounces[k].mean);
    }
  }
  write_text(scratch / "turned.csv",
             "p95,p50,p05,stddev,mean,bounce,count,ao_mean,ao_hi,ao_lo,bin,ao_kind,remark\r\n"
             "0.5,0.4,0.3,0.01,0.35,0,7,0.505,0.51,0.5,50,sky_view_factor,odd\r\n");
  const std::vector<BounceCurves> turned = read_curves_csv(scratch / "turned.csv");
  CHECK(turned[0].filled[0].count == 7);
  CHECK(turned[0].filled[0].bounces[0].mean == 0.35);
  CHECK(turned[0].filled[0].tail.mean == 0.65);
}

TEST_CASE("maps with too few filled bins, or one kind of AO, are refused", "[fit]") {
  const ScratchFolder scratch;
  const auto write = [&](const std::vector<BounceCurves>& curves) {
    write_curves_csv(scratch / "c.csv", curves);
    return scratch / "c.csv";
  };
  std::vector<BounceCurves> curves = synthetic_curves(kBounded, 0.1, 0.7, 0, 1);
  CHECK(read_judged_maps(write(curves), ~0ULL)[0].material == "c");
  CHECK_THROWS_WITH(read_judged_maps(write({curves[0]}), ~0ULL),
                    Contains("c.csv") && Contains("no curves over sky"));
  curves[1].filled.resize(5);
  CHECK_THROWS_WITH(read_judged_maps(write(curves), ~0ULL), Contains("only 5 bins of sky_view_factor"));
}

}  // namespace heightlight
