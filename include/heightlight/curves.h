#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "heightlight/image.h"

namespace heightlight {

/// The two ambient occlusions are different quantities; nothing here takes one for the other.
enum class AoKind {
  ambient_occlusion,  ///< α, a plain share of solid angle
  sky_view_factor     ///< A, cosine weighted
};

/// "ambient_occlusion" or "sky_view_factor".
const char* to_string(AoKind kind);

/// How E_b/π (ρ = 1) is spread over the texels of one bin. The percentiles are order statistics, linearly
/// interpolated at share × (count − 1): exact in bins of up to 2048 texels; in fuller ones off by at most
/// 1/65536 of the difference between the bin's greatest and least value.
struct BounceStatistics {
  double mean = 0;
  double stddev = 0;  ///< of the texels (divided by their number), not of the mean
  double p05 = 0;
  double p50 = 0;
  double p95 = 0;
};

/// The texels with ao_lo ≤ AO < ao_hi (the last bin includes 1).
struct CurveBin {
  int bin = 0;
  double ao_lo = 0;
  double ao_hi = 0;
  double ao_mean = 0;                     ///< of the bin's own texels
  std::size_t count = 0;                  ///< > 0: empty bins are absent
  std::vector<BounceStatistics> bounces;  ///< [b], b = 0 … K
  BounceStatistics tail;                  ///< Σ E_b/π over b > K; filled by CurveBuilder::add_tail
};

/// Bounce curves of one map over one kind of AO.
struct BounceCurves {
  AoKind kind = AoKind::ambient_occlusion;
  int bins = 100;
  std::vector<CurveBin> filled;  ///< ascending; each with as many bounces as were added
};

class BinGroups;

/// Sorts texels into AO bins once, then takes bounce after bounce; bounce maps need not be kept. Holds two
/// bytes per texel, and two per filled bin for every 16384 texels. Statistics are the same to the last bit
/// for any number of threads.
class CurveBuilder {
 public:
  static constexpr std::size_t kBytesPerTexel = 2;

  /// `ao` in [0, 1] up to rounding, NaN where missing; 1 ≤ bins ≤ 10000 (UsageError otherwise). At most 2³²
  /// texels.
  CurveBuilder(const Map& ao, AoKind kind, int bins);

  /// Adds the next bounce, E_b/π per texel of the map (ρ = 1), finite; whatever stands where AO is missing.
  void add(std::span<const double> irradiance);
  void add(std::span<const float> irradiance);

  /// Sets what all later bounces bring together, Σ E_b/π over b > K.
  void add_tail(std::span<const double> irradiance);
  void add_tail(std::span<const float> irradiance);

  const BounceCurves& curves() const { return curves_; }

 private:
  BounceCurves curves_;
  std::shared_ptr<const BinGroups> groups_;
};

}  // namespace heightlight
