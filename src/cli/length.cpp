#include "cli/length.h"

#include <array>
#include <charconv>
#include <utility>

namespace heightlight {

std::optional<Length> read_length(const std::string& text) {
  static constexpr std::array<std::pair<const char*, double>, 6> kUnits{
      {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}, {"km", 1e3}, {"in", 0.0254}, {"ft", 0.3048}}};
  double value = 0;
  const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc()) return std::nullopt;
  std::string unit = text.substr(static_cast<std::size_t>(stop - text.data()));
  unit.erase(0, unit.find_first_not_of(' '));
  if (unit.empty()) return Length{value, false};
  for (const auto& [name, metres] : kUnits) {
    if (unit == name) return Length{value * metres, true};
  }
  return std::nullopt;
}

}  // namespace heightlight
