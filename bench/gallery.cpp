// The README's gallery of baked maps, made from files that `heightlight bake` wrote (plots/make-gallery).
// Row 1: height, ao, bent normal, and what a grey and a red surface reflect under an even sky (albedo × E/π).
// Row 2: a red sphere under an uneven sky, with the normal map alone; with ao as well (toward the bent
// normal); and with the red albedo's multibounce in place of ao.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "files/image_file.h"
#include "files/image_read.h"
#include "heightlight/error.h"
#include "visibility/sky_harmonics.h"

namespace heightlight {
namespace {

constexpr double kPi = std::numbers::pi;
using Colour = Eigen::Array3d;

/// A 16-bit texture of one or three channels; samples in [0, 1].
class Texture {
 public:
  explicit Texture(const std::filesystem::path& path)
      : image_(read_image(path, recognise_format(path), std::uint64_t{1} << 32)) {
    if (!std::holds_alternative<std::vector<std::uint16_t>>(image_.samples)) {
      throw Error(path.string() + ": not a 16-bit texture");
    }
  }
  int width() const { return image_.width; }
  int height() const { return image_.height; }
  Colour at(int row, int column) const {
    const auto& samples = std::get<std::vector<std::uint16_t>>(image_.samples);
    const std::size_t stride = image_.channels.size();
    const auto texel = (static_cast<std::size_t>(row) * static_cast<std::size_t>(image_.width) +
                        static_cast<std::size_t>(column)) *
                       stride;
    Colour colour;
    for (std::size_t c = 0; c < 3; ++c) {
      colour[static_cast<Eigen::Index>(c)] = samples[texel + (stride == 1 ? 0 : c)] / 65535.0;
    }
    return colour;
  }
  /// Bilinear interpolation; the texture repeats.
  Colour sample(double u, double v) const {
    const double x = (u - std::floor(u)) * width() - 0.5;
    const double y = (v - std::floor(v)) * height() - 0.5;
    const int column = static_cast<int>(std::floor(x));
    const int row = static_cast<int>(std::floor(y));
    const auto wrapped = [](int i, int count) { return (i + count) % count; };
    const auto texel = [&](int i, int j) {
      return at(wrapped(row + i, height()), wrapped(column + j, width()));
    };
    const double right = x - column;
    const double down = y - row;
    return (1 - down) * ((1 - right) * texel(0, 0) + right * texel(0, 1)) +
           down * ((1 - right) * texel(1, 0) + right * texel(1, 1));
  }

 private:
  StoredImage image_;
};

std::uint8_t encode_srgb(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return static_cast<std::uint8_t>(
      std::lround(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055)));
}

Rgb8 picture(const Colour& colour) {
  return {encode_srgb(colour.x()), encode_srgb(colour.y()), encode_srgb(colour.z())};
}

/// For maps that show data: the values are not encoded as sRGB.
Rgb8 plain(const Colour& colour) {
  Rgb8 pixel;
  for (std::size_t c = 0; c < 3; ++c) {
    pixel[c] = static_cast<std::uint8_t>(std::lround(255 * colour[static_cast<Eigen::Index>(c)]));
  }
  return pixel;
}

/// E/π of an unoccluded place with this normal, under a sky that is bright in the upper left; x right, y up,
/// z out of the picture.
Colour sky_toward(const Eigen::Vector3d& normal) {
  static const std::array<Harmonics, 3> kSky = [] {
    const Harmonics key = harmonics_of(Eigen::Vector3d(-0.6, 0.6, 0.53).normalized());
    const Harmonics fill = harmonics_of(Eigen::Vector3d(0.7, -0.2, 0.6).normalized());
    const Colour bright(3.4, 3.2, 2.9);
    const Colour dim(0.5, 0.8, 1.3);
    std::array<Harmonics, 3> sky{};
    for (std::size_t c = 0; c < 3; ++c) {
      const auto channel = static_cast<Eigen::Index>(c);
      for (std::size_t i = 0; i < 9; ++i) {
        sky[c][i] = bright[channel] * key[i] + dim[channel] * fill[i] + (i == 0 ? 0.9 : 0.0);
      }
    }
    return sky;
  }();
  Harmonics y = harmonics_of(normal);
  // convolves with the cosine lobe, over π
  for (std::size_t i = 0; i < 9; ++i) y[i] *= i == 0 ? 1 : i < 4 ? 2.0 / 3 : 0.25;
  return Colour(dot(y, kSky[0]), dot(y, kSky[1]), dot(y, kSky[2])).max(0);
}

struct Maps {
  Texture normal, bent, ao, red;
};

enum class Shading { normals, occlusion, bounces };

/// Colour of the sphere at (x, y) in its disk of radius 1; the tile repeats over longitude and latitude.
Colour shade_sphere(double x, double y, const Maps& maps, const Colour& albedo, Shading shading) {
  const Eigen::Vector3d n(x, y, std::sqrt(std::max(0.0, 1 - x * x - y * y)));
  const double longitude = std::atan2(n.x(), n.z());
  const double latitude = std::asin(std::clamp(n.y(), -1.0, 1.0));
  const double u = longitude / kPi * 2;
  const double v = -latitude / kPi * 2;
  const Eigen::Vector3d tangent(std::cos(longitude), 0, -std::sin(longitude));
  const Eigen::Vector3d bitangent = n.cross(tangent);
  const auto to_world = [&](const Colour& stored) {
    const Colour t = 2 * stored - 1;
    return Eigen::Vector3d(t.x() * tangent + t.y() * bitangent + t.z() * n).normalized();
  };
  if (shading == Shading::normals) return albedo * sky_toward(to_world(maps.normal.sample(u, v)));
  const Colour share = shading == Shading::occlusion ? maps.ao.sample(u, v) : maps.red.sample(u, v);
  return albedo * share * sky_toward(to_world(maps.bent.sample(u, v)));
}

constexpr int kGap = 8;
constexpr int kSmall = 256;

void paste(Image<Rgb8>& sheet, int top, int left, int side, const std::function<Rgb8(int, int)>& pixel) {
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) sheet(top + row, left + column) = pixel(row, column);
  }
}

