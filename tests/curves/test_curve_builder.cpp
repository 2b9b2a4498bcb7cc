#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
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
  TexelVector values(map.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = unit_real(hash_combine(seed, i));
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

/// How far a percentile may be off: nothing in a bin of up to 2048 texels, 1/65536 of the range in a fuller
/// one, beside a range too small to divide by and the rounding of a few operations, n·ε.
double percentile_bound(const std::vector<double>& values) {
  const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
  const double rounding = 1e-15 * std::max(std::fabs(*least), std::fabs(*greatest));
  if (values.size() <= 2048) return rounding;
  return rounding + std::max((*greatest - *least) / 65536, 1e-303);
}

void check_same(const BounceStatistics& got, const std::vector<double>& values) {
  const BounceStatistics expected = brute_force(values);
  // Identity: sums of a few thousand values of order 1, each rounded once, n·ε.
  constexpr double kRounding = 1e-12;
  CHECK(got.mean == Approx(expected.mean).epsilon(kRounding));
  CHECK(got.stddev == Approx(expected.stddev).epsilon(kRounding).margin(kRounding));
  const double bound = percentile_bound(values);
  CHECK(std::fabs(got.p05 - expected.p05) <= bound);
  CHECK(std::fabs(got.p50 - expected.p50) <= bound);
  CHECK(std::fabs(got.p95 - expected.p95) <= bound);
}

/// Of all values in one bin.
BounceStatistics statistics_of(const std::vector<double>& values) {
  const int count = static_cast<int>(values.size());
  CurveBuilder builder(Map(count, 1, 0.5F), AoKind::ambient_occlusion, 1);
  builder.add(values);
  return builder.curves().filled.at(0).bounces.at(0);
}

/// Each value made from a random number in [0, 1).
template <class Shape>
std::vector<double> random_values(std::size_t count, Shape&& shape) {
  std::vector<double> values;
  for (std::size_t i = 0; i < count; ++i) values.push_back(shape(unit_real(hash_combine(7, i))));
  return values;
}

/// Everything that curves say, in one list.
std::vector<double> flatten(const BounceCurves& curves) {
  std::vector<double> all;
  for (const CurveBin& bin : curves.filled) {
    all.insert(all.end(), {bin.ao_mean, static_cast<double>(bin.count)});
    std::vector<BounceStatistics> rows = bin.bounces;
    rows.push_back(bin.tail);
    for (const BounceStatistics& b : rows) all.insert(all.end(), {b.mean, b.stddev, b.p05, b.p50, b.p95});
  }
  return all;
}

}  // namespace

TEST_CASE("Bins hold the texels between their edges, and their statistics are those of brute force",
          "[curves]") {
  const int bins = GENERATE(1, 3, 100, 10000);
  const Map ao = random_map(bins > 1000 ? 60 : 150, 1);  // the larger has more than one block of texels
  const TexelVector first = random_irradiance(ao, 2);
  const TexelVector second = random_irradiance(ao, 3);
  CurveBuilder builder(ao, AoKind::sky_view_factor, bins);
  builder.add(first);
  builder.add(second);
  builder.add_tail(to_texels(as_eigen(first) + as_eigen(second)));
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
      members.push_back(value);
      first_values.push_back(first[i]);
      second_values.push_back(second[i]);
      tail_values.push_back(first[i] + second[i]);
    }
    REQUIRE(bin.count == members.size());
    REQUIRE(bin.bounces.size() == 2);
    CHECK(bin.ao_mean == Approx(brute_force(members).mean).epsilon(1e-12));  // identity
    check_same(bin.bounces[0], first_values);
    check_same(bin.bounces[1], second_values);
    check_same(bin.tail, tail_values);
    texels += bin.count;
  }
  CHECK(texels == ao.size());
}

TEST_CASE("Statistics of few values are those of brute force", "[curves]") {
  std::vector<double> values;
  for (std::uint64_t i = 0; i < 45; ++i) {
    values.push_back(std::floor(20 * unit_real(scramble(i))));  // with ties
    check_same(statistics_of(values), values);
  }
}

