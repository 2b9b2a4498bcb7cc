#pragma once

#include <optional>
#include <vector>

#include "cli/simulation.h"
#include "cli/simulation_files.h"
#include "files/image_file.h"
#include "files/staged_output.h"
#include "heightlight/curves.h"
#include "heightlight/solve.h"
#include "report/preview.h"

namespace heightlight {

/// The bounces on their way: into curves, previews and, where asked, files.
class SimulationSink : public BounceSink {
 public:
  /// All four must outlive it. Throws UsageError for an obscurance that passes half of a tiling map.
  SimulationSink(const Surface& surface, const Albedo& albedo, const SimulateOptions& options,
                 const MapFolder& output);

  void take_sky(const Map& ambient_occlusion, const Map& sky_view_factor) override;
  void take_links(const FormFactors& form_factors) override;
  void take_bounce(int b, const TexelVector& irradiance) override;
  void take_tail(const TexelVector& tail) override;

  /// The first bounces, for the eye.
  const std::vector<Image<Rgb8>>& first() const { return first_; }
  /// The same for the report, where that is wanted.
  const std::vector<Preview>& reported() const { return reported_; }
  /// Over α, and over A.
  std::vector<BounceCurves> curves() const { return {alpha_->curves(), sky_->curves()}; }

  /// Bytes that it holds for each texel.
  static std::uint64_t bytes_per_texel();

 private:
  const Surface& surface_;
  const Albedo& albedo_;
  const SimulateOptions& options_;
  const MapFolder& output_;
  std::optional<MaximumDistance> maximum_distance_;  ///< of the obscurance, where that is asked for
  std::optional<CurveBuilder> alpha_;
  std::optional<CurveBuilder> sky_;
  std::vector<Image<Rgb8>> first_;
  std::vector<Preview> reported_;
};

}  // namespace heightlight
