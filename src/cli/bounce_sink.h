#pragma once

#include <vector>

#include "cli/simulation.h"
#include "heightlight/curves.h"
#include "heightlight/transport.h"
#include "io/staged_output.h"

namespace heightlight {

/// The bounces on their way: into curves, previews and, where asked, files.
class BounceSink {
 public:
  BounceSink(const Transport& transport, const Surface& surface, const SimulateOptions& options,
             StagedFolder& folder);

  /// Takes E_b/π at ρ = 1; b = 0, 1, 2 … in order.
  void take(int b, const TexelVector& irradiance);
  /// Takes what all later bounces bring together.
  void take_tail(const TexelVector& tail);

  /// The first bounces, for the eye.
  const std::vector<Map>& first() const { return first_; }
  /// Over α, and over A.
  std::vector<BounceCurves> curves() const { return {alpha_.curves(), sky_.curves()}; }
  const SeenSky& seen() const { return seen_; }
  double seconds() const { return seconds_; }  ///< spent on the curves

 private:
  const Surface& surface_;
  const SimulateOptions& options_;
  StagedFolder& folder_;
  const Map& sky_view_factor_;
  SeenSky seen_;
  CurveBuilder alpha_;
  CurveBuilder sky_;
  std::vector<Map> first_;
  double seconds_ = 0;
};

}  // namespace heightlight
