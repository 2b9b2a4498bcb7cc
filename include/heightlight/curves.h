#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "heightlight/image.h"

namespace heightlight {

/// The two kinds of ambient occlusion. They are different quantities, and no function here takes one for the
/// other.
enum class AoKind {
  ambient_occlusion,  ///< α, the share of the solid angle, without weights
  sky_view_factor     ///< A, cosine weighted
};

/// Returns the name of the kind: "ambient_occlusion" or "sky_view_factor".
const char* to_string(AoKind kind);

/// Statistics of E_b/π at ρ = 1 over the texels of one bin. The percentiles are order statistics, linearly
/// interpolated at share × (count − 1). They are exact in bins of up to 2048 texels. In fuller bins they are
/// off by at most 1/65536 of the difference between the bin's greatest and least value.
struct BounceStatistics {
  double mean = 0;
  double stddev = 0;  ///< of the texels, not of the mean; the divisor is their number
  double p05 = 0;
  double p50 = 0;
  double p95 = 0;
};

/// One AO bin: the texels with ao_lo ≤ AO < ao_hi. The last bin includes 1.
struct CurveBin {
  int bin = 0;
  double ao_lo = 0;
  double ao_hi = 0;
  double ao_mean = 0;                     ///< mean AO of the texels in the bin
  std::size_t count = 0;                  ///< number of texels, > 0: empty bins are left out
  std::vector<BounceStatistics> bounces;  ///< of E_b/π, index b = 0 … K
  BounceStatistics tail;                  ///< of Σ E_b/π over b > K; set by CurveBuilder::add_tail
};

/// Bounce curves of one map over one kind of AO.
struct BounceCurves {
  AoKind kind = AoKind::ambient_occlusion;
  int bins = 100;
  std::vector<CurveBin> filled;  ///< bins in ascending order, each with as many bounces as were added
};

class BinGroups;

/// Sorts texels into AO bins once, then takes one bounce after another, so that bounce maps need not be kept.
/// It holds two bytes per texel, and two per filled bin for every 16384 texels. The statistics are the same
/// to the last bit for any number of threads.
class CurveBuilder {
 public:
  static constexpr std::size_t kBytesPerTexel = 2;

  /// `ao` is one AO per texel, in [0, 1] up to rounding, NaN where missing; at most 2³² − 1 texels. `bins` is
  /// the number of equal bins over [0, 1], from 1 to 10000; throws UsageError otherwise.
  CurveBuilder(const Map& ao, AoKind kind, int bins);

  /// Adds the statistics of the next bounce. `irradiance` is E_b/π at ρ = 1, one finite value per texel of
  /// the map. Values are ignored where AO is missing.
  void add(std::span<const double> irradiance);
  void add(std::span<const float> irradiance);

  /// Sets the statistics of the tail. `irradiance` is Σ E_b/π over b > K at ρ = 1, one finite value per
  /// texel.
  void add_tail(std::span<const double> irradiance);
  void add_tail(std::span<const float> irradiance);

  /// Returns the curves of all bounces added so far.
  const BounceCurves& curves() const { return curves_; }

 private:
  BounceCurves curves_;
  std::shared_ptr<const BinGroups> groups_;
};

}  // namespace heightlight
