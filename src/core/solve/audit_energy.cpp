#include <algorithm>
#include <array>
#include <cmath>

#include "solve/solver.h"

namespace heightlight {

// A texel of the map has the area 1/n_z of its place on the map, less at its borders, and radiosity ρ E. Of
// what it sends the share A goes to the sky, as by reciprocity A is also the share of what it would receive
// from an even sky. Hence
//     Σ E₀/n_z = Σ (1 − ρ) E/n_z + Σ A ρ E/n_z.

namespace {

/// Of a system's texels.
struct TexelTerms {
  double area = 0;
  double albedo = 0;
  double sky = 0;     ///< A
  double direct = 0;  ///< E₀/π
};

/// Share of the six triangles around a sample that are there: those at a border or beside a hole stand for
/// less of the surface. Cells are cut from (row, column) to (row + 1, column + 1).
double share_of_triangles(const Surface& surface, int row, int column) {
  const Image<float>& height = surface.map.height;
  const auto is_there = [&](int down, int across) {
    int i = row + down;
    int j = column + across;
    if (surface.tiles()) {
      i = (i + height.height) % height.height;
      j = (j + height.width) % height.width;
    }
    return i >= 0 && j >= 0 && i < height.height && j < height.width && !std::isnan(height(i, j));
  };
  // The samples around, in the order in which neighbours share a triangle with this one.
  constexpr std::array<std::array<int, 2>, 6> kAround{{{-1, -1}, {-1, 0}, {0, 1}, {1, 1}, {1, 0}, {0, -1}}};
  int triangles = 0;
  for (std::size_t k = 0; k < kAround.size(); ++k) {
    const auto& next = kAround[(k + 1) % kAround.size()];
    if (is_there(kAround[k][0], kAround[k][1]) && is_there(next[0], next[1])) ++triangles;
  }
  return triangles / 6.0;
}

/// Calls visit(texel, terms) for every texel with a sample.
template <class Visit>
void for_terms(const Surface& surface, const Transport& transport, const IrradianceSystem& system,
               Visit&& visit) {
  const TexelVector& direct = system.direct ? *system.direct : transport.direct;
  for (int row = 0; row < surface.height(); ++row) {
    for (int column = 0; column < surface.width(); ++column) {
      const std::size_t i = surface.map.height.index(row, column);
      if (std::isnan(surface.map.height.values[i])) continue;
      visit(i,
            TexelTerms{.area = share_of_triangles(surface, row, column) / double{surface.normal.values[i].z},
                       .albedo = system.varying ? (*system.varying)[i] : system.albedo,
                       .sky = transport.direct[i],
                       .direct = direct[i]});
    }
  }
}

}  // namespace

EnergyAudit audit_energy(const Surface& surface, const Transport& transport, const IrradianceSystem& system,
                         const TexelVector& total) {
  double area = 0;
  double received = 0;
  double absorbed = 0;
  double escaped = 0;
  for_terms(surface, transport, system, [&](std::size_t i, const TexelTerms& terms) {
    area += terms.area;
    received += terms.area * terms.direct;
    absorbed += terms.area * (1 - terms.albedo) * total[i];
    escaped += terms.area * terms.albedo * terms.sky * total[i];
  });
  if (!(received > 0)) return {};
  return {.received = received / area,
          .absorbed = absorbed / received,
          .escaped = escaped / received,
          .imbalance = 1 - (absorbed + escaped) / received};
}

// With E = E₀ + R, R what bounces bring, the balance fixes one factor of R.
void balance_energy(const Surface& surface, const Transport& transport, const IrradianceSystem& system,
                    double most_change, TexelVector& total) {
  double brightest = 0;
  double left = 0;       // of what is received, when the direct irradiance is absorbed or gone
  double reflected = 0;  // absorbed or gone of R
  double squares = 0;
  std::size_t count = 0;
  for_terms(surface, transport, system, [&](std::size_t i, const TexelTerms& terms) {
    const double ends = (1 - terms.albedo) + terms.albedo * terms.sky;
    const double bounced = total[i] - terms.direct;
    brightest = std::max(brightest, terms.direct);
    left += terms.area * (1 - ends) * terms.direct;
    reflected += terms.area * ends * bounced;
    squares += bounced * bounced;
    ++count;
  });
  if (!(reflected > 0)) return;
  const double factor = left / reflected;
  const double change = std::fabs(factor - 1) * std::sqrt(squares / static_cast<double>(count));
  if (!(change <= most_change * brightest)) return;
  for_terms(surface, transport, system, [&](std::size_t i, const TexelTerms& terms) {
    total[i] = terms.direct + factor * (total[i] - terms.direct);
  });
}

}  // namespace heightlight
