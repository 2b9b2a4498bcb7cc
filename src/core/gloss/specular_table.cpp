#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/hash.h"
#include "base/parallel.h"
#include "gloss/cone_share.h"
#include "heightlight/error.h"
#include "heightlight/gloss.h"
#include "heightlight/occlusion_forms.h"

namespace heightlight {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2;
constexpr double kLeastRoughness = 1e-4;  // the lobe of a mirror has no width to divide by
constexpr int kTableSamples = 4096;
constexpr int kJudgeSamples = 4096;
constexpr int kLevels = 255;

/// The inverse of lobe_falloff, infinite at the ends −1 and 1.
double widths_of(double falloff) { return falloff / std::sqrt(std::max(0.0, 1 - falloff * falloff)); }

double apart_at(const TableApart<double>& axis, double place) {
  return std::clamp(axis.half_angle + axis.width * widths_of(axis.begin + place * axis.span), 0.0,
                    std::numbers::pi);
}

double roughness_at(double place) { return std::max(place * place, kLeastRoughness); }

/// The table's value at the places x and y in [0, 1], for a lobe.
double value_at(const ConeLobe& lobe, double x, double y, double roughness, double view_angle) {
  const double half_angle = x * kRightAngle;
  return cone_share(
      lobe, {half_angle, apart_at(TableApart<double>(half_angle, roughness), y), roughness, view_angle});
}

/// A place on one of the table's axes: the index of the value below, and the share of the step beyond it.
struct TablePlace {
  int below = 0;
  double share = 0;
};

TablePlace place_on_axis(double at, int side) {
  const double place = std::clamp(at, 0.0, 1.0) * (side - 1);
  const int below = std::min(static_cast<int>(place), side - 2);
  return {below, place - below};
}

std::uint8_t to_level(double share) { return static_cast<std::uint8_t>(std::lround(share * kLevels)); }

}  // namespace

SpecularTable make_specular_table(int side, const Watch& watch) {
  if (side < 4 || side > 64 || side % 4 != 0)
    throw UsageError("side", std::to_string(side), "must be a multiple of 4 from 4 to 64");
  const auto n = static_cast<std::size_t>(side);
  SpecularTable table{.side = side, .values = std::vector<std::uint8_t>(n * n * n * n)};
  Progress progress("table of specular occlusion", side * side, watch);
  parallel_for(
      side * side,
      [&](std::int64_t layer) {
        const double roughness = roughness_at(static_cast<double>(layer % side) / (side - 1));
        const double view_angle = kRightAngle * static_cast<double>(layer / side) / (side - 1);
        const ConeLobe lobe = make_cone_lobe({.roughness = roughness}, view_angle, kTableSamples, {});
        std::uint8_t* values = table.values.data() + static_cast<std::size_t>(layer) * n * n;
        for (int row = 0; row < side; ++row) {
          for (int column = 0; column < side; ++column)
            *values++ = to_level(value_at(lobe, static_cast<double>(column) / (side - 1),
                                          static_cast<double>(row) / (side - 1), roughness, view_angle));
        }
      },
      &progress);
  return table;
}

double look_up(const SpecularTable& table, const ConeArguments& arguments) {
  const double roughness = std::max(arguments.roughness, kLeastRoughness);
  const std::array<TablePlace, 4> places{
      place_on_axis(arguments.half_angle / kRightAngle, table.side),
      place_on_axis(TableApart<double>(arguments.half_angle, roughness).place(arguments.apart), table.side),
      place_on_axis(std::sqrt(roughness), table.side),
      place_on_axis(arguments.view_angle / kRightAngle, table.side)};
  double sum = 0;
  for (unsigned corner = 0; corner < 16; ++corner) {
    double weight = 1;
    std::size_t index = 0;
    for (std::size_t axis = 4; axis-- > 0;) {
      const bool is_upper = (corner >> axis & 1U) != 0;
      weight *= is_upper ? places[axis].share : 1 - places[axis].share;
      index = index * static_cast<std::size_t>(table.side) +
              static_cast<std::size_t>(places[axis].below + (is_upper ? 1 : 0));
    }
    sum += weight * table.values[index];
  }
  return sum / kLevels;
}

TableError judge_specular_table(const SpecularTable& table, int count, std::uint64_t seed,
                                const Watch& watch) {
  std::vector<double> differences(static_cast<std::size_t>(count));
  Progress progress("error of the table", count, watch);
  parallel_for(
      count,
      [&](std::int64_t i) {
        const std::uint64_t own = hash_combine(seed, static_cast<std::uint64_t>(i));
        const auto random = [own](std::uint64_t k) { return unit_real(hash_combine(own, k)); };
        ConeArguments arguments{.half_angle = std::acos(std::sqrt(1 - random(0))),
                                .roughness = roughness_at(random(1)),
                                .view_angle = random(2) * 85.0 / 90 * kRightAngle};
        arguments.apart = random(3) * (arguments.view_angle + kRightAngle);
        const ConeLobe lobe = make_cone_lobe({.roughness = arguments.roughness}, arguments.view_angle,
                                             kJudgeSamples, {random(4), random(5)});
        differences[static_cast<std::size_t>(i)] = look_up(table, arguments) - cone_share(lobe, arguments);
      },
      &progress);
  TableError error;
  for (const double difference : differences) {
    error.rmse += difference * difference / count;
    error.largest = std::max(error.largest, std::fabs(difference));
  }
  error.rmse = std::sqrt(error.rmse);
  return error;
}

}  // namespace heightlight
