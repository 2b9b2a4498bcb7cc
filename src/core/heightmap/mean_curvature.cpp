#include "heightmap/mean_curvature.h"

#include <array>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace heightlight {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// The samples on both sides of one; where one of them is missing, the surface is continued in a straight
/// line.
struct Axis {
  double before = 0;
  double after = 0;

  Axis(double left, double here, double right) : before(left), after(right) {
    if (std::isnan(left)) before = std::isnan(right) ? here : 2 * here - right;
    if (std::isnan(right)) after = std::isnan(left) ? here : 2 * here - left;
  }
  double slope(double spacing) const { return (after - before) / (2 * spacing); }
  double bend(double here, double spacing) const {
    return ((after - here) - (here - before)) / (spacing * spacing);
  }
};

/// Heights of a sample and its eight neighbours, rows from the top.
using Around = std::array<std::array<double, 3>, 3>;

Around around(const Image<double>& height, int row, int column, bool tiles) {
  const auto place = [tiles](int i, int count) {
    if (tiles) return (i + count) % count;
    return i < 0 || i >= count ? -1 : i;
  };
  Around found{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int at_row = place(row + i - 1, height.height);
      const int at_column = place(column + j - 1, height.width);
      found[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] =
          at_row < 0 || at_column < 0 ? kMissing : height(at_row, at_column);
    }
  }
  return found;
}

double curvature_of(const Around& h, const Spacing& spacing) {
  const double here = h[1][1];
  if (std::isnan(here)) return kMissing;
  const Axis across(h[1][0], here, h[1][2]);
  const Axis up(h[2][1], here, h[0][1]);  // y points up the image
  const double x = across.slope(spacing.x);
  const double y = up.slope(spacing.y);
  const double xx = across.bend(here, spacing.x);
  const double yy = up.bend(here, spacing.y);
  double xy = (h[0][2] - h[0][0] - h[2][2] + h[2][0]) / (4 * spacing.x * spacing.y);
  if (std::isnan(xy)) xy = 0;
  const double squared = 1 + x * x + y * y;
  return -((1 + y * y) * xx - 2 * x * y * xy + (1 + x * x) * yy) / (2 * squared * std::sqrt(squared));
}

}  // namespace

Map mean_curvature(const Image<double>& height, const Spacing& spacing, Boundary boundary) {
  Map curvature(height.width, height.height);
  parallel_for(height.height, [&](std::int64_t line) {
    const int row = static_cast<int>(line);
    for (int column = 0; column < height.width; ++column)
      curvature(row, column) =
          static_cast<float>(curvature_of(around(height, row, column, boundary == Boundary::tile), spacing));
  });
  return curvature;
}

}  // namespace heightlight
