#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/hash.h"
#include "fit/bounce_fits.h"
#include "fit/bounce_ratios.h"

namespace heightlight {
namespace {

constexpr std::size_t kLast = 20;

/// Bins over α; each bounce's mean is `mean(alpha, b)`.
template <class Mean>
BounceCurves make_curves(const Mean& mean) {
  BounceCurves curves{AoKind::ambient_occlusion, 100, {}};
  for (int bin = 2; bin < 98; ++bin) {
    const double ao = (bin + 0.4) / 100;
    CurveBin one{bin, bin / 100.0, (bin + 1) / 100.0, ao, 100, {}, {}};
    for (std::size_t b = 0; b <= kLast; ++b) {
      const double value = mean(ao, b);
      one.bounces.push_back({value, 0, value, value, value});
    }
    curves.filled.push_back(one);
  }
  return curves;
}

double scatter_of(std::uint64_t seed) {
  double sum = -6;
  for (std::uint64_t i = 0; i < 12; ++i) sum += unit_real(hash_combine(seed, i));
  return sum;
}

}  // namespace

TEST_CASE("a geometric series has one ratio, which the study finds", "[fit][bounces]") {
  const auto tau = [](double alpha) { return 0.8 - 0.6 * alpha; };
  const BounceCurves curves = make_curves([&](double alpha, std::size_t b) {
    return b == 0 ? alpha : (1 - alpha) * (1 - tau(alpha)) * std::pow(tau(alpha), static_cast<double>(b) - 1);
  });
  const BounceRatios ratios = find_bounce_ratios("series", curves);
  REQUIRE(ratios.bins.size() == 96);
  CHECK(ratios.spread < 1e-12);
  for (const RatioBin& bin : ratios.bins) {
    CHECK(bin.by_conservation == Approx(tau(bin.ao)).epsilon(1e-12));
    REQUIRE(bin.ratios.size() == kLast - 1);
    for (const double ratio : bin.ratios) {
      if (!std::isnan(ratio)) CHECK(ratio == Approx(tau(bin.ao)).epsilon(1e-12));
    }
    CHECK_FALSE(std::isnan(bin.ratios[0]));
  }
  CHECK(find_bin(ratios, 0.5)->ao == Approx(0.504));
  CHECK(find_bin(ratios, 1.5) == nullptr);
}

TEST_CASE("two series have no one ratio: it goes from that of the brighter to that of the slower",
          "[fit][bounces]") {
  const BounceCurves curves = make_curves([](double, std::size_t b) {
    return b == 0 ? 0.5 : 0.2 * std::pow(0.2, b - 1.0) + 0.05 * std::pow(0.8, b - 1.0);
  });
  const BounceRatios ratios = find_bounce_ratios("two", curves);
  const std::vector<double>& found = ratios.bins[10].ratios;
  CHECK(found[0] == Approx((0.04 + 0.04) / 0.25));
  CHECK(found[9] == Approx(0.8).margin(1e-3));
  CHECK(ratios.spread == Approx(found[9] - found[0]));
  CHECK(ratios.bins[10].by_conservation == Approx(1 - 0.25 / 0.5));  // and eq. 9 is neither of them
}

TEST_CASE("ratios end where bounces are too faint, and bins without texels to speak of are left out",
          "[fit][bounces]") {
  BounceCurves curves =
      make_curves([](double, std::size_t b) { return b == 0 ? 0.9 : 0.09 * std::pow(0.1, b - 1.0); });
  curves.filled[5].count = 1;
  for (std::size_t i = 50; i < curves.filled.size(); ++i) curves.filled[i].count = 1000;
  const BounceRatios ratios = find_bounce_ratios("faint", curves);
  CHECK(ratios.bins.size() == 95);
  CHECK(ratios.bins[0].ratios[2] == Approx(0.1));
  CHECK(std::isnan(ratios.bins[0].ratios[3]));  // E₄ = 9e-5
  CHECK(std::isnan(ratios.bins[0].ratios[18]));
}

TEST_CASE("a bounce that a few open bins do not determine is a fault of its own", "[fit][bounces]") {
  JudgedMap map;
  map.name = map.material = "open";
  map.over_alpha = make_curves([](double alpha, std::size_t b) {
    return b == 0 ? alpha : std::pow(1 - alpha, 1.5) * std::exp(-30.0 * static_cast<double>(b) * alpha);
  });
  std::erase_if(map.over_alpha.filled, [](const CurveBin& bin) { return bin.ao_mean < 0.9; });
  map.over_sky = map.over_alpha;
  for (const BounceFit& fit : fit_bounces({map}, 20, 1, {})) {
    INFO("b = " << fit.bounce);
    if (!fit.fault.empty()) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(std::isfinite(fit.constants[c]));
      CHECK(std::isfinite(fit.high[c]));
    }
    CHECK(fit.high[0] <= 1e9);
  }
}

TEST_CASE("free fits of single bounces recover their constants within their intervals", "[fit][bounces]") {
  const auto truth = [](std::size_t b) {
    const auto bounce = static_cast<double>(b);
    return std::array<double, 3>{2 + 0.3 * bounce, 2 + 0.5 * bounce, 0.5 + 1 / bounce};
  };
  JudgedMap map;
  map.name = map.material = "made";
  map.over_alpha = make_curves([&](double alpha, std::size_t b) {
    if (b == 0) return alpha;
    const auto seed = static_cast<std::uint64_t>(std::lround(1000 * alpha)) * 100 + b;
    return std::max(1e-9,
                    evaluate_bounce(truth(b), alpha) + 0.002 / static_cast<double>(b) * scatter_of(seed));
  });
  map.over_sky = map.over_alpha;
  const std::vector<BounceFit> fits = fit_bounces({map}, 100, 1, {});
  REQUIRE(fits.size() == kLast);
  for (const BounceFit& fit : fits) {
    INFO("b = " << fit.bounce << ": " << fit.fault);
    REQUIRE(fit.fault.empty());
    CHECK(fit.rms < 0.03 * fit.peak);
    for (std::size_t c = 0; c < 3; ++c) {
      const double width = fit.high[c] - fit.low[c];
      INFO("ABC"[c] << " " << fit.constants[c] << " in " << fit.low[c] << " … " << fit.high[c]);
      // Monte Carlo, fixed seed: sixty 95 % intervals, each widened by half of itself
      CHECK(fit.low[c] - width / 2 < truth(fit.bounce)[c]);
      CHECK(truth(fit.bounce)[c] < fit.high[c] + width / 2);
      CHECK(width < 0.6 * truth(fit.bounce)[c]);
    }
  }
  // F₁ is such a form.
  const NotesConstants notes;
  CHECK(evaluate_bounce({notes.first_gain, notes.first_decay, 0.25}, 0.3) ==
        Approx(notes_first_bounce(AmbientOcclusion(0.3))));
}

}  // namespace heightlight
