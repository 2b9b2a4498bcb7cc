#include "plot/material_sheet.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "base/area_mean.h"
#include "base/digits.h"
#include "base/percentile.h"
#include "base/texel_algebra.h"
#include "files/picture_text.h"
#include "plot/lit_sphere.h"
#include "plot/previews.h"

namespace heightlight {
namespace {

constexpr int kPanel = 384;
constexpr int kGap = 16;
constexpr int kLabel = 28;
constexpr int kTitle = 72;
constexpr int kPanelStep = kPanel + kGap;
constexpr int kSphere = 2 * kPanel + kLabel + kGap;
constexpr Rgb8 kGround{40, 40, 40};
constexpr Rgb8 kBright{235, 235, 235};
constexpr Rgb8 kSoft{170, 170, 170};

/// Sides of the map where it fits into a panel.
std::array<int, 2> fitted(const Surface& surface) {
  const Heightmap& map = surface.map;
  const double across = map.spacing.x * surface.width();
  const double down = map.spacing.y * surface.height();
  const double longest = std::max(across, down);
  const auto side = [longest](double extent) {
    return std::max(1, static_cast<int>(std::lround(kPanel * extent / longest)));
  };
  return {side(across), side(down)};
}

/// A map of the material made of its texels, at the panels' size.
Map shrunk(const Surface& surface, const std::function<float(std::size_t)>& value) {
  Map map(surface.width(), surface.height());
  for (std::size_t i = 0; i < map.size(); ++i) map.values[i] = value(i);
  const auto [width, height] = fitted(surface);
  return area_mean(map, width, height);
}

std::array<Map, 3> shrunk(const Surface& surface, const Image<Vector3>& vectors) {
  return {shrunk(surface, [&](std::size_t i) { return vectors.values[i].x; }),
          shrunk(surface, [&](std::size_t i) { return vectors.values[i].y; }),
          shrunk(surface, [&](std::size_t i) { return vectors.values[i].z; })};
}

/// As a file holds it: not encoded. One channel, or three.
Image<Rgb8> plain_picture(const std::vector<const Map*>& channels) {
  const Map& first = *channels.front();
  Image<Rgb8> picture(first.width, first.height, kMissingColour);
  for (std::size_t i = 0; i < picture.size(); ++i) {
    if (std::isnan(first.values[i])) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = channels[channels.size() == 1 ? 0 : c]->values[i];
      picture.values[i][c] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0F, 1.0F)));
    }
  }
  return picture;
}

/// Directions as colours.
Image<Rgb8> direction_picture(std::array<Map, 3> vectors, bool y_down) {
  for (std::size_t i = 0; i < vectors[0].size(); ++i) {
    const Eigen::Vector3f v(vectors[0].values[i], vectors[1].values[i], vectors[2].values[i]);
    const Eigen::Vector3f unit = v.normalized();
    for (std::size_t c = 0; c < 3; ++c)
      vectors[c].values[i] = 0.5F + 0.5F * unit[static_cast<Eigen::Index>(c)] * (c == 1 && y_down ? -1 : 1);
  }
  return plain_picture({&vectors[0], &vectors[1], &vectors[2]});
}

void paste(Image<Rgb8>& sheet, int top, int left, const Image<Rgb8>& picture) {
  for (int row = 0; row < picture.height; ++row)
    std::copy_n(&picture(row, 0), picture.width, &sheet(top + row, left));
}

double mean_of(const Map& map) {
  double sum = 0;
  double count = 0;
  for (const float value : map.values) {
    if (std::isnan(value)) continue;
    sum += double{value};
    ++count;
  }
  return sum / count;
}

double median_slope_deg(const Surface& surface) {
  std::vector<float> upright;
  for (const Vector3& normal : surface.normal.values) {
    if (!std::isnan(normal.z)) upright.push_back(normal.z);
  }
  return std::acos(std::min(1.0, percentile(std::span<float>(upright), 0.5))) * 180 / std::numbers::pi;
}

std::string describe(const SheetMaterial& material) {
  const Heightmap& map = material.surface.map;
  const double width = map.spacing.x * map.height.width;
  return fmt::format(
      "{} x {} samples   width {}   relief {} ({:.2g} % of it)   median slope {:.0f} deg   mean AO {:.2f}",
      map.height.width, map.height.height, in_digits(width, 4), in_digits(relief(map), 4),
      100 * relief(map) / width, median_slope_deg(material.surface), mean_of(material.occlusion));
}

