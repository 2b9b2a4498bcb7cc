#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/hash.h"
#include "core/parallel.h"
#include "heightlight/curves.h"
#include "heightlight/error.h"

using namespace heightlight;

namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

Map random_map(int side, std::uint64_t seed) {
  Map map(side, side);
  for (std::size_t i = 0; i < map.size(); ++i) {
    map.values[i] = static_cast<float>(unit_real(hash_combine(seed, i)));
  }
  return map;
}

TexelVector random_irradiance(const Map& map, std::uint64_t seed) {
  TexelVector values(static_cast<Eigen::Index>(map.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    values[i] = unit_real(hash_combine(seed, static_cast<std::uint64_t>(i)));
  }
  return values;
}

/// The percentile from its definition: sort, then interpolate at share × (n − 1).
double sorted_percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double place = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (values[above] - values[below]) * (place - static_cast<double>(below));
}

BounceStatistics brute_force(const std::vector<double>& values) {
  long double sum = 0;
  for (const double value : values) sum += value;
  const long double mean = sum / static_cast<long double>(values.size());
  long double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {static_cast<double>(mean),
          static_cast<double>(std::sqrt(squares / static_cast<long double>(values.size()))),
          sorted_percentile(values, 0.05), sorted_percentile(values, 0.50), sorted_percentile(values, 0.95)};
}

void check_same(const BounceStatistics& got, const BounceStatistics& expected) {
  // Identity: sums of a few thousand values of order 1, each rounded once, n·ε.
  constexpr double kRounding = 1e-12;
  CHECK(got.mean == Approx(expected.mean).epsilon(kRounding));
  CHECK(got.stddev == Approx(expected.stddev).epsilon(kRounding).margin(kRounding));
  CHECK(got.p05 == Approx(expected.p05).epsilon(kRounding));
  CHECK(got.p50 == Approx(expected.p50).epsilon(kRounding));
  CHECK(got.p95 == Approx(expected.p95).epsilon(kRounding));
}

BounceStatistics statistics_of(const std::vector<double>& values) {
  const int count = static_cast<int>(values.size());
  CurveBuilder builder(Map(count, 1, 0.5F), AoKind::ambient_occlusion, 1);
  builder.add(Eigen::Map<const TexelVector>(values.data(), count));
  return builder.curves().filled.at(0).bounces.at(0);
}

}  // namespace

TEST_CASE("Bins hold the texels between their edges, and their statistics are those of brute force",
          "[curves]") {
  const int bins = GENERATE(1, 3, 100, 10000);
  const Map ao = random_map(60, 1);
  const TexelVector first = random_irradiance(ao, 2);
  const TexelVector second = random_irradiance(ao, 3);
  CurveBuilder builder(ao, AoKind::sky_view_factor, bins);
  builder.add(first);
  builder.add(second);
  builder.add_tail(first + second);
  const BounceCurves& curves = builder.curves();
  CHECK(curves.kind == AoKind::sky_view_factor);
  CHECK(curves.bins == bins);
  std::size_t texels = 0;
  for (const CurveBin& bin : curves.filled) {
    CHECK(bin.ao_lo == static_cast<double>(bin.bin) / bins);
    CHECK(bin.ao_hi == (bin.bin + 1.0) / bins);
    std::vector<double> members, first_values, second_values, tail_values;
    for (std::size_t i = 0; i < ao.size(); ++i) {
      const double value = static_cast<double>(ao.values[i]);
      if (value < bin.ao_lo || value >= bin.ao_hi) continue;
      const auto texel = static_cast<Eigen::Index>(i);
      members.push_back(value);
      first_values.push_back(first[texel]);
      second_values.push_back(second[texel]);
      tail_values.push_back(first[texel] + second[texel]);
    }
    REQUIRE(bin.count == members.size());
    REQUIRE(bin.bounces.size() == 2);
    CHECK(bin.ao_mean == Approx(brute_force(members).mean).epsilon(1e-12));  // identity
    check_same(bin.bounces[0], brute_force(first_values));
    check_same(bin.bounces[1], brute_force(second_values));
    check_same(bin.tail, brute_force(tail_values));
    texels += bin.count;
  }
  CHECK(texels == ao.size());
}

