#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/closed_forms.h"
#include "heightlight/curves.h"

namespace heightlight {

/// The albedos at which forms are fitted and judged; ρ = 1 is checked beside them.
const std::vector<double>& judged_albedos();  ///< 0.1, 0.2 … 1.0

/// Texels of one map on a lattice, at most kMostTexels of them, in columns of one length.
struct TexelSample {
  std::vector<float> ambient_occlusion;
  std::vector<float> sky_view_factor;
  std::vector<float> blurred;              ///< W, as blur_seen makes it
  std::vector<float> seen;                 ///< n, solved for at kSeenAlbedo
  std::vector<std::vector<float>> totals;  ///< E/π [albedo][texel]

  std::size_t size() const { return sky_view_factor.size(); }
};
constexpr std::size_t kMostTexels = 65536;

/// One simulated map: what forms are fitted to and judged on.
struct JudgedMap {
  std::string name;      ///< of the folder, or of the file where that is not curves.csv
  std::string material;  ///< maps of one material are left out together
  BounceCurves over_alpha;
  BounceCurves over_sky;
  std::optional<double> expected_seen;  ///< s; from the summary beside the curves
  std::optional<double> measured_seen;
  std::optional<TexelSample> texels;  ///< where bounces were saved
  std::optional<double> deep_seen;    ///< t of those texels, by the default constants, as simulate says it
};

/// Reads CURVES.csv, and what else `simulate` left in its folder; of a `dataset.csv` every run, and what lies
/// in the folders of its runs. The material is the name of the heightmap (of the folder, where there is no
/// summary) up to its first `_`, `-` or `.`, without digits at its end. Throws Error naming the file that is
/// damaged, lacks a kind of AO, has fewer than two bounces or fewer than kFewestBins filled bins, or that
/// belongs to another run than those beside it.
std::vector<JudgedMap> read_judged_maps(const std::filesystem::path& curves_csv, std::uint64_t memory_limit);
constexpr std::size_t kFewestBins = 8;

/// Whether the map's samples resolve its surface: the n measured is within 5 % of what reciprocity asks for.
bool is_resolved(const JudgedMap& map);

/// What forms are told of one of the map's texels, which must have them, and of a bin over its kind of AO.
ModelInputs texel_inputs(const JudgedMap& map, std::size_t texel);
ModelInputs bin_inputs(const JudgedMap& map, const CurveBin& bin, AoKind kind);

/// Σ ρ^b E_b/π of a bin's means, with what comes after the last bounce by conservation.
double bin_total(const CurveBin& bin, double albedo);
/// Σ ρ^b E_b/π for b ≤ bounces alone.
double bin_partial_total(const CurveBin& bin, double albedo, int bounces);

}  // namespace heightlight
