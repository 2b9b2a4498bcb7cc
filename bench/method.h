#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "heightlight/image.h"
#include "receivers.h"

namespace heightlight {

/// A way to find one value per texel (the sky view factor, or the total irradiance / π) of a given surface,
/// with one setting that trades time for accuracy. Of the two ways to run it, `run_map` is for those fast
/// enough to be timed on the whole map; a method that has only `run_receivers` is timed on rows of it.
struct Method {
  std::string name;
  std::string parameter;      ///< what the setting counts: "rays"
  std::vector<int> settings;  ///< to be tried, cheapest first; settings between them are fair too
  int granularity = 1;        ///< settings between them are rounded up to its multiples
  std::function<int(double)> setting_for;  ///< where settings ask for an error: the one that asks for it
  bool is_baseline = false;                ///< others are compared with the cheapest of these
  Cost built;                              ///< what making it for the surface took, whatever the setting
  std::function<void(int)> set_up;  ///< readies it for a setting; timed apart. Empty where all is in the run
  std::function<Map(int)> run_map;
  std::function<std::vector<float>(int, const Receivers&)> run_receivers;
};

/// Whole numbers from `least` to `most`, each √2 times the one before.
inline std::vector<int> geometric_settings(int least, int most) {
  std::vector<int> settings;
  for (int i = 0;; ++i) {
    const int setting = static_cast<int>(std::lround(least * std::pow(2.0, 0.5 * i)));
    if (setting > most) return settings;
    settings.push_back(setting);
  }
}

}  // namespace heightlight
