#include "cli/map_options.h"

#include <omp.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "base/byte_size.h"
#include "base/digits.h"
#include "base/machine_share.h"
#include "cli/length.h"
#include "files/library_threads.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

/// A number to its end; nothing for anything else.
std::optional<double> parse_number(const std::string& text) {
  double value = 0;
  const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && stop == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

double parse_length(const std::string& text, const std::string& whole) {
  const std::optional<double> value = parse_number(text);
  if (!value) throw UsageError("texel", whole, "write one spacing, such as 50, or two, such as 70.8x92.6");
  return *value;
}

Spacing parse_spacing(const std::string& text) {
  const std::size_t cross = text.find('x');
  if (cross == std::string::npos) {
    const double both = parse_length(text, text);
    return {both, both};
  }
  return {parse_length(text.substr(0, cross), text), parse_length(text.substr(cross + 1), text)};
}

double parse_refraction(const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value || !(*value >= 0 && *value < 1))
    throw UsageError("curvature", text,
                     "must be the coefficient of refraction, from 0 to below 1, or be left out");
  return *value;
}

constexpr const char* kSizeForms =
    "write columns and rows of raw samples, such as 1024x512, or an extent with its unit, such as 1m";

std::array<int, 2> parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto side = [&](const std::string& number) {
    int value = 0;
    const auto [stop, fault] = std::from_chars(number.data(), number.data() + number.size(), value);
    if (fault != std::errc() || stop != number.data() + number.size() || value < 1)
      throw UsageError("size", text, kSizeForms);
    return value;
  };
  if (cross == std::string::npos) throw UsageError("size", text, kSizeForms);
  return {side(text.substr(0, cross)), side(text.substr(cross + 1))};
}

double parse_height(const std::string& text) {
  const std::optional<Length> length = read_length(text);
  if (!length) throw UsageError("height", text, "write a length, such as 5cm");
  return length->value;
}

/// Samples of raw files, or how wide the map is in the world. `spacing_is_given`: that is known already.
void take_size(const std::string& text, bool spacing_is_given, LoadOptions& load) {
  const std::optional<Length> extent = read_length(text);
  if (!extent || !extent->has_unit) {
    load.size = parse_size(text);
    return;
  }
  if (spacing_is_given)
    throw UsageError("size", text, "is an extent, but --width or --texel gives that already");
  load.width = extent->value;
}

/// What the process takes later, beside its work: code and libraries that are loaded as they are first
/// needed, 9 MiB on maps of 16², and what each thread keeps of tiles and stack, less than 1 MiB on maps of
/// 1024².
std::uint64_t bytes_to_come(int threads) {
  constexpr std::uint64_t kLoaded = 12 << 20;
  constexpr std::uint64_t kPerThread = 1 << 20;
  return kLoaded + kPerThread * static_cast<std::uint64_t>(threads);
}

}  // namespace

// CLI11 takes "-1" for the largest number that there is, and so what is larger than that.
CLI::Validator whole_number() {
  const auto check = [](std::string& text) -> std::string {
    std::uint64_t value = 0;
    const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault == std::errc() && stop == text.data() + text.size()) return "";
    return "'" + text + "' is not a whole number from 0 to 18446744073709551615";
  };
  return {check, ""};
}

void add_map_options(CLI::App& command, MapOptions& options) {
  command
      .add_option(
          "MAP", options.path,
          "heightmap: PNG, EXR, TIFF, JPEG, TGA, HDR, Esri ASCII grid, NumPy array, SRTM tile or raw samples")
      ->required();
  add_load_options(command, options.load);
}

