#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bake/model_map.h"
#include "bake/sky_check.h"
#include "heightlight/bake.h"
#include "visibility/horizon_sky.h"

namespace heightlight {

/// Seconds that each step took.
struct BakeTimes {
  double visibility = 0;  ///< pilot, walks, links
  double bounces = 0;
  double check = 0;
  double output = 0;
};

/// All that is known of a surface before its maps are written: one visibility pass, from which every channel
/// of every map follows texel by texel.
struct Material {
  const Surface* surface = nullptr;
  HorizonSky sky;             ///< as far as the reach; empty maps where nothing was asked of it
  std::vector<Map> horizons;  ///< rad, per azimuth
  std::vector<Map> totals;    ///< E/π, per channel of the albedo
  Map whole_sky;              ///< A without a reach; empty unless ao_n is wanted
  Map model_n;                ///< n of ao_n

  std::optional<HorizonPlan> plan;  ///< of whatever walked
  bool has_links = false;
  std::uint64_t links = 0;
  std::uint64_t link_bytes = 0;
  int bounces = 0;
  std::optional<SkyCheck> sky_check;
  std::optional<HorizonCheck> total_check;
  std::vector<ModelError> model_errors;
  BakeTimes seconds;
};

/// Whether a map is to be written, alone or packed.
bool is_wanted(const BakeOptions& options, MaterialMap map);

/// Finds what the wanted maps need, and nothing else. `surface` must outlive the result; `name` is for
/// messages. Throws Error where the memory allowed is not enough.
Material find_material(const Surface& surface, const BakeOptions& options, const std::string& name);

}  // namespace heightlight
