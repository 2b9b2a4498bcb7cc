#include "screenspace/slice_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "heightlight/error.h"

namespace heightlight {
namespace {

/// How a texel of a given rank turns its slices and shifts its steps in a frame.
struct Turn {
  double slice = 0.25;  ///< f
  double step = 0.5;    ///< u
};

Turn turn_of(DirectionNoise noise, int rank, int frame) {
  if (noise == DirectionNoise::none) return {};
  const double within = noise == DirectionNoise::temporal ? (frame + 0.25) / kFrames : 0.25;
  // rank = 4 ((row + column) mod 4) + column mod 4; the shift of the steps depends on row − column.
  const int column = rank % kNoiseSide;
  const int row = (rank / kNoiseSide - column + kNoiseSide) % kNoiseSide;
  const int shift = (row - column + kNoiseSide) % kNoiseSide;
  const double part = noise == DirectionNoise::temporal ? (frame + 0.5) / kFrames : 0.5;
  return {(rank + within) / kNoiseRanks, (shift + part) / kNoiseSide};
}

double step_share(StepDistribution distribution, int k, int steps, double shift) {
  if (distribution == StepDistribution::uniform) return (k + 1.0) / steps;
  const double share = (k + (distribution == StepDistribution::stratified ? shift : 1.0)) / steps;
  return share * share;
}

int around(int offset, int period) { return (offset % period + period) % period; }

/// The texel nearest to (u, v), in texels from the receiver, but never the receiver itself. Nothing if on an
/// open map no receiver has such a texel.
std::optional<SliceSample> nearest_sample(const DepthBuffer& depth, double u, double v) {
  const double least = std::max(std::fabs(u), std::fabs(v));
  const double scale = least < 1 ? 1 / least : 1;
  const int column = static_cast<int>(std::lround(u * scale));
  const int row = static_cast<int>(std::lround(v * scale));
  const bool leaves = std::abs(column) >= depth.width || std::abs(row) >= depth.height;
  if (depth.boundary == Boundary::open && leaves) return std::nullopt;
  SliceSample sample;
  const double distance = std::hypot(column * depth.spacing.x, row * depth.spacing.y);
  sample.distance = static_cast<float>(distance);
  sample.taps[0] = {around(row, depth.period_rows), around(column, depth.period_columns),
                    static_cast<float>(1 / distance)};
  return sample;
}

/// The surface at (u, v), barycentric on its triangle. Cells are cut from their upper left vertex to their
/// lower right one.
std::optional<SliceSample> mesh_sample(const DepthBuffer& depth, double u, double v, double distance) {
  const double left = std::floor(u);
  const double top = std::floor(v);
  const auto outside = [](double first, int count) { return first < -count || first >= count; };
  const bool leaves = outside(left, depth.width) || outside(top, depth.height);
  if (depth.boundary == Boundary::open && leaves) return std::nullopt;
  const double across = u - left;
  const double down = v - top;
  const bool upper_right = across >= down;
  const int row = static_cast<int>(top);
  const int column = static_cast<int>(left);
  const auto tap = [&](int rows, int columns, double share) {
    return DepthTap{around(row + rows, depth.period_rows), around(column + columns, depth.period_columns),
                    static_cast<float>(share / distance)};
  };
  SliceSample sample;
  sample.distance = static_cast<float>(distance);
  sample.taps[0] = tap(0, 0, 1 - std::max(across, down));
  sample.taps[1] = tap(upper_right ? 0 : 1, upper_right ? 1 : 0, std::fabs(across - down));
  sample.taps[2] = tap(1, 1, std::min(across, down));
  return sample;
}

std::vector<SliceSample> side_samples(const DepthBuffer& depth, const SliceOptions& options, double x,
                                      double y, double shift) {
  const double radius = std::min(options.radius, largest_radius(depth));
  std::vector<SliceSample> samples;
  for (int k = 0; k < options.steps; ++k) {
    const double way = radius * step_share(options.distribution, k, options.steps, shift);
    const double u = way * x / depth.spacing.x;
    const double v = -way * y / depth.spacing.y;  // rows run down, y up
    const std::optional<SliceSample> sample = options.sampling == DepthSampling::nearest
                                                  ? nearest_sample(depth, u, v)
                                                  : mesh_sample(depth, u, v, way);
    if (sample) samples.push_back(*sample);
  }
  return samples;
}

}  // namespace

void check_slice_options(const char* method, const SliceOptions& options) {
  const auto refuse = [method](const std::string& what) {
    throw UsageError(std::string(method) + ": " + what);
  };
  if (options.slices < 1 || options.slices > 4096) refuse("slices must be from 1 to 4096");
  if (options.steps < 1 || options.steps > 65536) refuse("steps must be from 1 to 65536");
  if (!(options.radius > 0)) refuse("the reach must be positive");
}

int frame_count(DirectionNoise noise) { return noise == DirectionNoise::temporal ? kFrames : 1; }

SliceTables make_slice_tables(const DepthBuffer& depth, const SliceOptions& options, int frame) {
  SliceTables tables;
  tables.taps = options.sampling == DepthSampling::mesh ? 3 : 1;
  const int ranks = options.noise == DirectionNoise::none ? 1 : kNoiseRanks;
  for (int rank = 0; rank < ranks; ++rank) {
    const Turn turn = turn_of(options.noise, rank, frame);
    std::vector<Slice>& slices = tables.of.emplace_back();
    for (int s = 0; s < options.slices; ++s) {
      const double azimuth = std::numbers::pi * (s + turn.slice) / options.slices;
      const double x = std::cos(azimuth);
      const double y = std::sin(azimuth);
      Slice slice;
      slice.x = static_cast<float>(x);
      slice.y = static_cast<float>(y);
      slice.sides[0] = side_samples(depth, options, -x, -y, turn.step);
      slice.sides[1] = side_samples(depth, options, x, y, turn.step);
      slices.push_back(std::move(slice));
    }
  }
  return tables;
}

}  // namespace heightlight
