#include "cli/number_list.h"

#include <charconv>
#include <cmath>

namespace heightlight {

std::optional<std::vector<double>> parse_number_list(const std::string& text) {
  std::vector<double> numbers;
  const char* end = text.data() + text.size();
  for (const char* at = text.data();;) {
    double number = 0;
    const auto [stop, fault] = std::from_chars(at, end, number);
    if (fault != std::errc() || !std::isfinite(number) || (stop != end && *stop != ',')) return std::nullopt;
    numbers.push_back(number);
    if (stop == end) return numbers;
    at = stop + 1;
  }
}

}  // namespace heightlight
