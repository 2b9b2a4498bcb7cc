#include <algorithm>
#include <system_error>

#include "bake/texture_files.h"
#include "windows/sky_maps.h"
#include "windows/windowed_bake.h"
#include "windows/work_check.h"

namespace heightlight {
namespace {

/// The first channel of each texture, and behind the last the number of all: where their maps are in the
/// files.
std::vector<int> first_channels(const std::vector<BakedTexture>& textures) {
  std::vector<int> first{0};
  for (const BakedTexture& texture : textures)
    first.push_back(first.back() + static_cast<int>(texture.channels.size()));
  return first;
}

/// Rows of a texture, from the files of its windows.
FillRows stored_rows(const WindowFolder& folder, int first_channel, int channels) {
  std::vector<WindowFiles> maps;
  for (int c = 0; c < channels; ++c) maps.emplace_back(folder, first_channel + c);
  return [maps](int first, int rows, float* samples) {
    const int width = maps[0].width();
    std::vector<float> channel(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width));
    for (std::size_t c = 0; c < maps.size(); ++c) {
      maps[c].read({first, 0, rows, width}, channel.data());
      for (std::size_t i = 0; i < channel.size(); ++i) samples[i * maps.size() + c] = channel[i];
    }
  };
}

/// A material without values, for what its textures are called and mean, and what the sidecar tells.
struct HollowMaterial {
  Surface surface;
  Material material;

  explicit HollowMaterial(const Work& work) {
    const WorkFacts& facts = work.state.facts;
    surface.map = {.height = {},
                   .base = facts.base,
                   .spacing = facts.spacing,
                   .boundary = facts.boundary,
                   .curvature = facts.curvature};
    surface.map.height.width = facts.grid.map_width;
    surface.map.height.height = facts.grid.map_height;
    surface.lowest = facts.lowest;
    surface.highest = facts.highest;
    material.surface = &surface;
    material.totals.resize(total_channels(work));
    material.results.horizons.resize(static_cast<std::size_t>(
        is_wanted(work.task.options, MaterialMap::horizon) ? work.task.options.horizon_azimuths : 0));
    material.results.evidence = read_evidence(work);
  }
  HollowMaterial(const HollowMaterial&) = delete;  // the material refers to the surface
  HollowMaterial& operator=(const HollowMaterial&) = delete;
};

}  // namespace

BakeOutcome write_windowed(Work& work, const BakeTarget& target) {
  const WorkFacts& facts = work.state.facts;
  const HollowMaterial hollow(work);
  const BakedMap map{.material = hollow.material,
                     .header = hollow.surface.map,
                     .relief = double{facts.highest} - double{facts.lowest},
                     .missing = facts.missing,
                     .sha256 = facts.sha256,
                     .place = facts.place,
                     .warnings = facts.warnings};
  const std::vector<BakedTexture> textures = baked_textures(hollow.material, work.task.options);
  const std::vector<int> first = first_channels(textures);
  const WindowFolder folder = textures_folder(work);
  BakeOutcome outcome = write_textures(
      map, textures, [&](std::size_t t) { return stored_rows(folder, first[t], first[t + 1] - first[t]); },
      work.task.options, target);
  std::error_code ignored;
  std::filesystem::remove_all(work.task.folder, ignored);
  return outcome;
}

}  // namespace heightlight
