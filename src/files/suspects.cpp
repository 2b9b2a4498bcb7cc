#include "files/suspects.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/digits.h"

namespace heightlight {
namespace {

/// Whether programs commonly write this value for missing samples. The lowest and the highest float are among
/// these.
bool is_usual(double value) {
  constexpr std::array kUsual{-32768.0, -32767.0, -9999.0, -99999.0, 9999.0, 99999.0, 32767.0};
  return std::find(kUsual.begin(), kUsual.end(), value) != kUsual.end() || std::abs(value) >= 1e9;
}

/// The outermost value on one side of a map, its count and position, and the next value that is not usual for
/// missing samples. (Several such values may occur side by side.)
struct Outermost {
  double value = 0;
  double next = 0;
  std::size_t count = 0;
  std::size_t first = 0;  ///< index of the first sample that has the value
};

/// `side` is 1 for the highest value, −1 for the lowest. At least one sample must be present.
Outermost find_outermost(const std::vector<double>& values, double side) {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  Outermost found{.value = kNothing, .next = kNothing};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = side * values[i];  // comparisons with NaN are false
    if (value > found.value) {
      if (!is_usual(side * found.value)) found.next = found.value;
      found.value = value;
      found.count = 1;
      found.first = i;
    } else if (value == found.value) {
      ++found.count;
    } else if (value > found.next && !is_usual(values[i])) {
      found.next = value;
    }
  }
  found.value *= side;
  found.next *= side;
  return found;
}

/// Whether a value is far from the others: by more than their span if it is usual for missing samples, by
/// more than ten times their span if it is any other value.
bool is_far(const Outermost& one, double span) {
  constexpr double kMuch = 10;
  const double gap = std::abs(one.value - one.next);
  if (!std::isfinite(gap)) return false;  // there is no other value
  if (is_usual(one.value)) return gap > span;
  return span > 0 && gap > kMuch * span;
}

/// Decimal digits from which the stored value can be read back, whatever its type.
std::string digits_of(double value, const std::string& sample_type) {
  if (sample_type == "float" || sample_type == "half") return in_digits(static_cast<float>(value));
  return in_digits(value);
}

}  // namespace

std::vector<Warning> find_suspects(const StoredHeights& stored) {
  const Outermost lowest = find_outermost(stored.values.values, -1);
  const Outermost highest = find_outermost(stored.values.values, 1);
  const double span = std::max(0.0, highest.next - lowest.next);
  std::vector<Warning> warnings;
  struct Side {
    const Outermost& outermost;
    const char* far;
    const char* others;
  };
  for (const auto& [one, far, others] : {Side{lowest, "below", "up"}, Side{highest, "above", "down"}}) {
    if (!is_far(one, span)) continue;
    const std::string value = digits_of(one.value, stored.facts.sample_type);
    const auto width = static_cast<std::size_t>(stored.values.width);
    const std::string who = one.count == 1 ? fmt::format("one sample, in row {} and column {}, is {}",
                                                         one.first / width, one.first % width, value)
                                           : fmt::format("{} samples are {}", one.count, value);
    const std::string next = digits_of(one.next, stored.facts.sample_type);
    warnings.push_back({fmt::format("{}, far {} all others ({} and {}); if that means missing, say so", who,
                                    far, next, others),
                        "no_data " + value});
  }
  return warnings;
}

}  // namespace heightlight