std::string name_of(const Albedo& albedo) {
  if (!albedo.varying.empty()) return "all bounces, at its albedo";
  std::string numbers;
  for (const double value : albedo.constant) numbers += (numbers.empty() ? "" : ",") + in_digits(value, 2);
  return "all bounces, albedo " + numbers;
}

/// What the surface reflects of the sky, per channel.
std::vector<Map> reflected(const SheetMaterial& material) {
  const Albedo& albedo = material.albedo;
  const std::size_t channels = std::max(material.totals.size(), albedo.channels());
  std::vector<Map> maps;
  for (std::size_t c = 0; c < channels; ++c) {
    const Map& total = material.totals[material.totals.size() == 1 ? 0 : c];
    const std::size_t own = albedo.channels() == 1 ? 0 : c;
    maps.push_back(shrunk(material.surface, [&](std::size_t i) {
      const double share = albedo.varying.empty() ? albedo.constant[own] : albedo.varying[own][i];
      return static_cast<float>(share * double{total.values[i]});
    }));
  }
  return maps;
}

/// Places of the panels beside the sphere, by their number: two a row.
class Sheet {
 public:
  Sheet() : picture_(kSphere + 2 * kGap + 2 * kPanelStep, kTitle + kSphere + kLabel + kGap, kGround) {}

  void add_title(const std::string& name, const std::string& facts) {
    draw_text(picture_, kGap, kGap, name, 3, kBright);
    draw_text(picture_, kGap + 30, kGap, facts, 2, kSoft);
  }
  void add_sphere(const Image<Rgb8>& sphere, const std::string& label) {
    paste(picture_, kTitle, kGap, sphere);
    draw_text(picture_, kTitle + kSphere + 8, kGap, label, 2, kBright);
  }
  void add_panel(const Image<Rgb8>& panel, const std::string& label) {
    const int top = kTitle + (count_ / 2) * (kPanel + kLabel + kGap);
    const int left = kSphere + 2 * kGap + (count_ % 2) * kPanelStep;
    paste(picture_, top + kPanel - panel.height, left + (kPanel - panel.width) / 2, panel);
    draw_text(picture_, top + kPanel + 8, left, label, 2, kBright);
    ++count_;
  }
  const Image<Rgb8>& picture() const { return picture_; }

 private:
  Image<Rgb8> picture_;
  int count_ = 0;
};

}  // namespace

Image<Rgb8> draw_material_sheet(const SheetMaterial& material) {
  const Surface& surface = material.surface;
  const float span = surface.highest - surface.lowest;
  const Map heights = shrunk(surface, [&](std::size_t i) {
    const float above = surface.map.height.values[i] - surface.lowest;
    return span > 0 ? above / span : above;
  });
  const Map occlusion = shrunk(surface, [&](std::size_t i) { return material.occlusion.values[i]; });
  std::vector<Map> totals;
  for (const Map& total : material.totals)
    totals.push_back(shrunk(surface, [&](std::size_t i) { return total.values[i]; }));
  std::vector<const Map*> shown;
  for (const Map& total : totals) shown.push_back(&total);
  std::array<Map, 3> normal = shrunk(surface, surface.normal);
  const Spacing& spacing = surface.map.spacing;
  const SphereSkin skin{.normal_x = std::move(normal[0]),
                        .normal_y = std::move(normal[1]),
                        .normal_z = std::move(normal[2]),
                        .occlusion = occlusion,
                        .reflected = reflected(material),
                        .proportion = spacing.y * surface.height() / (spacing.x * surface.width())};
  Sheet sheet;
  sheet.add_title(material.name, describe(material));
  sheet.add_sphere(lit_sphere(skin, kSphere, kGround),
                   "normal, AO and bounces on a sphere, under a sky and a lamp");
  sheet.add_panel(plain_picture({&heights}), "heights");
  sheet.add_panel(plain_picture({&occlusion}), "ambient occlusion");
  sheet.add_panel(direction_picture(shrunk(surface, material.first_moment), material.y_down),
                  material.y_down ? "bent normal, y down" : "bent normal");
  sheet.add_panel(plain_picture(shown), name_of(material.albedo));
  return sheet.picture();
}

}  // namespace heightlight