/// The colours of a picture of kSmall × kSmall pixels that shows the whole texture; `tone` converts samples.
std::function<Rgb8(int, int)> show(const Texture& texture, const std::function<Rgb8(const Colour&)>& tone) {
  return [&texture, tone](int row, int column) {
    return tone(texture.sample((column + 0.5) / kSmall, (row + 0.5) / kSmall));
  };
}

void draw_sphere(Image<Rgb8>& sheet, int top, int left, int side, const Maps& maps, const Colour& albedo,
                 Shading shading) {
  constexpr int kSamples = 3;  // per side of a pixel
  paste(sheet, top, left, side, [&](int row, int column) {
    Colour sum = Colour::Zero();
    for (int s = 0; s < kSamples * kSamples; ++s) {
      const double x = 2.06 * ((column + (s % kSamples + 0.5) / kSamples) / side - 0.5);
      const double y = -2.06 * ((row + (s / kSamples + 0.5) / kSamples) / side - 0.5);
      sum += x * x + y * y < 1 ? shade_sphere(x, y, maps, albedo, shading) : Colour(Colour::Constant(1));
    }
    return picture(sum / (kSamples * kSamples));
  });
}

void draw(const std::filesystem::path& grey_folder, const std::filesystem::path& red_folder,
          const std::string& name, const std::vector<double>& reflectance, double grey_albedo,
          const std::filesystem::path& output) {
  const auto file = [&](const std::filesystem::path& folder, const char* map) {
    return folder / (name + "_" + map + ".png");
  };
  const Texture height(file(grey_folder, "height"));
  const Texture grey(file(grey_folder, "multibounce"));
  const Maps maps{Texture(file(grey_folder, "normal")), Texture(file(grey_folder, "bent-normal")),
                  Texture(file(grey_folder, "ao")), Texture(file(red_folder, "multibounce"))};
  const Colour albedo(reflectance[0], reflectance[1], reflectance[2]);
  const int width = 5 * kSmall + 4 * kGap;
  const int side = (width - 2 * kGap) / 3;
  Image<Rgb8> sheet(width, kSmall + kGap + side, Rgb8{255, 255, 255});
  const auto left = [](int i) { return i * (kSmall + kGap); };
  paste(sheet, 0, left(0), kSmall, show(height, plain));
  paste(sheet, 0, left(1), kSmall, show(maps.ao, plain));
  paste(sheet, 0, left(2), kSmall, show(maps.bent, plain));
  paste(sheet, 0, left(3), kSmall, show(grey, [&](const Colour& e) { return picture(grey_albedo * e); }));
  paste(sheet, 0, left(4), kSmall, show(maps.red, [&](const Colour& e) { return picture(albedo * e); }));
  const Shading shadings[] = {Shading::normals, Shading::occlusion, Shading::bounces};
  for (int i = 0; i < 3; ++i) {
    draw_sphere(sheet, kSmall + kGap, i * (side + kGap), side, maps, albedo, shadings[i]);
  }
  write_png(output, sheet);
}

}  // namespace
}  // namespace heightlight

int main(int argument_count, char** arguments) {
  try {
    std::filesystem::path grey;
    std::filesystem::path red;
    std::filesystem::path output;
    std::string name;
    std::vector<double> albedo;
    double grey_albedo = 0.5;
    CLI::App app("The gallery of baked maps; the head of the source says what it shows");
    app.add_option("GREY", grey, "folder with height, ao, normal, bent-normal and grey multibounce")
        ->required();
    app.add_option("RED", red, "folder with coloured multibounce")->required();
    app.add_option("--name", name, "of the map")->required();
    app.add_option("--albedo", albedo, "R,G,B that the coloured one was baked with")
        ->delimiter(',')
        ->expected(3)
        ->required();
    app.add_option("--grey", grey_albedo, "albedo that the grey one was baked with (0.5)");
    app.add_option("-o,--output", output, "picture to write (.png)")->required();
    CLI11_PARSE(app, argument_count, arguments);
    heightlight::draw(grey, red, name, albedo, grey_albedo, output);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heightlight_gallery: %s\n", error.what());
    return 1;
  }
  return 0;
}
