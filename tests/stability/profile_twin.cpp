#include "stability/profile_twin.h"

#include <algorithm>
#include <limits>
#include <numbers>

#include "visibility/ray_traversal.h"

namespace heightlight {
namespace {

using Real = long double;

/// The mesh as far as a line over it needs it: heights at vertices that may lie beyond the map's edges.
struct Mesh {
  const Surface& surface;

  /// NaN where nothing is.
  Real height(std::int64_t row, std::int64_t column) const {
    const std::int64_t rows = surface.height();
    const std::int64_t columns = surface.width();
    if (surface.tiles()) {
      row = (row % rows + rows) % rows;
      column = (column % columns + columns) % columns;
    } else if (row < 0 || row >= rows || column < 0 || column >= columns) {
      return std::numeric_limits<Real>::quiet_NaN();
    }
    return surface.map.height(static_cast<int>(row), static_cast<int>(column));
  }

  bool present(std::int64_t row, std::int64_t column) const { return !std::isnan(height(row, column)); }

  /// At a share of the way along the edge that leads `down` and `right` from a vertex; NaN unless it borders
  /// a facet.
  Real on_edge(std::int64_t row, std::int64_t column, int down, int right, Real share) const {
    bool facet = false;
    if (down == 1 && right == 0) facet = present(row, column - 1) || present(row + 1, column + 1);
    if (down == 0 && right == 1) facet = present(row + 1, column + 1) || present(row - 1, column);
    if (down == 1 && right == 1) facet = present(row, column + 1) || present(row + 1, column);
    const Real from = height(row, column);
    const Real to = height(row + down, column + right);
    return facet ? from + share * (to - from) : std::numeric_limits<Real>::quiet_NaN();
  }
};

/// The line over the map from a vertex, in texels per world unit of way.
struct Line {
  std::int64_t row, column;
  Real height;
  Real step_u, step_v;
};

/// Raises the slope to that of the line's crossing with one edge, `way` from its start.
void look(const Mesh& mesh, const Line& line, Real way, std::int64_t row, std::int64_t column, int down,
          int right, Real share, Real& slope) {
  const Real height = mesh.on_edge(line.row + row, line.column + column, down, right, share);
  if (!std::isnan(height)) slope = std::max(slope, (height - line.height) / way);
}

/// Slope of the horizon, at least `tangent`.
Real horizon_slope(const Mesh& mesh, const Line& line, Real tangent) {
  const Real relief = Real{mesh.surface.highest} - line.height;
  const Real cells = std::max(mesh.surface.width(), mesh.surface.height());
  const Real farthest =
      cells * (mesh.surface.tiles() ? kMostWraps : 1.5L) / std::hypot(line.step_u, line.step_v);
  Real slope = tangent;
  // The next line of each family: columns u = i, rows v = i, diagonals u − v = i.
  const Real rates[] = {line.step_u, line.step_v, line.step_u - line.step_v};
  std::int64_t next[] = {1, 1, 1};
  for (;;) {
    int family = -1;
    Real way = farthest;
    for (int f = 0; f < 3; ++f) {
      const Real at = static_cast<Real>(next[f]) / std::fabs(rates[f]);
      if (rates[f] == 0 || at > way) continue;
      way = at;
      family = f;
    }
    if (family < 0 || relief / way <= slope) return slope;  // what comes is no higher, and farther away
    const std::int64_t i = rates[family] > 0 ? next[family] : -next[family];
    ++next[family];
    const Real u = way * line.step_u;
    const Real v = way * line.step_v;
    const auto down = static_cast<std::int64_t>(std::floor(v));
    const auto right = static_cast<std::int64_t>(std::floor(u));
    if (family == 0) look(mesh, line, way, down, i, 1, 0, v - std::floor(v), slope);
    if (family == 1) look(mesh, line, way, i, right, 0, 1, u - std::floor(u), slope);
    if (family == 2) look(mesh, line, way, down, down + i, 1, 1, v - std::floor(v), slope);
  }
}

/// 2 ∫ (c cosθ + n_z sinθ) cosθ dθ from the slope m to the zenith (visibility/sky_walk.h).
Real slice_mass(Real c, Real n_z, Real m) {
  const Real q = 1 / (1 + m * m);
  // atan2 keeps the digits of the small angle from the zenith.
  return c * (std::atan2(Real{1}, m) - m * q) + n_z * q;
}

}  // namespace

TwinSky twin_sky(const Surface& surface, int row, int column, int azimuths) {
  const Mesh mesh{surface};
  const Vector3 normal = surface.normal(row, column);
  const Real length = std::hypot(Real{normal.x}, Real{normal.y}, Real{normal.z});
  Real sky = 0;
  Real hemisphere = 0;
  Real solid = 0;
  for (int k = 0; k < azimuths; ++k) {
    const Real azimuth =
        2 * std::numbers::pi_v<Real> * (static_cast<Real>(k) + 0.25L) / static_cast<Real>(azimuths);
    const Real x = std::cos(azimuth);
    const Real y = std::sin(azimuth);
    const Real c = (Real{normal.x} * x + Real{normal.y} * y) / length;
    const Real n_z = Real{normal.z} / length;
    const Line line{row, column, surface.map.height(row, column), x / surface.map.spacing.x,
                    -y / surface.map.spacing.y};
    const Real tangent = -c / n_z;
    const Real m = horizon_slope(mesh, line, tangent);
    sky += slice_mass(c, n_z, m);
    hemisphere += slice_mass(c, n_z, tangent);
    const Real root = std::sqrt(1 + m * m);
    solid += m > 0 ? 1 / (root * (root + m)) : 1 - m / root;
  }
  // Σ sin h₀ is 0, half a turn apart being of opposite sign.
  return {sky / hemisphere, solid / static_cast<Real>(azimuths)};
}

}  // namespace heightlight