TEST_CASE("A narrow spread about a large mean keeps its digits", "[curves]") {
  const BounceStatistics result = statistics_of({1e9 + 1, 1e9 + 2, 1e9 + 3, 1e9 + 4});
  CHECK(result.mean == 1e9 + 2.5);
  CHECK(result.stddev == Approx(std::sqrt(1.25)).epsilon(1e-15));  // identity: all deviations are exact
  check_same(statistics_of(random_values(100'000, [](double u) { return 1e9 + u; })),
             random_values(100'000, [](double u) { return 1e9 + u; }));
}

TEST_CASE("A few large values at the start take no digits from the small ones' mean", "[curves]") {
  std::vector<double> values = random_values(100'000, [](double u) { return 1e-6 * u; });
  std::fill_n(values.begin(), 10, 1e3);
  check_same(statistics_of(values), values);
  std::fill_n(values.begin(), 20'000, 1e3);  // a block's, all
  check_same(statistics_of(values), values);
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

TEST_CASE("Percentiles of few texels are exact, and of many within their bound, however the values lie",
          "[curves]") {
  const std::size_t count = GENERATE(2048, 2049, 20'000, 70'001);
  const auto check = [&](const auto& shape) {
    const std::vector<double> values = random_values(count, shape);
    check_same(statistics_of(values), values);
  };
  check([](double u) { return u; });
  check([](double u) { return -std::log(1 - u); });             // a long tail
  check([](double u) { return u < 0.0001 ? 1 : 1e-3 * u; });    // few outliers
  check([](double u) { return u < 0.5 ? 0.1 * u : 0.9 + u; });  // two clumps, the median between them
  check([](double u) { return std::floor(10 * u); });           // ties
  check([](double u) { return u < 0.9 ? 1 : 0; });              // ties at both ends
  check([](double) { return 0.7; });                            // no range
  check([](double u) { return 1e-310 * u; });                   // a range too small to divide by
  check([](double u) { return u - 3; });                        // below 0
}

TEST_CASE("Percentiles of a narrow spread are as good as those of a wide one", "[curves]") {
  const std::vector<double> values = random_values(100'000, [](double u) { return 1e-6 * std::sqrt(u); });
  const BounceStatistics got = statistics_of(values);
  const BounceStatistics expected = brute_force(values);
  // Discretisation: the range is √18 standard deviations, of which 1/65536 is 6.5e-5.
  const double tolerance = 1e-4 * expected.stddev;
  CHECK(std::fabs(got.p05 - expected.p05) <= tolerance);
  CHECK(std::fabs(got.p50 - expected.p50) <= tolerance);
  CHECK(std::fabs(got.p95 - expected.p95) <= tolerance);
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
  TexelVector irradiance(4, 1);
  irradiance[1] = 1000;
  CurveBuilder builder(ao, AoKind::ambient_occlusion, 10);
  builder.add(irradiance);
  REQUIRE(builder.curves().filled.size() == 1);
  CHECK(builder.curves().filled[0].count == 3);
  CHECK(builder.curves().filled[0].bounces[0].p95 == 1);

  Map half(200, 200, 0.5F);  // more than one block of texels, and more than are few
  TexelVector known(half.size(), 2);
  for (std::size_t i = 0; i < half.size(); i += 2) {
    half.values[i] = kMissing;
    known[i] = std::nan("");
  }
  CurveBuilder of_half(half, AoKind::ambient_occlusion, 10);
  of_half.add(known);
  REQUIRE(of_half.curves().filled.size() == 1);
  CHECK(of_half.curves().filled[0].count == 200 * 200 / 2);
  CHECK(of_half.curves().filled[0].bounces[0].mean == 2);
  CHECK(of_half.curves().filled[0].bounces[0].stddev == 0);
  CHECK(of_half.curves().filled[0].bounces[0].p50 == 2);

  CurveBuilder none(Map(4, 1, kMissing), AoKind::ambient_occlusion, 10);
  none.add(irradiance);
  none.add_tail(irradiance);
  CHECK(none.curves().filled.empty());
}

TEST_CASE("Curves are the same to the last bit for any number of threads", "[curves]") {
  const Map ao = random_map(400, 5);
  const int bins = GENERATE(10, 100, 1000);  // full ones, and ones with few texels
  const TexelVector irradiance = random_irradiance(ao, 6);
  const auto curves = [&](int threads) {
    const ThreadScope scope(threads);
    CurveBuilder builder(ao, AoKind::ambient_occlusion, bins);
    builder.add(irradiance);
    builder.add_tail(to_texels(as_eigen(irradiance).cwiseSqrt()));
    return flatten(builder.curves());
  };
  const std::vector<double> one = curves(1);
  CHECK(curves(2) == one);
  CHECK(curves(7) == one);
}

TEST_CASE("Irradiance in floats gives what the same values give in doubles", "[curves]") {
  const Map ao = random_map(200, 8);
  const int bins = GENERATE(5, 100);  // full ones, and ones with few texels
  const TexelVector doubles = random_irradiance(ao, 9);
  const std::vector<float> floats(doubles.begin(), doubles.end());
  CurveBuilder of_floats(ao, AoKind::ambient_occlusion, bins);
  of_floats.add(floats);
  of_floats.add_tail(floats);
  CurveBuilder of_doubles(ao, AoKind::ambient_occlusion, bins);
  of_doubles.add(TexelVector(floats.begin(), floats.end()));
  const std::vector<CurveBin>& got = of_floats.curves().filled;
  const std::vector<CurveBin>& expected = of_doubles.curves().filled;
  REQUIRE(got.size() == expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    const BounceStatistics& other = expected[i].bounces[0];
    for (const BounceStatistics& one : {got[i].bounces[0], got[i].tail}) {
      CHECK(one.mean == Approx(other.mean).epsilon(1e-14));  // identity: a few roundings, in both
      CHECK(one.stddev == Approx(other.stddev).epsilon(1e-14));
      CHECK(one.p05 == other.p05);
      CHECK(one.p50 == other.p50);
      CHECK(one.p95 == other.p95);
    }
  }
}

TEST_CASE("A number of bins outside 1 to 10000 is a usage error", "[curves]") {
  const int bins = GENERATE(0, -1, 10001);
  CHECK_THROWS_AS(CurveBuilder(Map(2, 2, 0.5F), AoKind::ambient_occlusion, bins), UsageError);
}
