#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "files/file_record.h"
#include "fit/bootstrap.h"
#include "fit/bounce_fits.h"
#include "fit/bounce_ratios.h"
#include "fit/cross_validation.h"
#include "fit/cubic_by_albedo.h"
#include "fit/floors.h"

namespace heightlight {

/// One family, fitted to all maps.
struct FittedFamily {
  const FormFamily* family = nullptr;
  LeastSquaresFit fit;
  ParameterIntervals intervals = {};
  double published_rms = 0;  ///< of the family at its published parameters, over the same points
};

/// Everything that a fit of maps found out.
struct FitReport {
  std::vector<std::filesystem::path> inputs;  ///< the file of each map's curves, as given
  std::vector<JudgedMap> maps;
  TrialForms forms;
  std::vector<FittedFamily> families;
  std::vector<AlbedoCubic> cubics_three_bounces;
  std::vector<AlbedoCubic> cubics_all_bounces;
  std::vector<BounceFit> bounce_fits;
  std::vector<BounceRatios> ratios;  ///< per map
  CrossValidation trial;
  std::vector<Floor> floors;
  std::uint64_t seed = 1;
  std::vector<FileRecord> files = {};  ///< that the folder holds beside models.json
};

/// The family of that name; nullptr where it could not be fitted.
const FittedFamily* find_family(const FitReport& report, const std::string& name);

/// models.json: inputs, families with covariance and intervals, errors, floors.
std::string report_json(const FitReport& report);

/// models.csv: model,fitted,unit,albedo,rms,bias,max, and floors as models of their own. `unit` is texel,
/// bin, or texel_resolved (maps that their samples resolve).
std::string report_csv(const FitReport& report);

/// Why fits land elsewhere than what is published, by what can be measured: the same fits by the notes' own
/// conventions (bins of equal weight, tabulated at i/100), to each map alone, and to three bounces.
std::vector<std::string> explain_distances(const FitReport& report);

/// ratios.csv: map,alpha,texels,tau,tau_published, then the ratios E2/E1 … of each bin; empty where there is
/// none.
std::string ratios_csv(const FitReport& report);

}  // namespace heightlight