TEST_CASE("Statistics of few values are those of brute force", "[curves]") {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < 45; ++i) {
    values.push_back(std::floor(20 * unit_real(scramble(i))));  // with ties
    check_same(statistics_of(values), brute_force(values));
  }
}

TEST_CASE("A narrow spread about a large mean keeps its digits", "[curves]") {
  const BounceStatistics result = statistics_of({1e9 + 1, 1e9 + 2, 1e9 + 3, 1e9 + 4});
  CHECK(result.mean == 1e9 + 2.5);
  CHECK(result.stddev == Approx(std::sqrt(1.25)).epsilon(1e-15));  // identity: all deviations are exact
}

TEST_CASE("Percentiles lie between order statistics", "[curves]") {
  const BounceStatistics result = statistics_of({30, 10, 40, 20});
  CHECK(result.p05 == Approx(11.5));
  CHECK(result.p50 == 25);
  CHECK(result.p95 == Approx(38.5));
  const BounceStatistics alone = statistics_of({7});
  CHECK(alone.p05 == 7);
  CHECK(alone.p95 == 7);
  CHECK(alone.stddev == 0);
}

TEST_CASE(
    "An open texel is in the last bin, a bin's lower edge inside it, and rounding past the range as well",
    "[curves]") {
  Map ao(5, 1);
  ao.values = {1.0F, 0.25F, 0.0F, std::nextafter(1.0F, 2.0F), -1e-8F};
  const BounceCurves curves = CurveBuilder(ao, AoKind::ambient_occlusion, 4).curves();
  REQUIRE(curves.filled.size() == 3);
  CHECK(curves.filled[0].bin == 0);
  CHECK(curves.filled[0].count == 2);
  CHECK(curves.filled[1].bin == 1);
  CHECK(curves.filled[1].count == 1);
  CHECK(curves.filled[2].bin == 3);
  CHECK(curves.filled[2].count == 2);
}

TEST_CASE("Missing texels are in no bin, and a map of them has none", "[curves]") {
  Map ao(4, 1, 0.5F);
  ao.values[1] = kMissing;
  TexelVector irradiance = TexelVector::Ones(4);
  irradiance[1] = 1000;
  CurveBuilder builder(ao, AoKind::ambient_occlusion, 10);
  builder.add(irradiance);
  REQUIRE(builder.curves().filled.size() == 1);
  CHECK(builder.curves().filled[0].count == 3);
  CHECK(builder.curves().filled[0].bounces[0].p95 == 1);

  CurveBuilder none(Map(4, 1, kMissing), AoKind::ambient_occlusion, 10);
  none.add(irradiance);
  none.add_tail(irradiance);
  CHECK(none.curves().filled.empty());
}

TEST_CASE("Curves are the same to the last bit for any number of threads", "[curves]") {
  const Map ao = random_map(200, 5);
  const TexelVector irradiance = random_irradiance(ao, 6);
  const auto means = [&](int threads) {
    set_thread_count(threads);
    CurveBuilder builder(ao, AoKind::ambient_occlusion, 100);
    builder.add(irradiance);
    std::vector<double> all;
    for (const CurveBin& bin : builder.curves().filled) {
      const BounceStatistics& b = bin.bounces[0];
      all.insert(all.end(), {bin.ao_mean, b.mean, b.stddev, b.p05, b.p50, b.p95});
    }
    return all;
  };
  const std::vector<double> one = means(1);
  CHECK(means(2) == one);
  CHECK(means(7) == one);
  set_thread_count(0);
}

TEST_CASE("A number of bins outside 1 to 10000 is a usage error", "[curves]") {
  const int bins = GENERATE(0, -1, 10001);
  CHECK_THROWS_AS(CurveBuilder(Map(2, 2, 0.5F), AoKind::ambient_occlusion, bins), UsageError);
}
