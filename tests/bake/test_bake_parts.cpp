#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "bake/bent_cone.h"
#include "bake/blue_noise.h"
#include "bake/model_map.h"
#include "bake/texel_encoding.h"
#include "base/gauss_legendre.h"
#include "base/hash.h"
#include "heightlight/closed_forms.h"
#include "visibility/sky_harmonics.h"

namespace heightlight {
namespace {

constexpr double kPi = std::numbers::pi;

TEST_CASE("both cones of a cap are the cap", "[bake]") {
  for (const double beta : {0.01, 0.3, 0.8, 1.3, kPi / 2}) {
    const double u = std::cos(beta);
    const double openness = 1 - u * u;
    const Vector3 first{0, 0, static_cast<float>(2.0 / 3 * (1 - u * u * u))};
    CHECK(cone_of_openness(openness) == Approx(beta).margin(1e-12));
    CHECK(cone_of_spread(openness, first) == Approx(beta).margin(2e-3));  // rounding of `first`, near u = 1
  }
  CHECK(cone_of_openness(0) == 0);
  CHECK(cone_of_spread(0, Vector3{}) == 0);
  CHECK(cone_of_openness(1 + 1e-7) == Approx(kPi / 2));
  CHECK(cone_of_spread(0.3, Vector3{0, 0, 0.1F}) == Approx(kPi / 2));  // a ditch: wider than any cone
}

TEST_CASE("the nine harmonics are orthonormal", "[bake]") {
  constexpr int kAzimuths = 16;
  for (std::size_t a = 0; a < 9; ++a) {
    for (std::size_t b = 0; b < 9; ++b) {
      double sum = 0;
      for (const QuadratureNode& node : gauss_legendre(8)) {
        const double z = 2 * node.at - 1;
        const double r = std::sqrt(1 - z * z);
        for (int k = 0; k < kAzimuths; ++k) {
          const double azimuth = 2 * kPi * k / kAzimuths;
          const Harmonics y = harmonics_of({r * std::cos(azimuth), r * std::sin(azimuth), z});
          sum += 2 * node.weight * 2 * kPi / kAzimuths * y[a] * y[b];
        }
      }
      CHECK(sum == Approx(a == b ? 1 : 0).margin(1e-13));  // identity
    }
  }
}

TEST_CASE("harmonics of moments are the moments of harmonics, and y turns", "[bake]") {
  const Eigen::Vector3d d = Eigen::Vector3d(0.3, -0.5, 0.7).normalized();
  const Harmonics turned = harmonics_of({d.x(), -d.y(), d.z()});
  const Harmonics expected = turn_y(harmonics_of(d));
  for (std::size_t k = 0; k < 9; ++k) CHECK(turned[k] == Approx(expected[k]).margin(1e-15));
  // A sky of radiance 1 has the coefficient √(4π) of Y00: an open place gets E/π = 1.
  const Harmonics open = harmonics_of_moments(1, {0, 0, 2.0 / 3}, {0, 0, 0.5, 0, 0});
  Harmonics even{};
  even[0] = std::sqrt(4 * kPi);
  CHECK(dot(open, even) == Approx(1));
}

TEST_CASE("blue noise has every threshold once, is the same every time, and has no low frequencies",
          "[bake]") {
  constexpr int kSide = 32;
  const Image<float> noise = make_blue_noise(kSide, 1);
  CHECK(noise == make_blue_noise(kSide, 1));
  CHECK_FALSE(noise == make_blue_noise(kSide, 2));
  const std::set<float> values(noise.values.begin(), noise.values.end());
  CHECK(values.size() == kSide * kSide);
  CHECK(*values.begin() == 0.5F / (kSide * kSide));
  CHECK(*values.rbegin() == 1 - 0.5F / (kSide * kSide));
  // Power of the waves up to a sixth of the sampling rate against that of white noise, 1/12 each.
  double power = 0;
  int waves = 0;
  for (int p = -kSide / 6; p <= kSide / 6; ++p) {
    for (int q = 0; q <= kSide / 6; ++q) {
      if ((p == 0 && q == 0) || p * p + q * q > kSide * kSide / 36) continue;
      double real = 0;
      double imaginary = 0;
      for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
          const double phase = 2 * kPi * (p * row + q * column) / kSide;
          real += static_cast<double>(noise(row, column)) * std::cos(phase);
          imaginary += static_cast<double>(noise(row, column)) * std::sin(phase);
        }
      }
      power += (real * real + imaginary * imaginary) / (kSide * kSide);
      ++waves;
    }
  }
  INFO("share of white noise's power: " << power / waves * 12);
  CHECK(power / waves < 0.1 / 12);
}

