#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "transport/calibration_frames.h"
#include "transport/error_propagation.h"
#include "transport/map_gather.h"
#include "visibility/exact_walk.h"

namespace heightlight {

/// Bytes that a calibration of such a map holds, and what it sees of so many fields.
std::uint64_t gather_calibration_bytes(int width, int height, std::uint64_t fields);

/// Receivers on which gathers are tried before the whole map gathers: blocks, and in them some whose views
/// are known exactly. What sampling costs has a long tail along walls: they lie in many places, of few
/// receivers each.
class GatherCalibration {
 public:
  static constexpr int kExactAzimuths = 48;

  /// `surface` must outlive it. The watch hears of the exact walks.
  GatherCalibration(const Surface& surface, const CalibrationOptions& options);

  bool empty() const { return exact_.empty(); }
  const Surface& surface() const { return surface_; }

  /// What the exact receivers see of the surface at an albedo, by its A: `sky` as it was found. Once known,
  /// gathers can be tried.
  void see_classes(const Map& sky, double albedo);

  /// Of an exact receiver: form factors along each azimuth, and Σ F x.
  struct SeenField {
    std::array<double, kExactAzimuths> weight{};
    std::array<double, kExactAzimuths> weighted{};
    double own = 0;  ///< x where it is

    /// Mean of x seen along every so many-th azimuth; its own where nothing is.
    double mean(std::size_t first = 0, std::size_t step = 1) const;
  };

  /// Of each exact receiver.
  std::vector<SeenField> see_field(const Map& x) const;

  /// RMS of what a total changes by at the last step for a change of 1 of A: what its direct irradiance does,
  /// less the mean of the radiosity seen.
  double sky_effect(const std::vector<SeenField>& radiosity, double direct_per_sky) const;

  /// RMSE that sampling brings into a total: one gather's, of (1 − A) × the mean of x seen against exact
  /// walks along the same azimuths, and what later gathers make of that. `pyramid` holds x, as seen.
  double sampling_error(const MapGather& gather, const FieldPyramid& pyramid,
                        const std::vector<SeenField>& x) const;

  /// What 2, 4, 8 and 16 azimuths cost a gather of x: the same along so many of the exact azimuths, against
  /// all of them, where they are halved as azimuth_halvings says.
  static constexpr std::size_t kAzimuthTrials = 4;
  using AzimuthTrials = std::array<double, kAzimuthTrials>;
  AzimuthTrials azimuth_errors(const std::vector<SeenField>& x) const;

 private:
  struct ExactReceiver {
    std::size_t texel = 0;
    std::size_t block = 0;
    std::size_t in_block = 0;  ///< row by row
    SliceView view;
  };

  double surface_share(std::size_t receiver) const { return 1 - exact_[receiver].view.sky_view_factor; }

  const Surface& surface_;
  Watch watch_;  ///< is told nothing, and asked whether to go on
  std::vector<TileFrame> blocks_;
  std::vector<ExactReceiver> exact_;
  std::vector<FoundError> seen_;  ///< of the exact receivers: without what they find wrong
};

}  // namespace heightlight
