#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>

#include "heightlight/files.h"
#include "heightlight/synth.h"

namespace heightlight {

/// A benchmark map of `size` × `size` texels with open boundary and a relief of a tenth of its width. "brick"
/// and "fbm" are this project's own shapes; "ground054" is a real material, read from HEIGHTLIGHT_SHARED_DIR
/// and sampled down. Empty where that file is absent.
inline std::optional<Heightmap> make_bench_map(const std::string& name, int size) {
  Heightmap map;
  if (name == "ground054") {
    const auto path = std::filesystem::path(HEIGHTLIGHT_SHARED_DIR) / "data/material/Ground054_height16.png";
    if (!std::filesystem::exists(path)) return std::nullopt;
    const Heightmap whole = load_heightmap(path, {}, std::uint64_t{1} << 32).map;
    map.height = Image<float>(size, size);
    const int step = whole.height.width / size;
    for (int row = 0; row < size; ++row) {
      for (int column = 0; column < size; ++column)
        map.height(row, column) = whole.height(row * step, column * step);
    }
  } else {
    map.height = synthesize(name, size, 1);
    for (float& height : map.height.values) height *= 0.1F;
  }
  map.spacing = {1.0 / size, 1.0 / size};
  map.boundary = Boundary::open;
  return map;
}

}  // namespace heightlight