BakedChannel channel_of(double low, double high) { return {"", "1", low, high, 1, {}}; }

TEST_CASE("levels are rounded to the nearest, and a flat normal is (128, 128, 255)", "[bake]") {
  const auto encode = [](TextureDepth depth, double low, float value) {
    return encode_texel({depth, {}}, channel_of(low, 1), value, 3, 5, 0);
  };
  for (const float rounding : {0.0F, 1e-8F, -1e-8F, -3e-8F}) {
    CHECK(encode(TextureDepth::uint8, -1, rounding) == 128);
    CHECK(encode(TextureDepth::uint16, -1, rounding) == 32768);
  }
  CHECK(encode(TextureDepth::uint8, -1, 1) == 255);
  CHECK(encode(TextureDepth::uint8, -1, -1) == 0);
  CHECK(encode(TextureDepth::uint8, 0, 0.5F / 255 * 1.98F) == 1);
  CHECK(encode(TextureDepth::uint8, 0, 0.5F / 255 * 0.98F) == 0);
  CHECK(encode(TextureDepth::uint16, 0, 1.5F) == 65535);
  CHECK(encode(TextureDepth::uint16, 0, -0.1F) == 0);
  CHECK(encode(TextureDepth::uint8, 0, std::nanf("")) == 255);  // missing: open
  CHECK(std::isnan(encode(TextureDepth::real, 0, std::nanf(""))));
  CHECK(encode(TextureDepth::half, -1, 0.3F) == 0.3F);
}

TEST_CASE("dithered levels have the value as their mean, ends stay ends, and a level component stays level",
          "[bake]") {
  BakeOptions options;
  options.depth = TextureDepth::uint8;
  options.dither = true;
  const TexelEncoding encoding = make_encoding(options);
  const BakedChannel channel = channel_of(0, 1);
  for (const float value : {0.0F, 0.1F, 0.5F, 0.7031F, 1.0F}) {
    double sum = 0;
    for (int row = 0; row < kDitherSide; ++row) {
      for (int column = 0; column < kDitherSide; ++column) {
        const float level = encode_texel(encoding, channel, value, row, column, 1);
        CHECK(std::fabs(level - 255 * value) < 1);
        sum += static_cast<double>(level);
      }
    }
    // the thresholds lie 1/4096 apart
    CHECK(sum / (kDitherSide * kDitherSide) == Approx(255.0 * static_cast<double>(value)).margin(2.0 / 4096));
  }
  CHECK(encode_texel(encoding, channel_of(-1, 1), 0, 9, 9, 0) == 128);
}

TEST_CASE("n makes the model exact at the albedo of its fit, and eight bits cost little", "[bake]") {
  Map sky(3, 1);
  sky.values = {0.25F, 0.5F, std::nanf("")};
  const TexelVector total{0.7, 0.8, 0};
  const Map n = solve_seen(sky, total);
  CHECK(std::isnan(n.values[2]));
  const ModelError fitted = judge_model_map(sky, n, total, kSeenAlbedo);
  CHECK(fitted.rmse < 1e-7);  // rounding: n is a float
  CHECK(fitted.rmse_16_bits < 1.0 / 65535);
  CHECK(fitted.rmse_8_bits < 1.0 / 255);
  CHECK(fitted.rmse_8_bits > fitted.rmse_16_bits);
  CHECK(judge_model_map(sky, n, total, 0.2).rmse > 0.1);  // those totals are of another albedo
}

}  // namespace
}  // namespace heightlight
