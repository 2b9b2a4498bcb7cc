#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "transport/calibration_frames.h"
#include "transport/error_propagation.h"
#include "transport/map_gather.h"
#include "visibility/exact_walk.h"

namespace heightlight {

/// Bytes that the calibration of a map of that size holds, together with what it sees of `fields` fields.
std::uint64_t gather_calibration_bytes(int width, int height, std::uint64_t fields);

/// Receivers on which gathers are tried before the whole map gathers: blocks of receivers, in which the views
/// of some are known exactly. The error of sampling has a long tail along walls, so the blocks lie in many
/// places, with few receivers each.
class GatherCalibration {
 public:
  static constexpr int kExactAzimuths = 48;

  /// `surface` must outlive this object. The watch is told of the exact walks.
  GatherCalibration(const Surface& surface, const CalibrationOptions& options);

  bool empty() const { return exact_.empty(); }
  const Surface& surface() const { return surface_; }

  /// Finds what the exact receivers see of the surface at an albedo, by class of A; `sky` is A as it was
  /// found. Must be called before sampling_error.
  void see_classes(const Map& sky, double albedo);

  /// What one exact receiver sees of a field x: Σ F (`weight`) and Σ F x (`weighted`) along each azimuth.
  struct SeenField {
    std::array<double, kExactAzimuths> weight{};
    std::array<double, kExactAzimuths> weighted{};
    double own = 0;  ///< x at the receiver itself

    /// Mean of x seen along every `step`-th azimuth, from `first` on; `own` where nothing is seen.
    double mean(std::size_t first = 0, std::size_t step = 1) const;
  };

  /// Returns what each exact receiver sees of x.
  std::vector<SeenField> see_field(const Map& x) const;

  /// RMS over the receivers of the change of a total at the last step per change of A: the change of its
  /// direct irradiance, `direct_per_sky`, less the mean of the radiosity seen.
  double sky_effect(const std::vector<SeenField>& radiosity, double direct_per_sky) const;

  /// RMSE that sampling brings into a total. The error of one gather is (1 − A) times the difference between
  /// the mean of x that it sees and that of exact walks along the same azimuths; later gathers pass it on.
  /// `pyramid` holds x; `x` is what see_field returned for it.
  double sampling_error(const MapGather& gather, const FieldPyramid& pyramid,
                        const std::vector<SeenField>& x) const;

  /// RMSE of gathers of x along 2, 4, 8 and 16 azimuths, halved as azimuth_halvings says: the exact views
  /// along so many of their azimuths, against the same views along all azimuths.
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
  Watch watch_;  ///< reports nothing; asked whether to go on
  std::vector<TileFrame> blocks_;
  std::vector<ExactReceiver> exact_;
  std::vector<FoundError> seen_;  ///< of the exact receivers, with residuals of 0
};

}  // namespace heightlight
