#include <algorithm>
#include <cmath>
#include <limits>

#include "heightlight/heightmap.h"

namespace heightlight {
namespace {

/// Root mean square of steps between samples that are both present.
class StepMean {
 public:
  void add(float from, float to) {
    const double step = static_cast<double>(to) - static_cast<double>(from);
    if (std::isnan(step)) return;
    sum_ += step * step;
    ++count_;
  }

  double root_mean_square() const {
    return count_ > 0 ? std::sqrt(sum_ / static_cast<double>(count_))
                      : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

/// Number of lines beside a border with whose steps the seam is compared: an eighth of the map, at least
/// four.
int lines_beside(int count) { return std::max(4, count / 8); }

/// Root mean square steps between adjacent lines of one axis: across the border, inside the map, and the
/// largest of those beside the border. `step(from, to, mean)` of measure_axis adds the steps between two
/// lines.
struct AxisSteps {
  double across;
  double inside;
  double beside;
};

template <class Step>
AxisSteps measure_axis(int count, const Step& step) {
  StepMean across;
  StepMean inside;
  if (count > 1) step(count - 1, 0, across);
  double beside = std::numeric_limits<double>::quiet_NaN();
  for (int line = 1; line < count; ++line) {
    step(line - 1, line, inside);
    if (line > lines_beside(count) && line < count - lines_beside(count)) continue;
    StepMean pair;
    step(line - 1, line, pair);
    beside = std::fmax(beside, pair.root_mean_square());
  }
  return {across.root_mean_square(), inside.root_mean_square(), beside};
}

/// Whether the border is a seam. At a border along a steep flank or a joint, the lines beside it differ as
/// much, so that there is no seam; but one steep line does not excuse a step many times as large as usual.
/// Where nothing was measured (NaN) the comparisons fail, and no seam is reported. Materials that tile have
/// ratios of at most 1.0 and 2.3; crops of them have at least 1.1 or 4.9.
bool is_seam(const AxisSteps& steps) {
  constexpr double kAlike = 1.5;
  constexpr double kFar = 4;
  return steps.across > kAlike * steps.beside || steps.across > kFar * steps.inside;
}

}  // namespace

EdgeSteps measure_edge_steps(const Image<float>& height) {
  const AxisSteps x = measure_axis(height.width, [&](int from, int to, StepMean& mean) {
    for (int row = 0; row < height.height; ++row) mean.add(height(row, from), height(row, to));
  });
  const AxisSteps y = measure_axis(height.height, [&](int from, int to, StepMean& mean) {
    for (int column = 0; column < height.width; ++column) mean.add(height(from, column), height(to, column));
  });
  return {.across_x = x.across,
          .inside_x = x.inside,
          .beside_x = x.beside,
          .across_y = y.across,
          .inside_y = y.inside,
          .beside_y = y.beside,
          .wraps = !is_seam(x) && !is_seam(y)};
}

}  // namespace heightlight
