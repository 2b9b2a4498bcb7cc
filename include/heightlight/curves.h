#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/transport.h"

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
  /// `ao` in [0, 1] up to rounding, NaN where missing; 1 ≤ bins ≤ 10000 (UsageError otherwise). At most 2³²
  /// texels.
  CurveBuilder(const Map& ao, AoKind kind, int bins);

  /// Adds the next bounce, E_b/π per texel of the map (ρ = 1), finite; whatever stands where AO is missing.
  void add(const Eigen::Ref<const Eigen::VectorXd>& irradiance);
  void add(const Eigen::Ref<const Eigen::VectorXf>& irradiance);

  /// Sets what all later bounces bring together, Σ E_b/π over b > K.
  void add_tail(const Eigen::Ref<const Eigen::VectorXd>& irradiance);
  void add_tail(const Eigen::Ref<const Eigen::VectorXf>& irradiance);

  const BounceCurves& curves() const { return curves_; }

 private:
  BounceCurves curves_;
  std::shared_ptr<const BinGroups> groups_;
};

/// The first line of `curves.csv`.
constexpr const char* kCurvesHeader = "ao_kind,bin,ao_lo,ao_hi,ao_mean,count,bounce,mean,stddev,p05,p50,p95";

/// Writes `curves.csv`: one line per kind, bin and bounce, in this order,
/// both kinds below each other, numbers with as many digits as a double needs. Throws Error naming the file.
void write_curves_csv(const std::filesystem::path& path, const std::vector<BounceCurves>& curves);

/// Reads such a file back: the columns by their names, in any order. The tail, which it does not hold, is
/// what the means leave of 1. Throws Error naming the file, and the line, for a column that is missing, a
/// number that is none or not finite, a kind of AO that is unknown or comes again after the other, bins out
/// of order or without texels, bounces that don't follow on each other or of which bins have unlike numbers.
std::vector<BounceCurves> read_curves_csv(const std::filesystem::path& path);

/// One relief of a study of the height amplitude.
struct ReliefCurves {
  double relief_share = 0;  ///< peak-to-valley height over the map's width
  BounceCurves curves;      ///< over α
};

/// How the study walks: fine enough that the error does not show among the curves.
const HorizonPlan& study_plan();

/// The notes' study of the height amplitude (file 004): curves over α of the map with its heights scaled so
/// that its relief is each share of its width (spacing × columns). Runs on a copy of at most `largest_side`
/// texels a side, which keeps the map's extent and boundary, since only the curves' shape is asked: every
/// n-th sample, or as near to it as a side that n does not divide allows. A level map stays level. Throws
/// UsageError for a share that is not positive and finite, largest_side < 1 or bounces < 0, and what
/// build_form_factors and CurveBuilder throw.
std::vector<ReliefCurves> study_reliefs(const Heightmap& map, const std::vector<double>& relief_shares,
                                        int largest_side, int bounces, int bins, bool quiet);

}  // namespace heightlight
