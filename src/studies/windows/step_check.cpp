#include <algorithm>
#include <cmath>
#include <memory>

#include "bake/material.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "files/json_file.h"
#include "solve/sky_check.h"
#include "transport/horizon_check.h"
#include "window/paged_ground.h"
#include "windows/sky_maps.h"
#include "windows/steps.h"
#include "windows/work_check.h"
#include "windows/work_json.h"

namespace heightlight {
namespace {

/// What each thread keeps of each of some six maps.
std::uint64_t bytes_per_thread() { return kPagedBytes / 6 / static_cast<std::uint64_t>(thread_count()); }

/// Of the first round, or of the one that refines.
std::filesystem::path check_path(const Work& work, bool refined) {
  return work.task.folder / "check" / (refined ? "0001.json" : "0000.json");
}

/// A map of the work, value by value.
class PagedWindows {
 public:
  PagedWindows(WindowFolder folder, int k)
      : files_(std::move(folder), k), paged_(files_, bytes_per_thread()) {}
  PagedWindows(const PagedWindows&) = delete;
  PagedWindows& operator=(const PagedWindows&) = delete;

  /// 0 where it is missing.
  double at(std::size_t texel) const {
    const auto width = static_cast<std::size_t>(files_.width());
    const float value = paged_.at(static_cast<int>(texel / width), static_cast<int>(texel % width));
    return std::isnan(value) ? 0 : double{value};
  }

