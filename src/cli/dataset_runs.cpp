#include "cli/dataset_runs.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/digits.h"
#include "cli/dataset_tables.h"
#include "cli/request.h"
#include "cli/user_message.h"
#include "files/file_record.h"
#include "files/image_file.h"
#include "files/json_file.h"
#include "files/projection_text.h"
#include "files/saved_run.h"
#include "heightlight/version.h"

namespace heightlight {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// The SHA-256 of a file, or why there is none.
struct Checksum {
  std::string sha256;
  std::string fault;
};

Checksum checksum_of(const fs::path& file) {
  try {
    return {sha256_of_file(file), ""};
  } catch (const Cancelled&) {
    throw;
  } catch (const Error& error) {
    return {"", user_message(error)};
  }
}

/// A shape is what its recipe and this version make of it; a file, what it holds.
Json describe_map(const ManifestMap& map, const Checksum& checksum, const LoadOptions& load) {
  Json content = checksum.sha256;
  if (map.is_shape()) content = {map.source, map.size, map.seed};
  Json json = {{"name", map.name}, {"file", map.file.filename().string()}, {"content", content}};
  if (const std::string projection = read_projection_text(map.file); !map.is_shape() && !projection.empty())
    json["projection"] = projection;
  json.update(describe_load_options(load));
  return json;
}

/// Only what the results depend on: the wanted error means nothing to rays.
Json describe_simulation(const SimulateOptions& options, const std::string& albedo) {
  const Accuracy accuracy = make_accuracy(options.visibility, options.run.seed);
  Json chosen = {{"error", accuracy.error}, {"azimuths", or_null(options.visibility.azimuths)}};
  if (options.visibility.by_rays()) chosen = {{"rays", accuracy.rays}};
  return {{"visibility", chosen}, {"seed", options.run.seed}, {"bounces", options.bounces},
          {"bins", options.bins}, {"albedo", albedo},         {"save_bounces", options.save_bounces}};
}

std::string name_run(const DatasetRun& run) {
  std::string name = run.map->name;
  if (run.relief_share) name += "_relief" + in_digits(*run.relief_share);
  if (run.boundary) name += std::string("_") + to_string(*run.boundary);
  if (!run.options->name.empty()) name += "_" + run.options->name;
  return run.key.empty() ? name : name + "-" + run.key.substr(0, kNameDigits);
}

LoadOptions load_options(const DatasetRun& run) {
  LoadOptions load = run.map->load;
  if (run.relief_share) {
    load.relief.reset();
    load.relief_share = run.relief_share;
  }
  if (run.boundary) load.boundary = run.boundary;
  return load;
}

void complete(DatasetRun& run, const fs::path& folder, const RunOptions& given, const Checksum& map,
              const Checksum& albedo) {
  SimulateOptions& simulate = run.simulate;
  simulate = run.options->simulate;
  const std::uint64_t seed = simulate.run.seed;
  simulate.run = given;
  simulate.run.seed = seed;
  simulate.map.load = load_options(run);
  simulate.map.path = run.map->is_shape() ? shapes_folder(folder) / (run.map->name + ".exr") : run.map->file;
  simulate.sha256 = map.sha256;
  simulate.albedo_sha256 = albedo.sha256;
  run.fault = map.fault.empty() ? albedo.fault : map.fault;
  if (run.fault.empty()) {
    const std::string reflectance = run.options->albedo_file.empty() ? simulate.albedo : albedo.sha256;
    const Json all = {{"version", HEIGHTLIGHT_VERSION},
                      {"map", describe_map(*run.map, map, simulate.map.load)},
                      {"options", describe_simulation(simulate, reflectance)}};
    run.key = simulate.key = request_key(all);
  }
  run.name = name_run(run);
  simulate.folder = runs_folder(folder) / run.name;
}

}  // namespace

fs::path runs_folder(const fs::path& folder) { return folder / "runs"; }
fs::path shapes_folder(const fs::path& folder) { return folder / "maps"; }

std::vector<DatasetRun> list_runs(const Manifest& manifest, const fs::path& folder, const RunOptions& given) {
  std::vector<Checksum> albedos;
  for (const ManifestOptions& options : manifest.options) {
    albedos.push_back(options.albedo_file.empty() ? Checksum{} : checksum_of(options.simulate.albedo));
  }
  std::vector<DatasetRun> runs;
  for (const ManifestMap& map : manifest.maps) {
    const Checksum checksum = map.is_shape() ? Checksum{} : checksum_of(map.file);
    for (const std::optional<double>& share : manifest.relief_shares) {
      for (const std::optional<Boundary>& boundary : manifest.boundaries) {
        for (std::size_t i = 0; i < manifest.options.size(); ++i) {
          DatasetRun run;
          run.map = &map;
          run.options = &manifest.options[i];
          run.relief_share = share;
          run.boundary = boundary;
          complete(run, folder, given, checksum, albedos[i]);
          runs.push_back(std::move(run));
        }
      }
    }
  }
  return runs;
}

bool is_done(const DatasetRun& run, bool with_plots) {
  if (!run.fault.empty()) return false;
  std::vector<std::string> wanted{"curves.csv", "ambient_occlusion.exr", "sky_view_factor.exr",
                                  "irradiance_total.exr"};
  if (with_plots) wanted.insert(wanted.end(), {"curves.svg", "curves.png"});
  for (int b = 0; run.simulate.save_bounces && b <= run.simulate.bounces; ++b)
    wanted.push_back(bounce_file(b));
  try {
    const nlohmann::json summary = read_json(run.simulate.folder / "summary.json");
    const auto files = parse_file_records(summary);
    if (!files || !summary.contains("key") || summary["key"] != run.key) return false;
    for (const std::string& name : wanted) {
      const auto has_name = [&](const FileRecord& file) { return file.name == name; };
      if (std::none_of(files->begin(), files->end(), has_name)) return false;
    }
    check_summary(run, summary);
    return std::all_of(files->begin(), files->end(),
                       [&](const FileRecord& file) { return is_as_recorded(run.simulate.folder, file); });
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception&) {
    return false;  // damaged from outside: made again
  }
}

}  // namespace heightlight
