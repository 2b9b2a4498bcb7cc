#include "cli/albedo.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <system_error>

#include "base/srgb.h"
#include "files/decoded_channel.h"
#include "files/image_file.h"
#include "files/image_read.h"
#include "files/input_file.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// "#b5533c", as pictures have it: linear R, G, B; nothing where the text is no such colour.
std::optional<std::vector<double>> parse_picture_colour(const std::string& text) {
  if (text.size() != 7 || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != text.npos) {
    return std::nullopt;
  }
  std::vector<double> values;
  for (std::size_t at = 1; at < text.size(); at += 2) {
    values.push_back(srgb_to_linear(std::stoi(text.substr(at, 2), nullptr, 16) / 255.0));
  }
  return values;
}

/// "0.5" or "0.6,0.3,0.2"; nothing where the text is no list of numbers.
std::optional<std::vector<double>> parse_constants(const std::string& text) {
  std::vector<double> values;
  const char* rest = text.c_str();
  for (;;) {
    char* end = nullptr;
    values.push_back(std::strtod(rest, &end));
    if (end == rest) return std::nullopt;
    if (*end == '\0') return values;
    if (*end != ',') return std::nullopt;
    rest = end + 1;
  }
}

std::vector<double> check_constants(const std::string& text, std::vector<double> values) {
  const bool in_range = std::all_of(values.begin(), values.end(), [](double v) { return v >= 0 && v <= 1; });
  if (!in_range || (values.size() != 1 && values.size() != 3)) {
    throw UsageError("albedo", text, "must be one number, or three (R,G,B), each in [0, 1]");
  }
  if (std::all_of(values.begin(), values.end(), [&](double v) { return v == values[0]; })) values.resize(1);
  return values;
}

ReadAlbedo read_albedo_file(const std::string& path, const Heightmap& map, std::uint64_t memory_limit) {
  const InputFile file(path);
  const FileFormat format = recognise_format(file);
  if (!is_picture(format))
    throw file.error(std::string("is of the kind ") + to_string(format) +
                     ", which holds no albedo; use an image");
  const StoredImage image = read_image(file, format, memory_limit);
  if (image.width != map.height.width || image.height != map.height.height) {
    throw file_error(path, "the albedo is " + std::to_string(image.width) + " × " +
                               std::to_string(image.height) + " texels, but the heightmap is " +
                               std::to_string(map.height.width) + " × " + std::to_string(map.height.height));
  }
  Albedo albedo;
  const std::size_t channels = image.channels.size() >= 3 ? 3 : 1;  // an alpha channel follows one or three
  for (std::size_t channel = 0; channel < channels; ++channel) {
    albedo.varying.push_back(decode_channel<double>(image, channel, image.is_integer));
    TexelVector& values = albedo.varying.back();
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(map.height.values[i])) values[i] = 0;  // where nothing is, it may be missing, too
    }
    const auto in_range = [](double value) { return value >= 0 && value <= 1; };
    if (!std::all_of(values.begin(), values.end(), in_range)) {
      throw file_error(path, "the albedo has samples outside [0, 1]");
    }
  }
  const bool grey = std::all_of(albedo.varying.begin(), albedo.varying.end(),
                                [&](const TexelVector& values) { return values == albedo.varying[0]; });
  if (grey) albedo.varying.resize(1);
  ReadAlbedo read{.albedo = std::move(albedo), .sha256 = sha256_of_file(file)};
  file.check_unchanged();
  return read;
}

}  // namespace

std::optional<std::vector<double>> parse_albedo_list(const std::string& text) {
  constexpr std::size_t kMost = 8;
  std::optional<std::vector<double>> values = parse_constants(text);
  if (!values) return values;
  const bool in_range =
      std::all_of(values->begin(), values->end(), [](double v) { return v >= 0 && v <= 1; });
  if (!in_range || values->size() > kMost)
    throw UsageError("albedo", text,
                     "must be one to eight numbers, each in [0, 1], #RRGGBB, or the name of an image");
  return values;
}

void check_albedo(const std::string& text) {
  if (auto colour = parse_picture_colour(text)) return;
  if (auto constants = parse_constants(text)) {
    check_constants(text, std::move(*constants));
    return;
  }
  std::error_code ignored;
  const bool is_number = text.find_first_not_of("0123456789.,+-eE") == std::string::npos;
  if ((text.starts_with('#') || is_number) && !std::filesystem::exists(text, ignored))
    throw UsageError("albedo", text, "must be a number, R,G,B, #RRGGBB, or the name of an image");
  InputFile(std::filesystem::path(text));  // throws where there is none
}

Albedo announced_albedo(const std::string& text) {
  constexpr std::size_t kMostChannels = 3;
  if (auto colour = parse_picture_colour(text))
    return {.constant = check_constants(text, std::move(*colour))};
  if (auto constants = parse_constants(text))
    return {.constant = check_constants(text, std::move(*constants))};
  return {.varying = std::vector<TexelVector>(kMostChannels)};
}

ReadAlbedo read_albedo(const std::string& text, const Heightmap& map, std::uint64_t memory_limit) {
  Albedo announced = announced_albedo(text);
  if (announced.varying.empty()) return {.albedo = std::move(announced)};
  return read_albedo_file(text, map, memory_limit);
}

}  // namespace heightlight
