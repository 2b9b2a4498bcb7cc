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

/// Where nothing was measured (NaN) the comparison fails, and there is no seam to speak of.
bool is_seam(double across, double inside) {
  constexpr double kAlike = 1.5;
  return across > kAlike * inside;
}

}  // namespace

EdgeSteps measure_edge_steps(const Image<float>& height) {
  StepMean across_x;
  StepMean inside_x;
  StepMean across_y;
  StepMean inside_y;
  for (int row = 0; row < height.height; ++row) {
    for (int column = 1; column < height.width; ++column)
      inside_x.add(height(row, column - 1), height(row, column));
    if (height.width > 1) across_x.add(height(row, height.width - 1), height(row, 0));
  }
  for (int column = 0; column < height.width && height.height > 1; ++column) {
    across_y.add(height(height.height - 1, column), height(0, column));
  }
  for (int row = 1; row < height.height; ++row) {
    for (int column = 0; column < height.width; ++column)
      inside_y.add(height(row - 1, column), height(row, column));
  }
  EdgeSteps steps{across_x.root_mean_square(), inside_x.root_mean_square(), across_y.root_mean_square(),
                  inside_y.root_mean_square(), false};
  steps.wraps = !is_seam(steps.across_x, steps.inside_x) && !is_seam(steps.across_y, steps.inside_y);
  return steps;
}

}  // namespace heightlight
