#include "bake/map_text.h"

#include "heightlight/forms.h"

namespace heightlight {
namespace {

const char* definition(MaterialMap map, const BakeOptions& options) {
  switch (map) {
    case MaterialMap::ao:
      return options.uniform_ao
                 ? "ambient occlusion: share of the tangent hemisphere's solid angle that sees the sky, "
                   "(1/2pi) int V dw; 1 = open"
                 : "ambient occlusion, cosine weighted (sky view factor): (1/pi) int V cos(theta) dw; 1 = "
                   "open";
    case MaterialMap::multibounce:
      return options.light_channels > 0
                 ? "irradiance of all bounces over pi, under the light of the sidecar, at the albedo"
                 : "irradiance of all bounces over pi, under a sky of radiance 1, at the albedo; 1 = "
                   "unoccluded";
    case MaterialMap::direct:
      return "irradiance over pi of the sidecar's light, before any bounce";
    case MaterialMap::bent_normal:
      return options.bent_length
                 ? "bent normal, cosine weighted: unit vector along b = (1/pi) int V w cos(theta) dw; alpha: "
                   "its length 3/2 |b|, 1 = open"
                 : "bent normal, cosine weighted: unit vector along int V w cos(theta) dw";
    case MaterialMap::bent_cone:
      return "bent cone: axis along the cosine-weighted bent normal; alpha: half-angle by openness, "
             "acos sqrt(1 - A), A = (1/pi) int V cos(theta) dw";
    case MaterialMap::normal:
      return options.normal_strength == 1 ? "unit normal of the surface, from central differences"
                                          : "normal from central differences, slopes times the normal "
                                            "strength of the sidecar: not physical";
    case MaterialMap::ao_n:
      return kStoredPairMeaning;
    case MaterialMap::horizon:
      return "elevation of the horizon above the horizontal (at least the tangent plane's), toward azimuths "
             "that count as the channels say";
    case MaterialMap::sh:
      return "(1/pi) int V Ylm cos(theta) dw over the orthonormal real spherical harmonics (no "
             "Condon-Shortley "
             "phase, pole z): E/pi under a sky is the dot product with the sky's coefficients";
    case MaterialMap::height:
      return "height above the lowest sample, over the relief";
    case MaterialMap::specular_occlusion:
      return "specular occlusion: int V f cos(theta) dw over int f cos(theta) dw, f of GGX at the roughness "
             "and "
             "view of the sidecar; 1 = open; texels that face away are 1, or no number in files of floats";
    case MaterialMap::curvature:
      return "mean curvature of the heights' Gaussian mean, 1/world length: 1/R on a sphere, 0 flat, "
             "negative "
             "concave";
    case MaterialMap::convexity:
      return "mean curvature of the heights' Gaussian mean where it is convex, 1/world length; else 0";
    case MaterialMap::concavity:
      return "mean curvature of the heights' Gaussian mean where it is concave, 1/world length, positive; "
             "else "
             "0";
    case MaterialMap::cavity:
      return "height above the heights' Gaussian mean, over the Gaussian's standard deviation: 0 level with "
             "the surroundings, negative in crevices";
    case MaterialMap::displacement:
      return options.displacement_unit == DisplacementUnit::metre
                 ? "displacement from the midlevel of the sidecar along the flat surface's normal, in metres"
                 : "displacement from the midlevel of the sidecar along the flat surface's normal, in "
                   "centimetres";
    default:
      return facts_of(*definition_of(map)).formula;
  }
}

/// Whether a map is of what the sky sends, and so of what lies below the horizontal.
bool is_lit(MaterialMap map, const BakeOptions& options) {
  switch (map) {
    case MaterialMap::multibounce:
    case MaterialMap::direct:
      return options.light_channels == 0;
    case MaterialMap::normal:
    case MaterialMap::height:
    case MaterialMap::horizon:
    case MaterialMap::specular_occlusion:
    case MaterialMap::curvature:
    case MaterialMap::convexity:
    case MaterialMap::concavity:
    case MaterialMap::cavity:
    case MaterialMap::displacement:
      return false;
    default:
      return !definition_of(map) || map == MaterialMap::svf_tilted || map == MaterialMap::terrain_view_factor;
  }
}

}  // namespace

std::string map_text(MaterialMap map, const BakeOptions& options) {
  std::string text = definition(map, options);
  if (definition_of(map)) text.insert(0, std::string(to_string(map)) + ": ");
  if (definition_of(map) && !is_lit(map, options))
    text += "; h is the elevation of the horizon, means are over azimuths";
  const bool dark = is_lit(map, options) && options.below == BelowHorizontal::ground;
  return dark ? text + "; nothing shines below the horizontal" : text;
}

}  // namespace heightlight
