#include "files/doubts.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "base/digits.h"
#include "base/percentile.h"

namespace heightlight {
namespace {

/// Median slope between neighbouring samples in degrees, from about 65536 of them; 0 without neighbours.
double median_slope_deg(const Heightmap& map) {
  constexpr std::size_t kEnough = 65536;
  const Image<float>& h = map.height;
  if (h.width < 2 || h.height < 2) return 0;
  const int stride = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(h.size() / kEnough))));
  std::vector<double> slopes;
  for (int row = 0; row + 1 < h.height; row += stride) {
    for (int column = 0; column + 1 < h.width; column += stride) {
      const double here = double{h(row, column)};
      const double slope = std::hypot((double{h(row, column + 1)} - here) / map.spacing.x,
                                      (double{h(row + 1, column)} - here) / map.spacing.y);
      if (!std::isnan(slope)) slopes.push_back(slope);
    }
  }
  if (slopes.empty()) return 0;
  return std::atan(percentile(std::span<double>(slopes), 0.5)) * 180 / std::numbers::pi;
}

/// "relief 0.1": a tenth of the width, the default for images of levels.
std::string tenth_of(double width) { return "relief " + in_digits(width / 10, 3); }

/// "relief 0.0084": the relief at which the median slope is 30 degrees; it is `slope_deg` at a relief of
/// `tall`.
std::string gentle_relief(double tall, double slope_deg) {
  const double degree = std::numbers::pi / 180;
  return "relief " + in_digits(tall * std::tan(30 * degree) / std::tan(slope_deg * degree), 2);
}

void doubt_relief(const Heightmap& map, const StoredHeights& stored, const LoadOptions& options,
                  std::vector<Warning>& warnings) {
  constexpr double kSteep = 60;
  const double tall = relief(map);
  const double width = map.height.width * map.spacing.x;
  const double extent = std::max(width, map.height.height * map.spacing.y);
  const bool spacing_known = options.width || options.texel || stored.place;
  const bool as_it_is = !spacing_known && !options.relief && !options.relief_share;
  const double slope = median_slope_deg(map);
  if (tall == 0) {
    warnings.push_back({"the map is level: it has no relief"});
  } else if (as_it_is && tall > 2 * extent) {
    warnings.push_back({fmt::format("its heights span {:.3g}, and without a spacing its width is taken as 1; "
                                    "give the distance between samples in the same unit",
                                    tall),
                        "texel"});
  } else if (as_it_is && !stored.facts.is_stretched && tall > 0.3 * width) {
    warnings.push_back(
        {fmt::format("its heights are taken as they are and its width as 1, so that the relief "
                     "is {:.3g} of the width; a tenth of the width is usual",
                     tall),
         tenth_of(width)});
  } else if (tall > extent) {
    warnings.push_back(
        {fmt::format("the relief is {:.3g} times the extent; is the spacing right?", tall / extent),
         "texel"});
  } else if (slope > kSteep && stored.facts.is_relief_guessed) {
    warnings.push_back(
        {fmt::format("half of it is steeper than {:.0f} degrees, since nothing tells its relief, which was "
                     "taken as a tenth of the width; give its own, or one at which that is 30 degrees",
                     slope),
         gentle_relief(tall, slope)});
  } else if (slope > kSteep) {
    warnings.push_back(
        {fmt::format("half of it is steeper than {:.0f} degrees; is the relief meant to be {:.3g} "
                     "of the width?",
                     slope, tall / width),
         "relief"});
  }
}

/// Detects lines of the map that rise and fall in single levels with plateaus between them. It does not
/// report a map that is flat along one axis, a map so steep that neighbours are hardly ever equal, or ramps
/// between plains.
class Terraces {
 public:
  explicit Terraces(double step) : step_(step) {}

  void begin_line() { last_was_level_ = false; }

  void add(float from, float to) {
    const double rise = std::abs(double{to} - double{from});
    const bool is_level = rise == 0;
    if (rise > 0) {
      ++rises_;
      if (rise < 1.5 * step_ && last_was_level_) ++from_plateau_;
    }
    last_was_level_ = is_level;
  }

  bool found() const { return rises_ > 0 && 8 * from_plateau_ > rises_; }

 private:
  double step_;
  bool last_was_level_ = false;
  std::size_t rises_ = 0;
  std::size_t from_plateau_ = 0;  ///< rises by a single level that follow a plateau
};

/// Examines about 256 lines in each direction.
bool has_terraces(const Image<float>& h, double step) {
  constexpr int kLines = 256;
  Terraces across(step);
  Terraces down(step);
  for (int row = 0; row < h.height; row += std::max(1, h.height / kLines)) {
    across.begin_line();
    for (int column = 1; column < h.width; ++column) across.add(h(row, column - 1), h(row, column));
  }
  for (int column = 0; column < h.width; column += std::max(1, h.width / kLines)) {
    down.begin_line();
    for (int row = 1; row < h.height; ++row) down.add(h(row - 1, column), h(row, column));
  }
  return across.found() || down.found();
}

void doubt_levels(const Heightmap& map, const SourceFacts& facts, std::vector<Warning>& warnings) {
  constexpr std::size_t kFewest = 16;  // a map of fewer levels is meant to have terraces
  if (!facts.is_integer || facts.levels < kFewest || facts.level_step == 0) return;
  const double terrace = facts.level_step / (facts.highest - facts.lowest) * relief(map);
  if (!has_terraces(map.height, terrace)) return;
  warnings.push_back(
      {fmt::format("only {} levels: slopes are terraces {:.2g} high, which show as contour "
                   "lines; use the original of more bits or of floats, or smooth the heights",
                   facts.levels, terrace)});
}

void doubt_edges(const Heightmap& map, std::vector<Warning>& warnings) {
  if (map.boundary != Boundary::tile || measure_edge_steps(map.height).wraps) return;
  warnings.push_back({"the map is to tile, but its edges do not meet; give it open ones if it stands alone",
                      "boundary open"});
}

}  // namespace

std::vector<Warning> find_doubts(const Heightmap& map, const StoredHeights& stored,
                                 const LoadOptions& options) {
  std::vector<Warning> warnings;
  doubt_relief(map, stored, options, warnings);
  doubt_levels(map, stored.facts, warnings);
  doubt_edges(map, warnings);
  return warnings;
}

}  // namespace heightlight
