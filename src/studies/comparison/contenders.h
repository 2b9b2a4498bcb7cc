#pragma once

#include <functional>
#include <string>
#include <vector>

#include "comparison/reference.h"
#include "heightlight/closed_forms.h"
#include "heightlight/screenspace.h"

namespace heightlight {

/// What a method finds; what it has no word for is 0 × 0 or absent.
struct Estimate {
  Map sky_view_factor;
  Map ambient_occlusion;
  Image<Vector3> bent_normal;
  Map seen;                 ///< n, the mean sky view factor of what a texel sees
  std::vector<Map> totals;  ///< E/π per albedo
  double samples_per_texel = 0;
};

/// A method with its parameters, ready to run on the surface that it was made for.
struct Contender {
  std::string method;
  std::string parameters;
  bool shown = false;           ///< its errors are drawn, and those of closed forms on it
  std::string role = {};        ///< what it stands for at the head of the report; empty: it is not there
  bool finds_occlusion = true;  ///< given no albedos
  int directions = 0;           ///< per texel, of those in Jimenez et al. 2016, figure 5; 0 of others
  bool finds_totals = false;    ///< of the albedos that it is given, beside its occlusion if it has one
  std::function<void()> prepare = {};  ///< to be called before it is timed, where it is not empty
  std::function<Estimate(const std::vector<ComparedAlbedo>& albedos)> run = {};
  double sky_solid_angle = 0;  ///< sr, that it wants a sky averaged over; 0: it finds no light of a sky
  std::function<Image<Vector3>(const SkyGrid& sky)> run_under_sky = {};  ///< then empty
};

/// What contenders work on; all of it must outlive them.
struct ComparedScene {
  const Surface& surface;
  const DepthBuffer& depth;
  const std::vector<ComparedAlbedo>& albedos;
  const Map* far_field =
      nullptr;  ///< baked A of what is far (bake_far_field); null: nothing is tried with it
  std::vector<ClosedForm> forms = closed_forms();  ///< that are tried on AO
  std::uint64_t memory = ~0ULL;                    ///< bytes that a method may take
  std::uint64_t seed = 1;
};

/// Rays, horizon walks fixed and planned, and the table of screen-space methods.
std::vector<Contender> make_contenders(const ComparedScene& scene);

/// Names of the methods that are shown, in that order, without running any.
std::vector<std::string> shown_methods();

}  // namespace heightlight
