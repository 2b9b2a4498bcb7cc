// Rank correlation (Spearman's) of baked ambient occlusion with the AO maps that came with real materials.
// The makers of these maps do not state the relief, the radius or the gamma. Hence the relief is searched
// for, without a radius and with several, and only the order of values is compared. The difference is also
// given by octaves: means over larger and larger squares, after our values have been replaced by theirs of
// equal rank.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "bake/material.h"
#include "files/image_file.h"
#include "files/image_read.h"
#include "heightlight/error.h"
#include "plot/previews.h"

namespace heightlight {
namespace {

/// Ranks of values; equal values get their mean rank.
std::vector<double> ranks_of(const std::vector<float>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    const double rank = 0.5 * static_cast<double>(begin + end - 1);
    for (std::size_t i = begin; i < end; ++i) ranks[order[i]] = rank;
    begin = end;
  }
  return ranks;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double ab = 0;
  double aa = 0;
  double bb = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - mean_a) * (b[i] - mean_b);
    aa += (a[i] - mean_a) * (a[i] - mean_a);
    bb += (b[i] - mean_b) * (b[i] - mean_b);
  }
  return ab / std::sqrt(aa * bb);
}

std::vector<float> first_channel(const StoredImage& image) {
  return std::visit(
      [&](const auto& samples) {
        std::vector<float> values;
        for (std::size_t i = 0; i < samples.size(); i += image.channels.size()) {
          values.push_back(static_cast<float>(samples[i]));
        }
        return values;
      },
      image.samples);
}

struct ShippedMaterial {
  const char* name;
  const char* heights;
  const char* occlusion;
};

constexpr ShippedMaterial kMaterials[] = {
    {"DiamondPlate008C", "DiamondPlate008C_height16.png", "DiamondPlate008C_ao.png"},
    {"Ground054", "Ground054_height16.png", "Ground054_ao.png"},
    {"Bricks102", "Bricks102_height.jpg", "Bricks102_ao.jpg"}};

struct Search {
  const Heightmap& unit;  ///< relief 1
  std::vector<double> shipped;
  double error;

  Map bake(double relief, const std::optional<MaximumDistance>& radius) const {
    Heightmap map = unit;
    for (float& height : map.height.values) height *= static_cast<float>(relief);
    const Surface surface = build_surface(std::move(map));
    BakeOptions options;
    options.maps = {MaterialMap::ao};
    options.error = error;
    options.maximum_distance = radius;
    return find_material(surface, options).results.sky_view_factor;
  }
  double score(double relief, const std::optional<MaximumDistance>& radius) const {
    return correlation(ranks_of(bake(relief, radius).values), shipped);
  }
};

/// The best relief: from a coarse geometric series, then with smaller and smaller steps around its best
/// value.
double best_relief(const Search& search, const std::optional<MaximumDistance>& radius, double& score) {
  double best = 0.01;
  score = -1;
  const auto attempt = [&](double relief) {
    const double found = search.score(relief, radius);
    if (found <= score) return;
    score = found;
    best = relief;
  };
  for (double relief = 0.005; relief < 0.7; relief *= 2) attempt(relief);
  for (double step = std::sqrt(2.0); step > 1.1; step = std::sqrt(step)) {
    const double middle = best;
    attempt(middle * step);
    attempt(middle / step);
  }
  return best;
}

/// `ours` with its values replaced by the values of `theirs` of equal rank.
Map match_values(const Map& ours, const std::vector<float>& theirs) {
  std::vector<std::size_t> order(theirs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return ours.values[a] < ours.values[b]; });
  std::vector<float> values = theirs;
  std::sort(values.begin(), values.end());
  Map matched = ours;
  for (std::size_t i = 0; i < order.size(); ++i) matched.values[order[i]] = values[i];
  return matched;
}

/// Means of 2 × 2 texels.
Map halve(const Map& map) {
  Map half(map.width / 2, map.height / 2);
  for (int row = 0; row < half.height; ++row) {
    for (int column = 0; column < half.width; ++column) {
      half(row, column) = 0.25F * (map(2 * row, 2 * column) + map(2 * row, 2 * column + 1) +
                                   map(2 * row + 1, 2 * column) + map(2 * row + 1, 2 * column + 1));
    }
  }
  return half;
}

/// The detail of a map that its halved version lacks.
std::vector<double> detail_beyond(const Map& half, const Map& map) {
  std::vector<double> detail;
  for (int row = 0; row < 2 * half.height; ++row) {
    for (int column = 0; column < 2 * half.width; ++column) {
      detail.push_back(double{map(row, column)} - double{half(row / 2, column / 2)});
    }
  }
  return detail;
}

