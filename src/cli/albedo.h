#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "heightlight/surface.h"
#include "heightlight/transport.h"

namespace heightlight {

/// Diffuse reflectance in [0, 1]: one channel where it is grey, else R, G, B.
struct Albedo {
  std::vector<double> constant;      ///< per channel; empty where it varies over the map
  std::vector<TexelVector> varying;  ///< per channel; empty where it is constant

  std::size_t channels() const { return constant.size() + varying.size(); }
};

/// Reads `--albedo R`, `--albedo R,G,B` or `--albedo FILE`. A file has the map's size; integer samples are
/// decoded from sRGB, float samples are linear already; equal channels become one. Throws UsageError for
/// values outside [0, 1] or something that is neither, Error naming the file for one of another size or with
/// samples outside [0, 1] or NaN.
Albedo read_albedo(const std::string& text, const Surface& surface, std::uint64_t memory_limit);

}  // namespace heightlight
