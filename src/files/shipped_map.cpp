#include "files/shipped_map.h"

#include <cmath>
#include <limits>
#include <type_traits>

#include "files/image_read.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// Integer samples are divided by the largest level; floats stay as they are.
Map decode(const StoredImage& image, std::size_t channel) {
  Map map(image.width, image.height);
  std::visit(
      [&](const auto& samples) {
        using Sample = typename std::decay_t<decltype(samples)>::value_type;
        constexpr double kLargest =
            std::is_integral_v<Sample> ? static_cast<double>(std::numeric_limits<Sample>::max()) : 1;
        for (std::size_t i = 0; i < map.size(); ++i)
          map.values[i] = static_cast<float>(
              static_cast<double>(samples[i * image.channels.size() + channel]) / kLargest);
      },
      image.samples);
  return map;
}

/// Colours that are meant to be grey differ by some levels in a JPEG.
bool is_grey(const Map& red, const Map& green, const Map& blue) {
  constexpr double kAlike = 0.02;
  double difference = 0;
  for (std::size_t i = 0; i < red.size(); ++i) {
    difference += std::fabs(double{red.values[i]} - double{green.values[i]}) +
                  std::fabs(double{blue.values[i]} - double{green.values[i]});
  }
  return difference < kAlike * static_cast<double>(red.size());
}

/// Whether a map has values below 0. Then floats hold the components of normals themselves.
bool has_negative(const Map& map) {
  for (const float value : map.values) {
    if (value < 0) return true;
  }
  return false;
}

Image<Vector3> to_normals(const InputFile& file, const Map& red, const Map& green, const Map& blue) {
  constexpr double kUnit = 0.15;   // largest deviation of a unit vector's length from 1
  constexpr double kNearly = 0.9;  // fraction of the texels that must be unit vectors
  const bool is_signed = has_negative(red) || has_negative(green);
  const auto component = [is_signed](float stored) { return is_signed ? stored : 2 * stored - 1; };
  Image<Vector3> normals(red.width, red.height);
  std::size_t units = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float x = component(red.values[i]);
    const float y = component(green.values[i]);
    const float z = component(blue.values[i]);
    const float length = std::sqrt(x * x + y * y + z * z);
    if (std::fabs(length - 1) < kUnit && z > 0) ++units;
    normals.values[i] = {x / length, y / length, z / length};
  }
  if (static_cast<double>(units) < kNearly * static_cast<double>(normals.size()))
    throw file.error("is neither grey, as ambient occlusion is, nor are its colours unit normals");
  return normals;
}

/// Bytes for three channels and the normals made from them.
std::uint64_t shipped_bytes(int columns, int rows) {
  return (3 * sizeof(float) + sizeof(Vector3)) * static_cast<std::uint64_t>(columns) *
         static_cast<std::uint64_t>(rows);
}

}  // namespace

ShippedMap read_shipped_map(const std::filesystem::path& path, std::uint64_t memory) {
  const InputFile file(path);
  const FileFormat format = recognise_format(file);
  if (!is_picture(format))
    throw file.error(std::string("is of the kind ") + to_string(format) +
                     ", which is no map of a material; use an image");
  const StoredImage image = read_image(file, format, ReadLimit(memory, shipped_bytes));
  file.check_unchanged();
  const Map first = decode(image, 0);
  if (image.channels.size() < 3) return first;
  const Map green = decode(image, 1);
  const Map blue = decode(image, 2);
  if (is_grey(first, green, blue)) return first;
  return to_normals(file, first, green, blue);
}

}  // namespace heightlight
