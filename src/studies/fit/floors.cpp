#include "fit/floors.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/parallel.h"
#include "heightlight/closed_forms.h"

namespace heightlight {
namespace {

constexpr std::size_t kFine = 256;
constexpr std::size_t kSide = 128;

struct Cell {
  double texels = 0;
  double weight = 0;
  std::vector<double> sums;  ///< per albedo
  std::vector<double> squares;
};

/// Which cell a texel of a map falls into; and a function of the same inputs that takes most of the slope out
/// of the cells, whose width would count as spread otherwise.
using CellOf = std::function<std::size_t(const TexelSample&, std::size_t texel, std::size_t map)>;
using Trend = double (*)(const TexelSample&, std::size_t texel, double albedo);

double trend_of_alpha(const TexelSample& texels, std::size_t i, double albedo) {
  return notes_total_guarded(AmbientOcclusion(double{texels.ambient_occlusion[i]}), albedo);
}

double trend_of_sky(const TexelSample& texels, std::size_t i, double albedo) {
  const SkyViewFactor sky(double{texels.sky_view_factor[i]});
  return bounced_total(sky, guess_seen(sky), albedo);
}

std::size_t place(float share, std::size_t cells) {
  return std::min(cells - 1, static_cast<std::size_t>(clamp_share(share) * static_cast<float>(cells)));
}

/// Spread of the totals inside cells, which Bessel's correction frees of the cells' own means.
std::vector<double> spread_inside(const std::vector<JudgedMap>& maps, std::size_t cell_count,
                                  const CellOf& cell_of, Trend trend) {
  const std::size_t albedos = judged_albedos().size();
  std::vector<Cell> cells(cell_count);
  for (std::size_t m = 0; m < maps.size(); ++m) {
    if (!maps[m].texels) continue;
    const TexelSample& texels = *maps[m].texels;
    const double weight = 1 / static_cast<double>(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
      Cell& cell = cells[cell_of(texels, i, m)];
      cell.sums.resize(albedos);
      cell.squares.resize(albedos);
      cell.texels += 1;
      cell.weight += weight;
      for (std::size_t k = 0; k < albedos; ++k) {
        const double total = double{texels.totals[k][i]} - trend(texels, i, judged_albedos()[k]);
        cell.sums[k] += weight * total;
        cell.squares[k] += weight * total * total;
      }
    }
  }
  std::vector<double> rms(albedos);
  for (std::size_t k = 0; k < albedos; ++k) {
    double squares = 0;
    double weight = 0;
    for (const Cell& cell : cells) {
      if (cell.texels < 2) continue;
      const double inside = std::max(0.0, cell.squares[k] - cell.sums[k] * cell.sums[k] / cell.weight);
      squares += inside * cell.texels / (cell.texels - 1);
      weight += cell.weight;
    }
    rms[k] = weight > 0 ? std::sqrt(squares / weight) : 0;
  }
  return rms;
}

}  // namespace

std::vector<Floor> find_floors(const std::vector<JudgedMap>& maps) {
  const bool has_texels =
      std::any_of(maps.begin(), maps.end(), [](const JudgedMap& map) { return map.texels.has_value(); });
  if (!has_texels) return {};
  struct Inputs {
    const char* name;
    std::size_t cells;
    Trend trend;
    CellOf cell_of;
  };
  const std::vector<Inputs> all = {
      {"alpha", kFine, trend_of_alpha,
       [](const TexelSample& t, std::size_t i, std::size_t) { return place(t.ambient_occlusion[i], kFine); }},
      {"A", kFine, trend_of_sky,
       [](const TexelSample& t, std::size_t i, std::size_t) { return place(t.sky_view_factor[i], kFine); }},
      {"alpha+A", kSide * kSide, trend_of_sky,
       [](const TexelSample& t, std::size_t i, std::size_t) {
         return place(t.ambient_occlusion[i], kSide) * kSide + place(t.sky_view_factor[i], kSide);
       }},
      {"A+map", kFine * maps.size(), trend_of_sky,
       [](const TexelSample& t, std::size_t i, std::size_t map) {
         return map * kFine + place(t.sky_view_factor[i], kFine);
       }},
      {"A+blur", kSide * kSide, trend_of_sky,
       [](const TexelSample& t, std::size_t i, std::size_t) {
         return place(t.sky_view_factor[i], kSide) * kSide + place(t.blurred[i], kSide);
       }},
  };
  std::vector<Floor> floors(all.size());
  parallel_for(static_cast<std::int64_t>(all.size()), [&](std::int64_t i) {
    const Inputs& inputs = all[static_cast<std::size_t>(i)];
    floors[static_cast<std::size_t>(i)] = {inputs.name,
                                           spread_inside(maps, inputs.cells, inputs.cell_of, inputs.trend)};
  });
  return floors;
}

}  // namespace heightlight
