#include "transport/light_mips.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/parallel.h"
#include "surface/blocks.h"

namespace heightlight {
namespace {

int half(int count) { return (count + 1) / 2; }

float steepness(const Surface& surface, std::size_t texel) {
  const float n_z = surface.normal.values[texel].z;
  if (std::isnan(n_z)) return 0;
  return std::sqrt(std::max(0.0F, 1 / (n_z * n_z) - 1)) + kFlatShare;
}

/// Calls visit(row, column) for the up to four children of a block.
template <class Visit>
void for_children(int row, int column, int child_rows, int child_columns, Visit&& visit) {
  for (int i = 2 * row; i < std::min(2 * row + 2, child_rows); ++i) {
    for (int j = 2 * column; j < std::min(2 * column + 2, child_columns); ++j) visit(i, j);
  }
}

/// Weights of siblings in whole steps, the largest 255; none that counts becomes 0. Returns the sums.
Image<float> weigh_siblings(const Image<float>& steepness, Image<std::uint8_t>& weights) {
  Image<float> sums(half(steepness.width), half(steepness.height));
  weights = Image<std::uint8_t>(steepness.width, steepness.height);
  parallel_for(sums.height, [&](std::int64_t line) {
    const int row = static_cast<int>(line);
    for (int column = 0; column < sums.width; ++column) {
      float sum = 0;
      float most = 0;
      for_children(row, column, steepness.height, steepness.width, [&](int i, int j) {
        sum += steepness(i, j);
        most = std::max(most, steepness(i, j));
      });
      sums(row, column) = sum;
      if (most == 0) continue;
      for_children(row, column, steepness.height, steepness.width, [&](int i, int j) {
        if (steepness(i, j) == 0) return;
        weights(i, j) = static_cast<std::uint8_t>(std::max(1L, std::lround(255 * steepness(i, j) / most)));
      });
    }
  });
  return sums;
}

/// Levels above the finest, up to that at which a block spans the farthest that walks look.
int level_count(int width, int height) {
  return std::bit_width(static_cast<unsigned>(std::max(width, height))) + 1;
}

}  // namespace

std::uint64_t light_mips_bytes(int width, int height) {
  std::uint64_t bytes = 0;
  for (int l = 0; l <= level_count(width, height); ++l) {
    const LightLevel level{.width = width, .height = height, .values = {}};
    const auto rows = static_cast<std::uint64_t>(height + 2 * LightLevel::kRowMargin);
    bytes += static_cast<std::uint64_t>(level.stride()) * rows * sizeof(float);
    bytes += static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);  // weights
    width = half(width);
    height = half(height);
  }
  return bytes;
}

LightMips::LightMips(const Surface& surface) : surface_(surface), has_holes_(count_missing(surface.map) > 0) {
  const int levels = level_count(surface.width(), surface.height());
  Image<float> steep(surface.width(), surface.height());
  parallel_for(surface.height(), [&](std::int64_t row) {
    for (int column = 0; column < surface.width(); ++column) {
      const std::size_t texel = steep.index(static_cast<int>(row), column);
      steep.values[texel] = steepness(surface, texel);
    }
  });
  for (int l = 0; l <= levels; ++l) {
    LightLevel level;
    level.width = steep.width;
    level.height = steep.height;
    level.values.assign(static_cast<std::size_t>(level.stride()) *
                            static_cast<std::size_t>(level.height + 2 * LightLevel::kRowMargin),
                        0);
    levels_.push_back(std::move(level));
    weights_.emplace_back();
    steep = weigh_siblings(steep, weights_.back());
  }
}

void LightMips::fill(const TexelVector& values) {
  LightLevel& finest = levels_[0];
  parallel_for(finest.height, [&](std::int64_t row) {
    const double* from = values.data() + row * finest.width;
    std::transform(from, from + finest.width, finest.origin() + row * finest.stride(),
                   [](double value) { return static_cast<float>(value); });
  });
  for (std::size_t l = 1; l < levels_.size(); ++l) {
    const LightLevel& fine = levels_[l - 1];
    const Image<std::uint8_t>& weights = weights_[l - 1];
    LightLevel& coarse = levels_[l];
    parallel_for(coarse.height, [&](std::int64_t line) {
      const int row = static_cast<int>(line);
      float* out = coarse.origin() + std::ptrdiff_t{row} * coarse.stride();
      for (int column = 0; column < coarse.width; ++column) {
        float sum = 0;
        float weight = 0;
        for_children(row, column, fine.height, fine.width, [&](int i, int j) {
          const float w = weights(i, j);
          sum += w > 0 ? w * fine.origin()[std::ptrdiff_t{i} * fine.stride() + j] : 0;
          weight += w;
        });
        out[column] = weight > 0 ? sum / weight : 0;
      }
    });
  }
  for (int l = static_cast<int>(levels_.size()) - 1; l >= 0; --l) {
    if (has_holes_) fill_holes(l);
    fill_margins(l);
  }
}

void LightMips::fill_holes(int l) {
  if (l + 1 >= static_cast<int>(levels_.size())) return;
  LightLevel& fine = levels_[static_cast<std::size_t>(l)];
  const LightLevel& coarse = levels_[static_cast<std::size_t>(l) + 1];
  const Image<std::uint8_t>& weights = weights_[static_cast<std::size_t>(l)];
  parallel_for(fine.height, [&](std::int64_t row) {
    float* line = fine.origin() + row * fine.stride();
    const float* parents = coarse.origin() + row / 2 * coarse.stride();
    for (int column = 0; column < fine.width; ++column) {
      if (weights(static_cast<int>(row), column) == 0) line[column] = parents[column / 2];
    }
  });
}

void LightMips::fill_margins(int l) {
  LightLevel& level = levels_[static_cast<std::size_t>(l)];
  const bool tiles = surface_.tiles();
  const auto source = [&](int first, int count, int samples) {
    std::vector<int> blocks = block_sources(first, count, l, samples, tiles);
    for (int i = 0; i < count; ++i) {
      int& block = blocks[static_cast<std::size_t>(i)];
      if (block < 0) block = first + i < 0 ? 0 : (samples - 1) >> l;
    }
    return blocks;
  };
  const std::vector<int> columns = source(-LightLevel::kMargin, level.stride(), surface_.width());
  const std::vector<int> rows =
      source(-LightLevel::kRowMargin, level.height + 2 * LightLevel::kRowMargin, surface_.height());
  float* origin = level.origin();
  const std::ptrdiff_t stride = level.stride();
  for (int row = 0; row < level.height; ++row) {
    float* line = origin + row * stride;
    for (int column = -LightLevel::kMargin; column < 0; ++column) {
      line[column] = line[columns[static_cast<std::size_t>(column + LightLevel::kMargin)]];
    }
    for (int column = level.width; column < level.width + LightLevel::kMargin; ++column) {
      line[column] = line[columns[static_cast<std::size_t>(column + LightLevel::kMargin)]];
    }
  }
  for (int row = -LightLevel::kRowMargin; row < level.height + LightLevel::kRowMargin; ++row) {
    if (row >= 0 && row < level.height) continue;
    const float* from = origin + rows[static_cast<std::size_t>(row + LightLevel::kRowMargin)] * stride;
    std::copy_n(from - LightLevel::kMargin, stride, origin + row * stride - LightLevel::kMargin);
  }
}

std::uint64_t LightMips::bytes() const {
  std::uint64_t bytes = 0;
  for (const LightLevel& level : levels_) bytes += level.values.size() * sizeof(float);
  for (const Image<std::uint8_t>& weights : weights_) bytes += weights.size();
  return bytes;
}

}  // namespace heightlight