void add_load_options(CLI::App& command, LoadOptions& load) {
  auto* relief = command.add_option("--relief", load.relief,
                                    "height from the lowest to the highest place, in world units (default "
                                    "for images: a tenth of the width)");
  command
      .add_option_function<std::string>(
          "--height", [&load](const std::string& text) { load.relief = parse_height(text); },
          "height from the lowest to the highest place with its unit, such as 5cm; world units are then "
          "metres")
      ->type_name("LENGTH")
      ->excludes(relief);
  auto* width =
      command.add_option("--width", load.width,
                         "width of the map, from its first to its last column, in world units (default 1)");
  auto* texel = command
                    .add_option_function<std::string>(
                        "--texel",
                        [&load](const std::string& text) {
                          load.degrees_in_metres = text == "auto";
                          if (!load.degrees_in_metres) load.texel = parse_spacing(text);
                        },
                        "distance between samples in world units: S for both axes, or SXxSY; auto converts a "
                        "spacing that the file gives in degrees into metres")
                    ->type_name("S|SXxSY|auto")
                    ->excludes(width);
  command
      .add_option_function<std::string>(
          "--boundary",
          [&load](const std::string& text) {
            load.boundary = text == "tile" ? Boundary::tile : Boundary::open;
          },
          "tile: the map repeats without end (default of images); open: there is nothing beyond its edges "
          "(default of georeferenced files, such as GeoTIFF and Esri grids)")
      ->check(CLI::IsMember({"tile", "open"}));
  command
      .add_option_function<std::string>(
          "--size",
          [&load, width, texel](const std::string& text) {
            take_size(text, width->count() > 0 || texel->count() > 0, load);
          },
          "WxH: columns and rows of a file of raw samples; LENGTH: width of the map with its unit, such as "
          "1m")
      ->type_name("WxH|LENGTH");
  command.add_flag("--big-endian", load.big_endian, "raw samples are stored with the highest byte first");
  command.add_option("--scale", load.scale,
                     "height of one stored unit in world units; heights are then not stretched to a relief");
  command.add_option("--offset", load.offset,
                     "height of a stored 0 in world units (default 0); excludes --relief");
  command.add_option("--no-data", load.no_data, "stored value that marks a missing sample");
  command.add_option("--part", load.part,
                     "part to read from an EXR with several parts, by name or by number from 0");
  command.add_option("--channel", load.channel,
                     "channel to read, by name or by number from 0; needed where the channels differ");
  command
      .add_option("--shrink", load.shrink,
                  "replace each block of N × N samples by its mean, for a quicker look (default 1)")
      ->type_name("N");
  command.add_flag("--invert", load.invert, "the file holds depths: its highest value is the lowest place");
  command
      .add_option_function<std::string>(
          "--curvature", [&load](const std::string& text) { load.curvature = parse_refraction(text); },
          "lower the heights by the Earth's curvature around the middle of the map, with the coefficient of "
          "refraction K, from 0 to below 1 (default 0.13); needs an open map and world units in metres; "
          "takes no extra time")
      ->expected(0, 1)
      ->default_str(in_digits(kUsualRefraction))
      ->type_name("[K]");
}

void add_resource_options(CLI::App& command, RunOptions& options) {
  command
      .add_option("--threads", options.threads,
                  "number of threads (default: OMP_NUM_THREADS, or one per processor that the process may "
                  "use); results do not depend on it")
      ->check(CLI::Range(0, 4096));
  command
      .add_option_function<std::string>(
          "--memory", [&options](const std::string& text) { options.memory = parse_byte_size(text); },
          "most memory that the whole process may use, including its code, such as 8G (default: four fifths "
          "of the free memory)")
      ->type_name("BYTES");
  command.add_flag("--quiet", options.quiet, "print no progress bar and no summary");
}

void add_run_options(CLI::App& command, RunOptions& options) {
  add_resource_options(command, options);
  command.add_option("--seed", options.seed, "seed of all random choices (default 1)")->check(whole_number());
}

void apply_run_options(RunOptions& options) {
  const int threads = options.threads > 0 ? options.threads : default_threads();
  omp_set_num_threads(threads);
  limit_library_threads(threads);
  const std::uint64_t held = resident_memory();
  const std::uint64_t promised = options.memory > 0 ? options.memory : held + default_memory(threads);
  options.program_memory = held + bytes_to_come(threads);
  options.memory = promised - std::min(promised, options.program_memory);
}

}  // namespace heightlight
