#include "files/saved_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "files/image_file.h"
#include "files/image_read.h"
#include "files/input_file.h"
#include "files/json_file.h"
#include "files/map_size.h"
#include "heightlight/transport.h"

namespace heightlight {
namespace {

const FileRecord* find_record(const RunSummary& run, const std::string& name) {
  const auto found = std::find_if(run.files.begin(), run.files.end(),
                                  [&](const FileRecord& record) { return record.name == name; });
  return found == run.files.end() ? nullptr : &*found;
}

/// Throws Error unless the file is the one that the summary beside it records.
void check_recorded(const InputFile& file, const FileRecord& record) {
  if (file.size() == record.bytes && sha256_of_file(file) == record.sha256) return;
  throw file.error(
      "is not the file that summary.json beside it records: files of several runs are mixed; simulate the "
      "map "
      "again");
}

/// Reads one float channel of width × height texels, or of any size if width is 0.
Map read_map(const std::filesystem::path& folder, const FileRecord& record, int width, int height,
             std::uint64_t memory_limit) {
  const std::filesystem::path path = folder / record.name;
  const InputFile file(path);
  check_recorded(file, record);
  StoredImage image = read_image(file, recognise_format(file), memory_limit);
  if (image.channels.size() != 1 || !std::holds_alternative<std::vector<float>>(image.samples)) {
    throw file_error(path, "is not one channel of floats, as simulate writes it");
  }
  if (width > 0 && (image.width != width || image.height != height)) {
    throw file_error(path, "is of " + std::to_string(image.width) + " × " + std::to_string(image.height) +
                               " texels, the maps beside it of " + std::to_string(width) + " × " +
                               std::to_string(height));
  }
  Map map;
  map.width = image.width;
  map.height = image.height;
  map.values = std::move(std::get<std::vector<float>>(image.samples));
  return map;
}

/// Sums of bounces, in double precision.
struct Sums {
  std::vector<double> all;                    ///< E₀ + … + E_b
  std::vector<std::vector<double>> weighted;  ///< Σ ρ^b E_b, per albedo
  std::vector<float> last;

  Sums(std::size_t texels, std::size_t albedos)
      : all(texels), weighted(albedos, std::vector<double>(texels)) {}

  void add(const Map& irradiance, int bounce, const std::vector<double>& albedos) {
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += double{irradiance.values[i]};
    for (std::size_t k = 0; k < albedos.size(); ++k) {
      const double power = std::pow(albedos[k], bounce);
      for (std::size_t i = 0; i < all.size(); ++i) weighted[k][i] += power * double{irradiance.values[i]};
    }
    last = irradiance.values;
  }
};

}  // namespace

std::string bounce_file(int bounce) { return fmt::format("irradiance_{:02}.exr", bounce); }

std::optional<RunSummary> read_run_summary(const std::filesystem::path& curves) {
  const std::filesystem::path path = curves.parent_path() / "summary.json";
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return std::nullopt;
  try {
    const nlohmann::json summary = read_json(path);
    const nlohmann::json& map = summary.at("map");
    if (!summary.contains("seen") || !summary.contains("files")) {
      throw file_error(path,
                       "does not tell what texels see ('seen') or what was written ('files'): simulate "
                       "the map again");
    }
    RunSummary run;
    run.files = parse_file_records(summary).value_or(run.files);
    const FileRecord* record = find_record(run, curves.filename().string());
    if (!record) return std::nullopt;
    check_recorded(curves, *record);
    run.map = std::filesystem::path(map.at("path").get<std::string>()).stem().string();
    run.sha256 = map.at("sha256").get<std::string>();
    run.tiles = map.at("boundary").get<std::string>() == "tile";
    run.relief = map.at("relief").get<double>();
    run.texel_x = map.at("texel").at(0).get<double>();
    run.width = run.texel_x * map.at("width").get<double>();
    run.expected_seen = summary.at("seen").at("expected_sky_view_factor").get<double>();
    run.measured_seen = summary.at("seen").at("mean_sky_view_factor").get<double>();
    return run;
  } catch (const nlohmann::json::exception& fault) {
    throw file_error(path, std::string("is not a summary of simulate: ") + fault.what());
  }
}

bool has_saved_texels(const RunSummary& run) {
  return find_record(run, bounce_file(0)) && find_record(run, bounce_file(1));
}

SavedTexels read_saved_texels(const std::filesystem::path& folder, const RunSummary& run,
                              const std::vector<double>& albedos, std::uint64_t memory_limit) {
  const auto read = [&](const std::string& name, int width, int height) {
    const FileRecord* record = find_record(run, name);
    if (!record) throw file_error(folder / name, "is not among the files that summary.json records");
    return read_map(folder, *record, width, height, memory_limit);
  };
  SavedTexels saved;
  saved.ambient_occlusion = read("ambient_occlusion.exr", 0, 0);
  const int width = saved.ambient_occlusion.width;
  const int height = saved.ambient_occlusion.height;
  // Memory for three maps, bounces as read and as kept, and the sums. The totals later take the place of the
  // sums.
  const std::uint64_t bytes_per_texel = 6 * sizeof(float) + (albedos.size() + 1) * sizeof(double);
  check_map_size(folder / "ambient_occlusion.exr", static_cast<std::uint64_t>(width),
                 static_cast<std::uint64_t>(height), bytes_per_texel, memory_limit);
  saved.sky_view_factor = read("sky_view_factor.exr", width, height);
  Sums sums(saved.sky_view_factor.size(), albedos.size());
  int bounces = 0;
  for (; find_record(run, bounce_file(bounces)); ++bounces) {
    const Map irradiance = read(bounce_file(bounces), width, height);
    sums.add(irradiance, bounces, albedos);
    if (bounces == 1) saved.first_bounce = irradiance;
  }
  for (std::size_t k = 0; k < albedos.size(); ++k) {
    Map total(width, height);
    for (std::size_t i = 0; i < total.size(); ++i) {
      total.values[i] = static_cast<float>(
          sums.weighted[k][i] + conserve_tail(sums.all[i], double{sums.last[i]}, bounces - 1, albedos[k]));
    }
    saved.totals.push_back(std::move(total));
  }
  return saved;
}

}  // namespace heightlight
