#include "visibility/walk_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "heightlight/error.h"
#include "visibility/surroundings.h"

namespace heightlight {
namespace {

/// A component of a unit vector in the plane. An azimuth along an axis misses the axis by the rounding of π.
double snapped(double component) { return std::fabs(component) < 1e-15 ? 0.0 : component; }

/// The sample at way t on a known line of the mesh: between the sample at (row, column) and the next sample,
/// which is (down, right) from it, at a `share` of the line between them.
NearSample between(double t, double length, int row, int column, int down, int right, double share) {
  const double per_distance = 1 / (t * length);
  NearSample sample;
  sample.way = static_cast<float>(t);
  sample.row[0] = row;
  sample.row[1] = row + down;
  sample.column[0] = column;
  sample.column[1] = column + right;
  sample.per_distance = static_cast<float>(per_distance);
  sample.weight[1] = static_cast<float>(per_distance * share);
  sample.weight[0] = sample.per_distance - sample.weight[1];
  return sample;
}

struct Crossing {
  double t;
  NearSample sample;
};

NearSample at_column(const GridDirection& g, double t, int column) {
  const double v = t * g.v;
  const double row = std::floor(v);
  return between(t, g.length, static_cast<int>(row), column, 1, 0, v - row);
}

NearSample at_row(const GridDirection& g, double t, int row) {
  const double u = t * g.u;
  const double column = std::floor(u);
  return between(t, g.length, row, static_cast<int>(column), 0, 1, u - column);
}

/// The sample on the diagonal on which column − row = i.
NearSample at_diagonal(const GridDirection& g, double t, int i) {
  const double v = t * g.v;
  const double row = std::floor(v);
  return between(t, g.length, static_cast<int>(row), static_cast<int>(row) + i, 1, 1, v - row);
}

/// Adds every `step`-th of the crossings in (from, to] with the lines i = ±1, ±2 … of one family. A texel of
/// way meets `rate` of these lines.
template <class At>
void add_crossings(double rate, double from, double to, int step, std::vector<Crossing>& crossings, At&& at) {
  if (std::fabs(rate) < 1e-9) return;
  const int sign = rate > 0 ? 1 : -1;
  for (int i = static_cast<int>(from * std::fabs(rate)) + 1; i / std::fabs(rate) <= to; i += step) {
    const double t = i / std::fabs(rate);
    if (t > from) crossings.push_back({t, at(t, sign * i)});
  }
}

/// Ways up to which samples are all breakpoints, all crossings with the rows or columns, and every other such
/// crossing; texels.
struct NearWays {
  double exact, dense, last;
};
NearWays near_ways(int samples_per_octave) {
  return {0.5 * samples_per_octave, 1.5 * samples_per_octave, 4.0 * samples_per_octave};
}

std::vector<NearSample> near_samples(const GridDirection& g, const NearWays& ways) {
  const auto [exact, dense, last] = ways;
  std::vector<Crossing> crossings;
  const auto column = [&](double t, int i) { return at_column(g, t, i); };
  const auto row = [&](double t, int i) { return at_row(g, t, i); };
  const auto diagonal = [&](double t, int i) { return at_diagonal(g, t, i); };
  add_crossings(g.u, 0, exact, 1, crossings, column);
  add_crossings(g.v, 0, exact, 1, crossings, row);
  add_crossings(g.u - g.v, 0, exact, 1, crossings, diagonal);
  if (std::fabs(g.u) >= std::fabs(g.v)) {
    add_crossings(g.u, exact, dense, 1, crossings, column);
    add_crossings(g.u, dense, last, 2, crossings, column);
  } else {
    add_crossings(g.v, exact, dense, 1, crossings, row);
    add_crossings(g.v, dense, last, 2, crossings, row);
  }
  std::stable_sort(crossings.begin(), crossings.end(),
                   [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
  std::vector<NearSample> samples;
  for (const Crossing& crossing : crossings) samples.push_back(crossing.sample);
  return samples;
}

std::vector<RingSample> ring_samples(const GridDirection& g, int samples_per_octave, int ring) {
  std::vector<RingSample> samples;
  for (int i = 0; i < samples_per_octave; ++i) {
    const double t = std::ldexp(samples_per_octave + i + 0.5, ring + 1);
    samples.push_back({static_cast<float>(t), static_cast<int>(std::lround(t * g.v)),
                       static_cast<int>(std::lround(t * g.u)), static_cast<float>(1 / (t * g.length))});
  }
  return samples;
}

}  // namespace

double azimuth_rad(const WalkOptions& options, int k) {
  return 2 * std::numbers::pi * (k + 0.25) / options.azimuths;
}

GridDirection grid_direction(const Surface& surface, double azimuth_rad) {
  const double u = snapped(std::cos(azimuth_rad)) / surface.map.spacing.x;
  const double v = -snapped(std::sin(azimuth_rad)) / surface.map.spacing.y;  // rows run down, y up
  const double texels = std::hypot(u, v);
  return {u / texels, v / texels, 1 / texels};
}

void check_azimuths(int azimuths) {
  constexpr int kMostAzimuths = 65536;
  if (azimuths >= 2 && azimuths <= kMostAzimuths && azimuths % 2 == 0) return;
  throw UsageError("azimuths", std::to_string(azimuths),
                   "must be an even number from 2 to " + std::to_string(kMostAzimuths));
}

int near_window_width(const WalkOptions& options) { return kTileSide + 2 + 2 * near_margin(options); }

int near_margin(const WalkOptions& options) { return 4 * options.samples_per_octave + 2; }

int ring_count(const Surface& surface, const WalkOptions& options) {
  constexpr double kLeastSlope = 0.004;
  const double relief = double{surface.highest} - double{surface.lowest};
  const double finest = std::min(surface.map.spacing.x, surface.map.spacing.y);
  const WindowPlace place = place_in_map(surface);
  const double columns = place.map_width;
  const double rows = place.map_height;
  const double farthest = surface.tiles() ? 4 * std::max(columns, rows) : std::hypot(columns, rows);
  int rings = 0;
  for (double t = 4.0 * options.samples_per_octave; t < farthest && relief > kLeastSlope * t * finest; t *= 2)
    ++rings;
  return rings;
}

AzimuthTable make_azimuth_table(const Surface& surface, const WalkOptions& options, double azimuth_rad) {
  const GridDirection g = grid_direction(surface, azimuth_rad);
  AzimuthTable table;
  table.world_x = static_cast<float>(snapped(std::cos(azimuth_rad)));
  table.world_y = static_cast<float>(snapped(std::sin(azimuth_rad)));
  table.along_column = static_cast<float>(g.u * g.length);
  table.along_row = static_cast<float>(g.v * g.length);
  const NearWays ways = near_ways(options.samples_per_octave);
  table.near = near_samples(g, ways);
  while (table.lifted < table.near.size() && table.near[table.lifted].way <= ways.dense) ++table.lifted;
  for (NearSample& sample : table.near) {
    for (int s = 0; s < 2; ++s)
      sample.offset[s] = sample.row[s] * near_window_width(options) + sample.column[s];
  }
  const int rings = ring_count(surface, options);
  for (int ring = 1; ring <= rings; ++ring)
    table.rings.push_back(ring_samples(g, options.samples_per_octave, ring));
  return table;
}

}  // namespace heightlight
