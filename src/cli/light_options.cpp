#include "cli/light_options.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/byte_size.h"
#include "cli/number_list.h"
#include "files/image_file.h"
#include "files/image_read.h"
#include "files/printable.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "heightlight/sky_light.h"

namespace heightlight {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

bool is_named_sky(const std::string& sky) { return sky.empty() || sky == "uniform" || sky == "overcast"; }

/// One channel, or the first three. Where heights are missing, so is what stands there.
std::vector<TexelVector> read_direct(const std::filesystem::path& path, const Surface& surface,
                                     std::uint64_t memory) {
  const InputFile file(path);
  const FileFormat format = recognise_format(file);
  if (!is_picture(format)) throw file.error("is not an image, as direct irradiance (E/pi) must be");
  const StoredImage image = read_image(file, format, memory);
  if (image.is_integer)
    throw file.error(
        "holds integers; direct irradiance (E/pi) must be stored as floats: EXR, or TIFF of floats");
  if (image.width != surface.width() || image.height != surface.height())
    throw file.error(fmt::format("the direct irradiance is {} × {} texels, but the heightmap is {} × {}",
                                 image.width, image.height, surface.width(), surface.height()));
  const std::size_t stride = image.channels.size();
  std::vector<TexelVector> channels(stride >= 3 ? 3 : 1, TexelVector(surface.map.height.size()));
  std::visit(
      [&](const auto& samples) {
        for (std::size_t i = 0; i < surface.map.height.size(); ++i) {
          if (std::isnan(surface.map.height.values[i])) continue;
          for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto value = static_cast<double>(samples[i * stride + c]);
            if (!(value >= 0 && std::isfinite(value)))
              throw file.error(
                  "has direct irradiance that is negative or not a number at texels that have heights");
            channels[c][i] = value;
          }
        }
      },
      image.samples);
  file.check_unchanged();
  return channels;
}

DirectIrradiance light_of_sky(const std::string& name, const Surface& surface, const LightLimits& limits) {
  const bool is_overcast = name == "overcast";
  const SkyLight sky = is_overcast ? overcast_sky() : normalised(load_sky_light(name, limits.memory));
  const std::uint64_t needed = sky_irradiance_bytes(surface, sky);
  if (needed > limits.memory)
    throw MemoryError("the direct irradiance of a sky needs " + format_byte_size(needed) +
                          ", more than the " + format_byte_size(limits.memory) + " of memory allowed",
                      needed - limits.memory);
  SkyIrradiance found =
      sky_irradiance(surface, sky, {.error = limits.error, .seed = limits.seed, .watch = limits.watch});
  return {.channels = std::move(found.channels),
          .description = is_overcast ? "overcast sky of the CIE, a level plain's E/pi is 1"
                                     : "sky " + printable(std::filesystem::path(name).filename()) +
                                           ", in units of a level plain's E/pi",
          .rmse = found.rmse};
}

}  // namespace

Sun parse_sun(const std::string& text) {
  const std::optional<std::vector<double>> list = parse_number_list(text);
  if (!list || list->size() < 2 || list->size() > 3)
    throw UsageError("sun", text, "must be azimuth and elevation in degrees, such as 135,30");
  const std::vector<double>& numbers = *list;
  Sun sun{.azimuth_rad = std::numbers::pi / 2 - numbers[0] * kDegree, .elevation_rad = numbers[1] * kDegree};
  if (numbers.size() == 3) sun.diameter_rad = numbers[2] * kDegree;
  check_sun(sun);
  return sun;
}

void add_light_options(CLI::App& command, LightOptions& options) {
  auto* direct = command
                     .add_option("--direct", options.direct,
                                 "user-given direct irradiance, from which the bounces are computed: an "
                                 "image of E/pi in floats, of the size of the map")
                     ->type_name("FILE");
  auto* sun =
      command
          .add_option("--sun", options.sun,
                      "direct irradiance of the sun alone: azimuth clockwise from north, elevation and "
                      "diameter (default 0.533) in degrees; E/pi is 1 on a plane that faces the sun")
          ->type_name("AZ,EL[,D]");
  auto* sky =
      command
          .add_option(
              "--sky", options.sky,
              "direct irradiance of a sky: uniform (default), overcast, or an image of radiance by latitude "
              "and longitude whose middle faces the top of the map; E/pi is 1 on a level plain")
          ->type_name("uniform|overcast|FILE");
  sun->excludes(direct);
  sky->excludes(direct)->excludes(sun);
}

bool has_own_light(const LightOptions& options) {
  return !options.direct.empty() || !options.sun.empty() ||
         (!options.sky.empty() && options.sky != "uniform");
}

std::vector<std::filesystem::path> light_files(const LightOptions& options) {
  std::vector<std::filesystem::path> files;
  if (!options.direct.empty()) files.push_back(options.direct);
  if (!is_named_sky(options.sky)) files.emplace_back(options.sky);
  return files;
}

void check_light_options(const LightOptions& options) {
  if (!options.sun.empty()) parse_sun(options.sun);
  for (const std::filesystem::path& path : light_files(options)) InputFile{path};
}

std::size_t count_light_channels(const LightOptions& options) {
  for (const std::filesystem::path& path : light_files(options)) {
    const InputFile file(path);
    const FileFormat format = recognise_format(file);
    if (!is_picture(format)) throw file.error("is not an image of direct irradiance or of a sky");
    if (count_channels(file, format) >= 3) return 3;
  }
  return 1;
}

std::string light_key(const LightOptions& options) {
  if (!has_own_light(options)) return "";
  std::string key = "sun " + options.sun + " sky " + (is_named_sky(options.sky) ? options.sky : "");
  if (!options.direct.empty()) key += " direct";
  for (const std::filesystem::path& path : light_files(options)) key += ' ' + sha256_of_file(path);
  return key;
}

DirectIrradiance find_direct_irradiance(const LightOptions& options, const Surface& surface,
                                        const LightLimits& limits) {
  if (!options.direct.empty()) {
    return {.channels = read_direct(options.direct, surface, limits.memory),
            .description = "E/pi of " + printable(options.direct.filename())};
  }
  if (!options.sun.empty()) {
    const Sun sun = parse_sun(options.sun);
    return {.channels = {sun_irradiance(surface, sun, limits.watch)},
            .description = fmt::format("sun at {:g}, {:g} degrees, a facing plane's E/pi is 1",
                                       90 - sun.azimuth_rad / kDegree, sun.elevation_rad / kDegree)};
  }
  if (!has_own_light(options)) return {};
  DirectIrradiance light = light_of_sky(options.sky, surface, limits);
  light.channels.resize(count_light_channels(options), light.channels[0]);  // a grey one in a file of colours
  return light;
}

}  // namespace heightlight