 private:
  WindowFiles files_;
  PagedMap paged_;
};

/// All that a surface tells but for samples and normals.
Surface header_of(const WorkFacts& facts) {
  Surface header;
  header.map = {.height = {},
                .base = facts.base,
                .spacing = facts.spacing,
                .boundary = facts.boundary,
                .curvature = facts.curvature,
                .curved_about_row = 0.5 * (facts.grid.map_height - 1),
                .curved_about_column = 0.5 * (facts.grid.map_width - 1)};
  header.map.height.width = facts.grid.map_width;
  header.map.height.height = facts.grid.map_height;
  header.lowest = facts.lowest;
  header.highest = facts.highest;
  return header;
}

MaximumPyramid bounds_of(const Work& work, const Surface& header) {
  if (header.cell_columns() == 0 || header.cell_rows() == 0) return {};
  return complete_maximum_pyramid(work.state.facts.first_coarse, read_whole(coarse_folder(work), 2),
                                  header.cell_columns(), header.cell_rows());
}

/// A of the receivers that classes of the check are made by.
std::vector<double> sample_of_check(const Work& work, const PagedWindows& sky, const StoredGround& ground,
                                    std::uint64_t seed) {
  const auto width = static_cast<std::size_t>(work.state.facts.grid.map_width);
  const auto texels = static_cast<std::int64_t>(width) * work.state.facts.grid.map_height;
  std::vector<double> sample;
  for (const std::size_t texel : SkyClasses::sample_texels(texels, seed)) {
    const float height = ground.height(static_cast<int>(texel / width), static_cast<int>(texel % width));
    if (!std::isnan(height)) sample.push_back(sky.at(texel));
  }
  return sample;
}

/// Of the total's channels.
std::vector<HorizonCheck> check_totals(const Work& work, const ExactWalker& walker,
                                       const StoredGround& ground) {
  const BakeOptions& options = work.task.options;
  const PagedWindows sky(lighting_folder(work), 0);
  const PagedWindows ambient(lighting_folder(work), 1);
  std::vector<std::unique_ptr<PagedWindows>> totals;
  FoundMaps found{.sky = [&sky](std::size_t i) { return sky.at(i); },
                  .ambient = [&ambient](std::size_t i) { return ambient.at(i); }};
  for (const std::size_t c : channels_at_hand(work)) {
    const StoredPlace place = total_place(work, c);
    const PagedWindows& total = *totals.emplace_back(std::make_unique<PagedWindows>(place.folder, place.k));
    const double albedo = options.albedo.constant[c];
    found.totals.push_back({.total = [&total](std::size_t i) { return total.at(i); },
                            .albedo = [albedo](std::size_t) { return albedo; }});
  }
  return check_found(walker, found, sample_of_check(work, sky, ground, options.seed + 5),
                     {.seed = options.seed, .error = options.error});
}

/// Of the sky's maps at some receivers.
std::optional<SkyCheck> check_maps(const Work& work, const ExactWalker& walker) {
  const BakeOptions& options = work.task.options;
  const int kept = kept_sky_count(sky_wanted(options));
  std::vector<std::unique_ptr<WindowFiles>> files;
  for (int k = 0; k < kept; ++k) files.push_back(std::make_unique<WindowFiles>(sky_folder(work), k));
  const auto maps_at = [&](int row, int column) {
    std::vector<Map> maps;
    for (const std::unique_ptr<WindowFiles>& map : files) {
      Map& one = maps.emplace_back(1, 1);
      map->read({row, column, 1, 1}, one.values.data());
    }
    HorizonSky sky = sky_of_maps(std::move(maps), options);
    return CheckedReceiver{.ambient_occlusion = sky.ambient_occlusion.values[0],
                           .sky_view_factor = sky.sky_view_factor.values[0],
                           .moments = std::move(sky.moments)};
  };
  return check_receivers_sky(
      walker, maps_at,
      {.maximum_distance = options.maximum_distance, .below = options.below, .seed = options.seed});
}

nlohmann::ordered_json to_json(const HorizonCheck& check) {
  return {{"receivers", check.receivers},       {"azimuths", check.azimuths},
          {"ambient_rmse", check.ambient_rmse}, {"sky_rmse", check.sky_rmse},
          {"total_rmse", check.total_rmse},     {"total_standard_error", check.total_standard_error}};
}

nlohmann::ordered_json to_json(const SkyCheck& check) {
  nlohmann::ordered_json json = {{"receivers", check.receivers},
                                 {"azimuths", check.azimuths},
                                 {"ambient_occlusion", check.ambient_occlusion},
                                 {"sky_view_factor", check.sky_view_factor}};
  if (check.bent_normal_rad) json["bent_normal_rad"] = *check.bent_normal_rad;
  if (check.harmonics) json["harmonics"] = *check.harmonics;
  return json;
}

SkyCheck sky_check_of(const nlohmann::json& json) {
  SkyCheck check{.receivers = json.at("receivers"),
                 .azimuths = json.at("azimuths"),
                 .ambient_occlusion = json.at("ambient_occlusion"),
                 .sky_view_factor = json.at("sky_view_factor")};
  if (json.contains("bent_normal_rad")) check.bent_normal_rad = json["bent_normal_rad"].get<double>();
  if (json.contains("harmonics")) check.harmonics = json["harmonics"].get<double>();
  return check;
}

std::vector<HorizonCheck> totals_of(const nlohmann::json& found) {
  std::vector<HorizonCheck> checks;
  for (const nlohmann::json& check : found.at("totals")) {
    checks.push_back({.receivers = check.at("receivers"),
                      .azimuths = check.at("azimuths"),
                      .ambient_rmse = check.at("ambient_rmse"),
                      .sky_rmse = check.at("sky_rmse"),
                      .total_rmse = check.at("total_rmse"),
                      .total_standard_error = check.at("total_standard_error")});
  }
  return checks;
}

}  // namespace

void check_receivers(Work& work) {
  const WorkFacts& facts = work.state.facts;
  const BakeOptions& options = work.task.options;
  const Surface header = header_of(facts);
  const WindowFiles heights(heights_folder(work), 0);
  const PagedGround ground(heights, facts.spacing, facts.boundary, bytes_per_thread());
  nlohmann::ordered_json found = {{"totals", nlohmann::ordered_json::array()}};
  if (total_channels(work) > 0) {
    const ExactWalker walker(header, azimuths_for_check(options.error), ground, bounds_of(work, header),
                             facts.first_coarse);
    for (const HorizonCheck& check : check_totals(work, walker, ground))
      found["totals"].push_back(to_json(check));
  }
  if (work.state.refined.empty()) {
    const ExactWalker walker(header, kSkyCheckAzimuths, ground, bounds_of(work, header), facts.first_coarse);
    if (const std::optional<SkyCheck> check = check_maps(work, walker)) found["sky"] = to_json(*check);
  }
  replace_json(check_path(work, !work.state.refined.empty()), found);
}

Evidence evidence_of_plan(const Work& work) {
  const BakeOptions& options = work.task.options;
  Evidence evidence;
  evidence.error_wanted = options.error;
  evidence.seed = options.seed;
  evidence.plan = work.state.plan;
  evidence.azimuths = work.state.plan->sky.walk.azimuths;
  evidence.gathers = work.state.gather;
  evidence.threads = thread_count();
  return evidence;
}

std::vector<HorizonCheck> read_total_checks(const Work& work) {
  std::vector<HorizonCheck> checks = totals_of(read_json(check_path(work, false)));
  if (work.state.refined.empty()) return checks;
  const std::vector<HorizonCheck> again = totals_of(read_json(check_path(work, true)));
  for (std::size_t i = 0; i < again.size(); ++i) {
    HorizonCheck& check = checks[work.state.refined[i]];
    check.total_rmse = again[i].total_rmse;
    check.total_standard_error = again[i].total_standard_error;
  }
  return checks;
}

Evidence read_evidence(const Work& work) {
  Evidence evidence = evidence_of_plan(work);
  evidence.refined = !work.state.refined.empty();
  const std::vector<HorizonCheck> checks = read_total_checks(work);
  if (!checks.empty()) {
    evidence.sky_rmse = checks[0].sky_rmse;
    evidence.total_checks.push_back(*std::max_element(
        checks.begin(), checks.end(),
        [](const HorizonCheck& a, const HorizonCheck& b) { return a.total_rmse < b.total_rmse; }));
  }
  const nlohmann::json found = read_json(check_path(work, false));
  if (found.contains("sky")) {
    evidence.sky_check = sky_check_of(found.at("sky"));
    if (!evidence.sky_rmse) evidence.sky_rmse = evidence.sky_check->sky_view_factor;
  }
  return evidence;
}

std::optional<SkyCheck> check_window_sky(const Work& work, const Material& material, const MapRect& window) {
  const WorkFacts& facts = work.state.facts;
  const BakeOptions& options = work.task.options;
  const Surface header = header_of(facts);
  const WindowFiles heights(heights_folder(work), 0);
  const PagedGround ground(heights, facts.spacing, facts.boundary, bytes_per_thread());
  const ExactWalker walker(header, kSkyCheckAzimuths, ground, bounds_of(work, header), facts.first_coarse);
  const WindowPlace place = place_in_map(*material.surface);
  const Results& results = material.results;
  const auto found = [&](int row, int column) {
    const std::size_t texel =
        material.surface->map.height.index(row - place.first_row, column - place.first_column);
    CheckedReceiver receiver{.ambient_occlusion = results.ambient_occlusion.values[texel],
                             .sky_view_factor = results.sky_view_factor.values[texel]};
    if (results.moments.first.size() > 0)
      receiver.moments.first = {1, 1, results.moments.first.values[texel]};
    if (results.moments.second.size() > 0)
      receiver.moments.second = {1, 1, results.moments.second.values[texel]};
    return receiver;
  };
  return check_receivers_sky(walker, found,
                             {.maximum_distance = options.maximum_distance,
                              .below = options.below,
                              .seed = options.seed,
                              .first_row = window.first_row,
                              .first_column = window.first_column,
                              .rows = window.rows,
                              .columns = window.columns,
                              .watch = options.watch});
}

}  // namespace heightlight
