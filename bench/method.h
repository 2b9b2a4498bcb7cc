#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "heightlight/image.h"
#include "receivers.h"

namespace heightlight {

/// A method to find one value per texel (the sky view factor, or the total irradiance / π) of a given
/// surface, with one setting that trades time for accuracy. `run_map` is for methods that are fast enough to
/// be timed on the whole map; a method that has only `run_receivers` is timed on some rows.
struct Method {
  std::string name;
  std::string parameter;      ///< what the setting counts: "rays"
  std::vector<int> settings;  ///< settings to try, cheapest first; values between them are allowed too
  int granularity = 1;        ///< values between `settings` are rounded up to multiples of this
  std::function<int(double)> setting_for;  ///< setting for an error, if the method plans for one; else empty
  bool is_baseline = false;                ///< others are compared with the cheapest of these
  Cost built;                       ///< cost of making the method for the surface, whatever the setting
  std::function<void(int)> set_up;  ///< prepares a setting; timed apart. Empty if the run does everything
  std::function<Map(int)> run_map;
  std::function<std::vector<float>(int, const Receivers&)> run_receivers;
};

/// Whole numbers from `least` to `most`, each √2 times the one before, rounded.
inline std::vector<int> geometric_settings(int least, int most) {
  std::vector<int> settings;
  for (int i = 0;; ++i) {
    const int setting = static_cast<int>(std::lround(least * std::pow(2.0, 0.5 * i)));
    if (setting > most) return settings;
    settings.push_back(setting);
  }
}

}  // namespace heightlight
