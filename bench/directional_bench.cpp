// Irradiance under skies that are not even, from the maps that `bake` makes, against exact visibility: as
// figure 12 of file 000 does for its methods. Receivers are picked by a hash; maps are found at bake's
// default error.
//
//   sh                the dot product of the baked harmonics with the sky's
//   bent cone         zonal harmonics of a cone about the bent normal (file 000, eqs. 17, 22, 23)
//   bent cone, spread the same, its half-angle from the spread of directions
//   bent normal × AO  the unoccluded irradiance toward the bent normal, times A
//   AO                that toward the normal, times A
//
// The last four read the sky as harmonics of order 2, as shaders do.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "bake/bent_cone.h"
#include "bake/material.h"
#include "base/gauss_legendre.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "base/texel_algebra.h"
#include "bench_map.h"
#include "heightlight/error.h"
#include "visibility/exact_walk.h"
#include "visibility/sky_harmonics.h"
#include "visibility/slice_integrals.h"

namespace heightlight {
namespace {

constexpr double kPi = std::numbers::pi;
using Colour = Eigen::Array3d;

/// Radiance by direction, and its harmonics.
struct Sky {
  std::string name;
  std::function<Colour(const Eigen::Vector3d&)> radiance;
  std::array<Harmonics, 3> harmonics{};
};

/// ∫ L Y_lm dω over the sphere.
void project(Sky& sky) {
  constexpr int kAzimuths = 256;
  for (const QuadratureNode& node : gauss_legendre(128)) {
    const double z = 2 * node.at - 1;
    const double r = std::sqrt(1 - z * z);
    for (int k = 0; k < kAzimuths; ++k) {
      const double azimuth = 2 * kPi * (k + 0.5) / kAzimuths;
      const Eigen::Vector3d direction(r * std::cos(azimuth), r * std::sin(azimuth), z);
      const Harmonics y = harmonics_of(direction);
      const Colour weighted = 2 * node.weight * 2 * kPi / kAzimuths * sky.radiance(direction);
      for (std::size_t c = 0; c < 3; ++c) {
        for (std::size_t i = 0; i < 9; ++i)
          sky.harmonics[c][i] += weighted[static_cast<Eigen::Index>(c)] * y[i];
      }
    }
  }
}

/// Of order 2: an overcast zenith, and a warm side.
Colour second_order(const Eigen::Vector3d& d) {
  const double side = d.dot(Eigen::Vector3d(0.8, 0.36, 0.48));
  const double up = d.z();
  return Colour(0.25, 0.3, 0.4) * (1 + up + up * up) + Colour(0.9, 0.5, 0.2) * 0.25 * (1 + side) * (1 + side);
}

/// A coloured gradient from horizon to zenith with a low sun's glow, of every order.
Colour gradient(const Eigen::Vector3d& d) {
  const double up = std::sqrt(std::max(0.0, d.z()));
  const double glow = std::exp(6 * (d.dot(Eigen::Vector3d(0.8, 0.36, 0.48).normalized()) - 1));
  return Colour(0.9, 0.75, 0.55) * (1 - up) + Colour(0.15, 0.35, 0.85) * up + Colour(3, 1.6, 0.6) * glow;
}

std::vector<Sky> make_skies() {
  std::vector<Sky> skies{{"order 2", second_order, {}}, {"gradient", gradient, {}}};
  for (Sky& sky : skies) project(sky);
  return skies;
}

/// (1/π) ∫ V L cosθ dω, by Gauss's rule above the exact horizons.
std::vector<Colour> look_exactly(const ExactWalker& walker, int row, int column,
                                 const std::vector<Sky>& skies) {
  static const std::vector<QuadratureNode> kNodes = gauss_legendre(24);
  const Eigen::Vector3d normal = as_eigen(walker.surface().normal(row, column)).cast<double>().normalized();
  SliceView view;
  walker.view(row, column, view);
  std::vector<Colour> seen(skies.size(), Colour::Zero());
  double mass = 0;
  for (int k = 0; k < walker.azimuths(); ++k) {
    const double azimuth = walker.azimuth_rad(k);
    const Eigen::Vector2d along(std::cos(azimuth), std::sin(azimuth));
    const SliceNormal in_slice{normal.head<2>().dot(along), normal.z()};
    const double tangent = std::atan(tangent_slope(in_slice));
    mass += cosine_mass(in_slice, elevation_of_slope(tangent_slope(in_slice)), {});
    const double lowest = std::max(tangent, view.horizon_rad[static_cast<std::size_t>(k)]);
    const double span = kPi / 2 - lowest;
    for (const QuadratureNode& node : kNodes) {
      const double elevation = lowest + node.at * span;
      const double cosine = std::cos(elevation);
      const Eigen::Vector3d d(along.x() * cosine, along.y() * cosine, std::sin(elevation));
      const double weight = node.weight * span * normal.dot(d) * cosine;
      for (std::size_t s = 0; s < skies.size(); ++s) seen[s] += weight * skies[s].radiance(d);
    }
  }
  for (Colour& colour : seen) colour /= mass;
  return seen;
}

/// Σ f_lm L_lm per colour.
Colour look(const Sky& sky, const Harmonics& f) {
  return {dot(f, sky.harmonics[0]), dot(f, sky.harmonics[1]), dot(f, sky.harmonics[2])};
}

/// Zonal coefficients z_l turned toward an axis (file 000 eq. 17), over π.
Harmonics turn_zonal(const std::array<double, 3>& zonal, const Eigen::Vector3d& axis) {
  Harmonics f = harmonics_of(axis);
  for (std::size_t i = 0; i < 9; ++i) {
    const std::size_t l = i == 0 ? 0 : i < 4 ? 1 : 2;
    f[i] *= std::sqrt(4 * kPi / (2.0 * static_cast<double>(l) + 1)) * zonal[l] / kPi;
  }
  return f;
}

/// Of a cone of half-angle β, cosine weighted about its axis (eq. 23).
std::array<double, 3> cone(double half_angle) {
  const double c = std::cos(half_angle);
  const double s = std::sin(half_angle);
  return {std::sqrt(kPi) / 2 * s * s, std::sqrt(3 * kPi) / 3 * (1 - c * c * c),
          std::sqrt(5 * kPi) / 16 * s * s * (2 + 6 * c * c)};
}

const std::vector<std::string> kMethods{"sh", "bent cone", "bent cone, spread", "bent normal x AO", "AO"};

/// E/π of one receiver by every method.
std::vector<Colour> shade(const Material& material, std::size_t texel, const Sky& sky) {
  const Results& found = material.results;
  const auto share = static_cast<double>(found.sky_view_factor.values[texel]);
  const Vector3& stored = found.moments.first.values[texel];
  const Eigen::Vector3d first = as_eigen(stored).cast<double>();
  std::array<double, 5> second{};
  for (std::size_t k = 0; k < 5; ++k) {
    second[k] = static_cast<double>(found.moments.second.values[texel][k]);
  }
  const Eigen::Vector3d normal = as_eigen(material.surface->normal.values[texel]).cast<double>().normalized();
  const Eigen::Vector3d bent = first.norm() > 0 ? Eigen::Vector3d(first.normalized()) : normal;
  return {look(sky, harmonics_of_moments(share, first, second)),
          look(sky, turn_zonal(cone(cone_of_openness(share)), bent)),
          look(sky, turn_zonal(cone(cone_of_spread(share, stored)), bent)),
          share * look(sky, turn_zonal(cone(kPi / 2), bent)),
          share * look(sky, turn_zonal(cone(kPi / 2), normal))};
}

/// Of one method on one map under one sky, over receivers and colours.
struct Score {
  double squares = 0;
  double relative_squares = 0;
  double sum = 0;
  double truth = 0;
};

struct Options {
  std::vector<std::string> maps{"brick", "fbm", "ground054"};
  int size = 512;
  int receivers = 2048;
  int azimuths = 256;
  std::string csv;
};

void judge(const Options& options, const std::string& map_name, const std::vector<Sky>& skies,
           std::FILE* csv) {
  const auto map = make_bench_map(map_name, options.size);
  if (!map) {
    std::printf("%s is absent\n", map_name.c_str());
    return;
  }
  Heightmap tile = *map;
  tile.boundary = Boundary::tile;
  const Surface surface = build_surface(std::move(tile));
  BakeOptions bake;
  bake.maps = {MaterialMap::sh};
  const Material material = find_material(surface, bake);
  const ExactWalker walker(surface, options.azimuths);
  std::vector<std::vector<Score>> scores(static_cast<std::size_t>(options.receivers));
  parallel_for(options.receivers, [&](std::int64_t i) {
    const std::size_t texel = scramble(static_cast<std::uint64_t>(i)) % surface.map.height.size();
    const int row = static_cast<int>(texel) / surface.width();
    const int column = static_cast<int>(texel) % surface.width();
    const std::vector<Colour> truth = look_exactly(walker, row, column, skies);
    std::vector<Score>& own = scores[static_cast<std::size_t>(i)];
    for (std::size_t s = 0; s < skies.size(); ++s) {
      for (const Colour& found : shade(material, texel, skies[s])) {
        const Colour error = found - truth[s];
        own.push_back({error.square().mean(), (error / truth[s].max(1e-3)).square().mean(), error.mean(),
                       truth[s].mean()});
      }
    }
  });
  for (std::size_t s = 0; s < skies.size(); ++s) {
    for (std::size_t m = 0; m < kMethods.size(); ++m) {
      Score sum;
      for (const std::vector<Score>& receiver : scores) {
        const Score& score = receiver[s * kMethods.size() + m];
        sum.squares += score.squares;
        sum.relative_squares += score.relative_squares;
        sum.sum += score.sum;
        sum.truth += score.truth;
      }
      const double n = options.receivers;
      const double mean = sum.truth / n;
      const double rmse = std::sqrt(sum.squares / n) / mean;
      std::printf("%-10s %-9s %-18s %9.4f %9.5f %9.4f\n", map_name.c_str(), skies[s].name.c_str(),
                  kMethods[m].c_str(), 100 * rmse, sum.relative_squares / n, 100 * sum.sum / n / mean);
      if (csv) {
        std::fprintf(csv, "%s,%s,\"%s\",%.6g,%.6g,%.6g\n", map_name.c_str(), skies[s].name.c_str(),
                     kMethods[m].c_str(), 100 * rmse, sum.relative_squares / n, 100 * sum.sum / n / mean);
      }
    }
  }
}

void run(const Options& options) {
  std::FILE* csv = options.csv.empty() ? nullptr : std::fopen(options.csv.c_str(), "w");
  if (!options.csv.empty() && !csv) throw Error(options.csv + ": cannot be written");
  if (csv) std::fputs("map,sky,method,rmse_percent_of_mean,mrse,bias_percent_of_mean\n", csv);
  std::printf(
      "%d receivers, exact horizons along %d azimuths, maps of %d x %d\n%-10s %-9s %-18s %9s %9s %9s\n",
      options.receivers, options.azimuths, options.size, options.size, "map", "sky", "method", "RMSE %",
      "MRSE", "bias %");
  const std::vector<Sky> skies = make_skies();
  for (const std::string& map : options.maps) judge(options, map, skies, csv);
  if (csv && std::fclose(csv) != 0) throw Error(options.csv + ": could not be written");
}

}  // namespace
}  // namespace heightlight

int main(int argument_count, char** arguments) {
  try {
    heightlight::Options options;
    CLI::App app("Irradiance under uneven skies from baked maps; the head of the source says more");
    app.add_option("--maps", options.maps, "brick, fbm, ground054")->delimiter(',');
    app.add_option("--size", options.size, "texels along an edge (512)")->check(CLI::Range(64, 4096));
    app.add_option("--receivers", options.receivers, "texels to judge by (2048)")->check(CLI::PositiveNumber);
    app.add_option("--azimuths", options.azimuths, "of the exact horizons (256)")->check(CLI::Range(8, 4096));
    app.add_option("--csv", options.csv, "file for the table");
    CLI11_PARSE(app, argument_count, arguments);
    heightlight::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heightlight_directional_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