double root_mean_square(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) /
                   static_cast<double>(values.size()));
}

void compare_octaves(const char* name, const Map& ours, Map theirs, std::FILE* table) {
  Map matched = match_values(ours, theirs.values);
  for (int texels = 1; texels <= 64; texels *= 2) {
    const Map half = halve(matched);
    const Map their_half = halve(theirs);
    const std::vector<double> a = detail_beyond(half, matched);
    const std::vector<double> b = detail_beyond(their_half, theirs);
    std::fprintf(table, "%s,%d,%.4f,%.5f,%.5f\n", name, texels, correlation(a, b), root_mean_square(a),
                 root_mean_square(b));
    matched = half;
    theirs = their_half;
  }
}

struct Options {
  double error = 0.01;
  std::string pictures;
  std::string octaves;
};

void judge(const std::filesystem::path& folder, const ShippedMaterial& material, const Options& options,
           std::FILE* octaves) {
  const std::filesystem::path heights = folder / material.heights;
  if (!std::filesystem::exists(heights)) {
    std::printf("%-17s is absent\n", material.name);
    return;
  }
  constexpr std::uint64_t kMemory = std::uint64_t{1} << 32;
  LoadOptions load;
  load.relief = 1;
  const Heightmap unit = load_heightmap(heights, load, kMemory).map;
  const std::filesystem::path path = folder / material.occlusion;
  const StoredImage image = read_image(path, recognise_format(path), kMemory);
  if (image.width != unit.height.width || image.height != unit.height.height) {
    throw Error(path.string() + ": not of its heightmap's size");
  }
  const std::vector<float> shipped = first_channel(image);
  Map theirs(unit.height.width, unit.height.height);
  const float largest = *std::max_element(shipped.begin(), shipped.end());
  std::transform(shipped.begin(), shipped.end(), theirs.values.begin(), [=](float v) { return v / largest; });
  const Search search{unit, ranks_of(shipped), options.error};
  for (const double share : {0.0, 0.1, 0.02}) {
    const std::optional<MaximumDistance> radius =
        share > 0 ? std::optional<MaximumDistance>{{.distance = share, .falloff = Falloff::linear}}
                  : std::nullopt;
    double score = 0;
    const double relief = best_relief(search, radius, score);
    std::printf("%-17s %-10s %8.4f %8.3f\n", material.name,
                share > 0 ? (share == 0.1 ? "10 %" : "2 %") : "unlimited", relief, score);
    std::fflush(stdout);
    if (options.pictures.empty() && !(octaves && share == 0)) continue;
    const Map ours = search.bake(relief, radius);
    if (octaves && share == 0) compare_octaves(material.name, ours, theirs, octaves);
    if (options.pictures.empty()) continue;
    const std::filesystem::path stem = std::filesystem::path(options.pictures) / material.name;
    write_png(stem.string() + "_shipped.png", grey_picture(theirs));
    write_png(stem.string() + (share > 0 ? share == 0.1 ? "_10.png" : "_2.png" : "_unlimited.png"),
              grey_picture(ours));
  }
}

}  // namespace
}  // namespace heightlight

int main(int argument_count, char** arguments) {
  try {
    heightlight::Options options;
    CLI::App app(
        "Rank correlation with the AO maps that came with materials; the head of the source says more");
    app.add_option("--error", options.error, "RMSE of the baked maps (0.01)");
    app.add_option("--pictures", options.pictures, "folder for previews of both");
    app.add_option("--octaves", options.octaves,
                   "table of the correlation by octave, for plots/make-shipped-ao");
    CLI11_PARSE(app, argument_count, arguments);
    std::FILE* octaves = options.octaves.empty() ? nullptr : std::fopen(options.octaves.c_str(), "w");
    if (!options.octaves.empty() && !octaves)
      throw heightlight::Error(options.octaves + ": cannot be written");
    if (octaves) std::fprintf(octaves, "material,texels,correlation,rms_baked,rms_shipped\n");
    std::printf("%-17s %-10s %8s %8s\n", "material", "reach", "relief", "rank corr.");
    const std::filesystem::path folder = std::filesystem::path(HEIGHTLIGHT_SHARED_DIR) / "data/material";
    for (const heightlight::ShippedMaterial& material : heightlight::kMaterials) {
      heightlight::judge(folder, material, options, octaves);
    }
    if (octaves && std::fclose(octaves) != 0)
      throw heightlight::Error(options.octaves + ": not written whole");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heightlight_shipped_ao_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
