#include "stability/hard_maps.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "test_maps.h"

namespace heightlight {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

template <class Function>
void add_both(std::vector<HardMap>& maps, const std::string& name, int width, int height,
              Function&& height_at) {
  for (const Boundary boundary : {Boundary::tile, Boundary::open}) {
    maps.push_back({name + ", " + to_string(boundary), make_map(width, height, boundary, height_at)});
  }
}

/// Without trailing zeros.
std::string to_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Waves of relief 1 on a map of width 1, without a symmetry.
double wave(int row, int column, double size) {
  return 0.5 + 0.3 * std::sin(6.2831853 * column / size) +
         0.2 * std::cos(6.2831853 * (row + 2.0 * column) / size);
}

void add_reliefs(std::vector<HardMap>& maps) {
  for (const double relief : {1e-9, 1e-6, 1e-3, 1e3, 1e6}) {
    add_both(maps, "waves of relief " + to_text(relief), 12, 12,
             [=](int row, int column) { return relief * wave(row, column, 12); });
  }
  maps.push_back({"rough, relief 100", make_rough_map(11, 13, Boundary::tile, 100, 0, 3)});
}

void add_single_texels(std::vector<HardMap>& maps) {
  for (const double depth : {-5.0, -0.1, 0.1, 5.0}) {
    add_both(maps, (depth < 0 ? "one pit of " : "one spike of ") + to_text(std::fabs(depth)), 9, 9,
             [=](int row, int column) { return row == 4 && column == 4 ? depth : 0.0; });
    add_both(maps, (depth < 0 ? "a slit of " : "a fence of ") + to_text(std::fabs(depth)), 9, 9,
             [=](int, int column) { return column == 4 ? depth : 0.0; });
  }
  add_both(maps, "a well a thousand times as deep as the map is wide", 9, 9, [](int row, int column) {
    return std::abs(row - 4) <= 1 && std::abs(column - 4) <= 1 ? -1000.0 : 0.0;
  });
}

void add_steps(std::vector<HardMap>& maps) {
  add_both(maps, "a cliff", 10, 10, [](int, int column) { return column < 5 ? 0.0 : 2.0; });
  add_both(maps, "a checkerboard", 10, 10,
           [](int row, int column) { return (row + column) % 2 == 0 ? 0.0 : 0.3; });
  add_both(maps, "terraces of eight bits", 16, 16,
           [](int row, int column) { return std::round(12 * wave(row, column, 16)) / 255; });
  add_both(maps, "a ramp, the tile's edges do not match", 14, 6,
           [](int row, int column) { return 0.1 * column + 0.02 * row; });
  add_both(maps, "a crease", 12, 7, [](int, int column) { return 0.2 * std::abs(column - 6); });
  add_both(maps, "a ridge", 12, 7, [](int, int column) { return -0.2 * std::abs(column - 6); });
  add_both(maps, "a grazing horizon", 24, 5, [](int, int column) { return column == 23 ? 1e-6 : 0.0; });
}

void add_levels(std::vector<HardMap>& maps) {
  add_both(maps, "level", 8, 8, [](int, int) { return 0.25; });
  add_both(maps, "denormal", 8, 8, [](int row, int column) { return 1e-40 * wave(row, column, 8); });
}

void add_sizes(std::vector<HardMap>& maps) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 7}, {7, 1}, {2, 2}, {2, 5}, {13, 17}, {65, 3}}) {
    add_both(maps, std::to_string(width) + " x " + std::to_string(height), width, height,
             [](int row, int column) {
               return 0.1 * unit_real(hash_combine(7, static_cast<std::uint64_t>(97 * row + column)));
             });
  }
}

void add_holes(std::vector<HardMap>& maps) {
  const auto rough = [](int row, int column) {
    return 0.3 * unit_real(hash_combine(5, static_cast<std::uint64_t>(97 * row + column)));
  };
  add_both(maps, "a hole beside every second receiver", 11, 11, [=](int row, int column) {
    return row % 2 == 1 && column % 2 == 1 ? kMissing : rough(row, column);
  });
  add_both(maps, "islands", 13, 13, [=](int row, int column) {
    return row % 4 == 3 || column % 5 == 4 ? kMissing : rough(row, column);
  });
  add_both(maps, "one sample alone", 9, 9,
           [](int row, int column) { return row == 4 && column == 4 ? 0.5 : kMissing; });
}

}  // namespace

std::vector<HardMap> hard_maps() {
  std::vector<HardMap> maps;
  add_reliefs(maps);
  add_single_texels(maps);
  add_steps(maps);
  add_levels(maps);
  add_sizes(maps);
  add_holes(maps);
  Heightmap uneven = make_rough_map(12, 9, Boundary::tile, 0.2, 0, 8);
  uneven.spacing = {0.3, 0.01};
  maps.push_back({"spacing of 30 to 1", std::move(uneven)});
  return maps;
}

}  // namespace heightlight
