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

/// Lines beside a border whose steps a seam is measured by: an eighth of the map, at least four.
int lines_beside(int count) { return std::max(4, count / 8); }

/// Steps from line to line of one axis: `step(from, to, mean)` adds those between two lines.
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

/// A border along a steep flank or a joint has lines beside it that differ as much; but a single steep line
/// does not make up for a step of many times what is usual. Where nothing was measured (NaN) comparisons
/// fail, and there is no seam to speak of. Materials that tile have ratios of at most 1.0 and 2.3, their
/// crops from 1.1 or 4.9 on.
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
