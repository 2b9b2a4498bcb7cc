#include "fit/judged_map.h"

#include <algorithm>
#include <cmath>

#include "files/saved_run.h"
#include "heightlight/closed_forms.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "heightlight/transport.h"

namespace heightlight {
namespace {

std::string material_of(std::string name) {
  name = name.substr(0, name.find_first_of("_-."));
  const std::size_t letters = name.find_last_not_of("0123456789");
  return letters == std::string::npos ? name : name.substr(0, letters + 1);
}

/// `where` names the file, and the run where it has many.
const BounceCurves& find_kind(const std::string& where, const std::vector<BounceCurves>& curves,
                              AoKind kind) {
  for (const BounceCurves& one : curves) {
    if (one.kind != kind) continue;
    if (one.filled.front().bounces.size() < 2) {
      throw Error(where + ": holds no bounce after the direct irradiance");
    }
    if (one.filled.size() < kFewestBins) {
      throw Error(where + ": only " + std::to_string(one.filled.size()) + " bins of " + to_string(kind) +
                  " are filled; a fit takes " + std::to_string(kFewestBins));
    }
    return one;
  }
  throw Error(where + ": holds no curves over " + to_string(kind));
}

/// Every k-th row and column, k the least that leaves no more than kMostTexels.
TexelSample sample(const SavedTexels& saved, bool tiles) {
  const Map blurred = blur_seen(saved.sky_view_factor, tiles);
  const int width = saved.sky_view_factor.width;
  const int height = saved.sky_view_factor.height;
  int step = 1;
  const auto lattice = [&](int k) {
    return static_cast<std::size_t>((width + k - 1) / k) * static_cast<std::size_t>((height + k - 1) / k);
  };
  while (lattice(step) > kMostTexels) ++step;
  const auto seen_albedo = static_cast<std::size_t>(
      std::find(judged_albedos().begin(), judged_albedos().end(), kSeenAlbedo) - judged_albedos().begin());
  TexelSample texels;
  texels.totals.resize(saved.totals.size());
  for (int row = 0; row < height; row += step) {
    for (int column = 0; column < width; column += step) {
      if (std::isnan(saved.sky_view_factor(row, column))) continue;
      texels.ambient_occlusion.push_back(saved.ambient_occlusion(row, column));
      texels.sky_view_factor.push_back(saved.sky_view_factor(row, column));
      texels.blurred.push_back(blurred(row, column));
      texels.seen.push_back(seen_from_total(SkyViewFactor(saved.sky_view_factor(row, column)),
                                            saved.totals[seen_albedo](row, column),
                                            static_cast<float>(kSeenAlbedo))
                                .value);
      for (std::size_t k = 0; k < saved.totals.size(); ++k) {
        texels.totals[k].push_back(saved.totals[k](row, column));
      }
    }
  }
  return texels;
}

/// What the folder of a run's curves tells of it beside them.
void add_rest_of_run(const std::filesystem::path& curves_csv, std::uint64_t memory_limit, JudgedMap& map) {
  const std::optional<RunSummary> run = read_run_summary(curves_csv);
  if (!run) return;
  map.material = material_of(run->map);
  map.expected_seen = run->expected_seen;
  map.measured_seen = run->measured_seen;
  if (!has_saved_texels(*run)) return;
  map.texels =
      sample(read_saved_texels(curves_csv.parent_path(), *run, judged_albedos(), memory_limit), run->tiles);
  SeenMoments moments;
  for (std::size_t i = 0; i < map.texels->size(); ++i) {
    moments.add(SkyViewFactor(double{map.texels->sky_view_factor[i]}),
                SeenSkyViewFactor(double{map.texels->seen[i]}));
  }
  map.deep_seen = tune_deep_seen(moments).value;
}

}  // namespace

const std::vector<double>& judged_albedos() {
  static const std::vector<double> albedos{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0};
  return albedos;
}

std::vector<JudgedMap> read_judged_maps(const std::filesystem::path& curves_csv, std::uint64_t memory_limit) {
  const std::filesystem::path path = std::filesystem::absolute(curves_csv);
  const bool is_curves = path.filename() == "curves.csv";
  std::vector<JudgedMap> maps;
  for (const RunCurves& run : read_run_curves(curves_csv, memory_limit)) {
    JudgedMap& map = maps.emplace_back();
    map.name = !run.run.empty() ? run.run
               : is_curves      ? path.parent_path().filename().string()
                                : path.stem().string();
    const std::string where = curves_csv.string() + (run.run.empty() ? "" : ", run " + run.run);
    map.over_alpha = find_kind(where, run.curves, AoKind::ambient_occlusion);
    map.over_sky = find_kind(where, run.curves, AoKind::sky_view_factor);
    map.material = material_of(run.map.empty() ? map.name : run.map);
    add_rest_of_run(run.run.empty() ? path : path.parent_path() / "runs" / run.run / "curves.csv",
                    memory_limit, map);
  }
  return maps;
}

bool is_resolved(const JudgedMap& map) {
  return map.expected_seen && std::abs(*map.measured_seen - *map.expected_seen) <= 0.05 * *map.expected_seen;
}

ModelInputs texel_inputs(const JudgedMap& map, std::size_t texel) {
  const TexelSample& texels = *map.texels;
  ModelInputs inputs;
  inputs.ambient_occlusion = AmbientOcclusion(double{texels.ambient_occlusion[texel]});
  inputs.sky_view_factor = SkyViewFactor(double{texels.sky_view_factor[texel]});
  inputs.expected_seen = SeenSkyViewFactor(map.expected_seen.value_or(0));
  inputs.deep_seen = SeenSkyViewFactor(map.deep_seen.value_or(0));
  inputs.blurred = SeenSkyViewFactor(double{texels.blurred[texel]});
  inputs.seen = SeenSkyViewFactor(double{texels.seen[texel]});
  return inputs;
}

ModelInputs bin_inputs(const JudgedMap& map, const CurveBin& bin, AoKind kind) {
  ModelInputs inputs;
  if (kind == AoKind::ambient_occlusion) {
    inputs.ambient_occlusion = AmbientOcclusion(bin.ao_mean);
  } else {
    inputs.sky_view_factor = SkyViewFactor(bin.ao_mean);
  }
  inputs.expected_seen = SeenSkyViewFactor(map.expected_seen.value_or(0));
  inputs.deep_seen = SeenSkyViewFactor(map.deep_seen.value_or(0));
  return inputs;
}

double bin_partial_total(const CurveBin& bin, double albedo, int bounces) {
  double total = 0;
  double power = 1;
  for (std::size_t b = 0; b < bin.bounces.size() && static_cast<int>(b) <= bounces; ++b) {
    total += power * bin.bounces[b].mean;
    power *= albedo;
  }
  return total;
}

double bin_total(const CurveBin& bin, double albedo) {
  const int last = static_cast<int>(bin.bounces.size()) - 1;
  return bin_partial_total(bin, albedo, last) +
         conserve_tail(bin_partial_total(bin, 1, last), bin.bounces.back().mean, last, albedo);
}

}  // namespace heightlight
