#include "shaders/gloss_functions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "heightlight/occlusion_forms.h"
#include "shaders/shader_literal.h"
#include "shaders/text_template.h"

namespace heightlight {
namespace {

constexpr const char* kConeSource = "Jimenez et al. 2016, eqs. 17, 22 and 23";

// Arguments
// --------------------------------------------------------------------------------------------------------

ShaderInput openness_input() { return {"sky", "A, the sky view factor: cosine weighted, the AO of GTAO"}; }

ShaderInput direction_input(const std::string& name, const std::string& meaning) {
  return {.name = name,
          .meaning = meaning,
          .components = 3,
          .low = -1,
          .high = 1,
          .is_clamped = false,
          .is_unit = true};
}

ShaderInput upward_input(const std::string& name, const std::string& meaning) {
  ShaderInput input = direction_input(name, meaning);
  input.is_above = true;
  return input;
}

ShaderInput axis_input() {
  return direction_input("axis", "the bent normal, in the axes of the sky's harmonics");
}

ShaderInput apart_input() {
  return {.name = "apart",
          .meaning = "angle between the bent normal and the mirrored view",
          .high = kPiOfForms,
          .is_clamped = false};
}

/// Narrower lobes are lost in the rounding of single precision.
constexpr float kNarrowestLobe = 0.005F;
constexpr float kNarrowestCone = 0.01F;

ShaderInput roughness_input(double low) {
  return {
      .name = "roughness", .meaning = "alpha of GGX, the square of what many engines call so", .low = low};
}

float clamp_roughness(float roughness, float low) { return std::clamp(roughness, low, 1.0F); }

ShaderInput view_cosine_input() {
  return {"view_cosine", "between the normal and the direction to the viewer"};
}

ShaderInput side_input() {
  return {.name = "side",
          .meaning = "values along each axis of the table",
          .low = 4,
          .high = 64,
          .is_clamped = false};
}

Direction<float> direction_of(const float* in) { return {in[0], in[1], in[2]}; }

void put(const Direction<float>& direction, float* out) {
  out[0] = direction.x;
  out[1] = direction.y;
  out[2] = direction.z;
}

// Diffuse irradiance under an uneven sky
// -----------------------------------------------------------------------------------

ShaderFunction cone_bands_function() {
  return {
      .name = "heightlight_cone_bands",
      .formula =
          "What a cone of visibility about the bent normal passes of the bands 0, 1, 2 of a sky's spherical "
          "harmonics: E/pi = x L0 + y L1 + z L2, where Ll is the sum over m of the sky's coefficients times "
          "its basis toward the bent normal",
      .source = kConeSource,
      .error =
          "RMSE of E/pi .0037 to .0219 under an overcast sky, .0577 to .1070 under a low sun, on four maps, "
          "with exact A and bent normals",
      .inputs = {openness_input()},
      .components = 3,
      .text = kConeBandsShader,
      .twin = "cone_bands",
      .evaluate =
          [](const float* in, float* out) {
            const std::array<float, 3> bands = cone_bands(SkyViewFactor<float>(in[0]));
            std::copy(bands.begin(), bands.end(), out);
          },
      .ulps = 2};
}

/// Makes the function for the coefficients from `first` on, `count` of them.
ShaderFunction cone_harmonics_function(const std::string& name, int first, int count, const char* text) {
  return {.name = name,
          .formula =
              std::string("The same as coefficient") +
              (count > 1 ? "s " + std::to_string(first) + " to " : " ") + std::to_string(first + count - 1) +
              " of nine real harmonics (Y00, Y1-1, Y10, Y11, Y2-2, Y2-1, Y20, Y21, Y22, orthonormal, without "
              "the Condon-Shortley phase): E/pi is their dot product with the sky's",
          .source = kConeSource,
          .error = "as heightlight_cone_bands",
          .inputs = {openness_input(), axis_input()},
          .components = count,
          .text = text,
          .twin = "cone_harmonics",
          .evaluate =
              [first, count](const float* in, float* out) {
                const NineHarmonics<float> all =
                    cone_harmonics(SkyViewFactor<float>(in[0]), direction_of(in + 1));
                std::copy_n(all.begin() + first, count, out);
              },
          .ulps = 2};
}

ShaderFunction directional_function() {
  return {.name = "heightlight_directional_irradiance",
          .formula =
              "E/pi of one channel under a sky of those nine coefficients, from a bent normal and its A: "
              "directional GTAO. Harmonics ring: it may be a little below 0",
          .source = "Jimenez et al. 2016, eqs. 16, 17, 22 and 23",
          .error = "as heightlight_cone_bands",
          .inputs = {{.name = "light_0_to_3",
                      .meaning = "the sky's coefficients",
                      .components = 4,
                      .low = -1,
                      .is_clamped = false},
                     {.name = "light_4_to_7",
                      .meaning = "the sky's coefficients",
                      .components = 4,
                      .low = -1,
                      .is_clamped = false},
                     {.name = "light_8", .meaning = "the sky's last", .low = -1, .is_clamped = false},
                     openness_input(),
                     axis_input()},
          .text = kDirectionalShader,
          .twin = "directional_irradiance",
          .evaluate =
              [](const float* in, float* out) {
                NineHarmonics<float> light{};
                std::copy_n(in, light.size(), light.begin());
                *out = directional_irradiance(light, SkyViewFactor<float>(in[9]), direction_of(in + 10));
              },
          .ulps = 8};
}

// What a lobe sees by cones
// ------------------------------------------------------------------------------------------

ShaderFunction shared_solid_angle_function() {
  const auto half_angle = [](const std::string& name) {
    return ShaderInput{.name = name, .meaning = "half-angle", .high = kPiOfForms / 2, .is_clamped = false};
  };
  return {.name = "heightlight_shared_solid_angle",
          .formula = "Solid angle that two cones share",
          .source = "",
          .error = "",
          .inputs =
              {half_angle("a"),
               half_angle("b"),
               {.name = "d", .meaning = "angle between their axes", .high = kPiOfForms, .is_clamped = false}},
          .text = kSharedSolidAngleShader,
          .twin = "shared_solid_angle",
          .evaluate =
              [](const float* in, float* out) {
                *out = static_cast<float>(shared_solid_angle<double>(in[0], in[1], in[2]));
              },
          .ulps = 256,
          .jumps = 1e-3};  // where hemispheres hardly meet, two angles near pi almost cancel
}

ShaderFunction cone_cone_function() {
  return {.name = "heightlight_cone_cone",
          .formula =
              "What a glossy lobe sees of an even sky: of the lobe's cone about the mirrored view, the share "
              "that the cone of openness about the bent normal covers",
          .source = "Jimenez et al. 2016, eqs. 34 and 35",
          .error = "RMSE 0.1015 to 0.1187 at roughness .13 from 45 degrees, on four maps",
          .inputs = {openness_input(), apart_input(), roughness_input(kNarrowestCone)},
          .text = fill_in(kConeConeShader, {{"share", shader_literal(LobeConeConstants{}.share)}}),
          .twin = "cone_cone_occlusion",
          .evaluate =
              [](const float* in, float* out) {
                *out = static_cast<float>(cone_cone_occlusion<double>(
                    SkyViewFactor<double>(in[0]), in[1], clamp_roughness(in[2], kNarrowestCone)));
              },
          .ulps = 4096};
}

ShaderFunction lagarde_function() {
  return {.name = "heightlight_lagarde",
          .formula = "What a glossy lobe sees of an even sky = (n.v + A)^(2^(-16 r - 1)) - 1 + A, in [0, 1]",
          .source = "Lagarde and de Rousiers 2014, listing 26",
          .error = "RMSE 0.2399 to 0.4252 at roughness .13 from 45 degrees, on four maps",
          .inputs = {openness_input(), view_cosine_input(), roughness_input(0)},
          .text = kLagardeShader,
          .twin = "lagarde_occlusion",
          .evaluate =
              [](const float* in, float* out) {
                *out = lagarde_occlusion(SkyViewFactor<float>(in[0]), clamp_share(in[1]), in[2]);
              },
          .ulps = 16};
}

// GTSO's table
// -----------------------------------------------------------------------------------------------------

ShaderFunction falloff_function() {
  return {.name = "heightlight_falloff",
          .formula = "How a lobe of GGX falls off across an edge. A part of table_place",
          .source = "",
          .error = "",
          .inputs = {{.name = "widths",
                      .meaning = "of the lobe, to the edge",
                      .low = -8,
                      .high = 8,
                      .is_clamped = false}},
          .text = kFalloffShader,
          .twin = "lobe_falloff",
          .evaluate = [](const float* in, float* out) { *out = lobe_falloff(in[0]); },
          .ulps = 4};
}

/// Angle of the view, in steps of the table.
double view_step(double view_cosine, double side) {
  return std::acos(clamp_share(view_cosine)) / (kPiOfForms / 2) * (side - 1);
}

/// The lower of the two steps between which the view lies.
double view_below(double view_cosine, double side) {
  return std::min(std::floor(view_step(view_cosine, side)), side - 2);
}

void place_in_table(const float* in, float* out) {
  const double half_angle = angle_of_cosine(cone_cosine(SkyViewFactor<double>(in[0])));
  const double roughness = clamp_roughness(in[2], kNarrowestLobe);
  const double side = in[4];
  const double layer = view_below(in[3], side) * side + std::sqrt(roughness) * (side - 1) + 0.5;
  const double y = TableApart<double>(half_angle, roughness).place(in[1]);
  out[0] = static_cast<float>((half_angle / (kPiOfForms / 2) * (side - 1) + 0.5) / side);
  out[1] = static_cast<float>((y * (side - 1) + 0.5) / side);
  out[2] = static_cast<float>(layer / (side * side));
  out[3] = static_cast<float>((layer + side) / (side * side));
}

/// Share of inputs for which the angle of the view is a step of the table, and rounding may put it on either
/// side.
constexpr double kSharesOfSteps = 5e-3;

std::vector<ShaderFunction> table_functions() {
  return {
      {.name = "heightlight_table_place",
       .formula =
           "Where the table of heightlight specular-table (gtso.ktx) is to be read, filtered linearly: "
           "what a glossy lobe sees of an even sky is the mix, by table_weight, of the table at xyz and "
           "at xyw",
       .source = "Jimenez et al. 2016, eq. 30",
       .error = "RMSE 0.0767 to 0.0901 at roughness .13 from 45 degrees, on four maps, of 16 values a side",
       .inputs = {openness_input(), apart_input(), roughness_input(kNarrowestLobe), view_cosine_input(),
                  side_input()},
       .components = 4,
       .text = kTablePlaceShader,
       .twin = "look_up",
       .evaluate = place_in_table,
       .ulps = 1024,
       .jumps = kSharesOfSteps},
      {.name = "heightlight_table_weight",
       .formula = "The weight of the second of both places",
       .source = "Jimenez et al. 2016, eq. 30",
       .error = "",
       .inputs = {view_cosine_input(), side_input()},
       .text = kTableWeightShader,
       .twin = "look_up",
       .evaluate =
           [](const float* in, float* out) {
             *out = static_cast<float>(view_step(in[0], in[1]) - view_below(in[0], in[1]));
           },
       .ulps = 2048,
       .jumps = kSharesOfSteps}};
}

// Stored horizons
// --------------------------------------------------------------------------------------------------

ShaderFunction lobe_weight_function() {
  return {
      .name = "heightlight_lobe_weight",
      .formula =
          "What a direction of a glossy lobe counts: Fresnel's factor, of a reflectance of .04 in "
          "Schlick's form, and the light's shadowing. A part of horizon_occlusion",
      .source = "Walter et al. 2007, eq. 34",
      .error = "",
      .inputs = {roughness_input(kNarrowestLobe),
                 {.name = "light_cosine", .meaning = "of the direction to the normal", .is_clamped = false},
                 {"facet_cosine", "of the direction to the microfacet"}},
      .text = kLobeWeightShader,
      .twin = "smith_shadowing",
      .evaluate =
          [](const float* in, float* out) {
            const double roughness = clamp_roughness(in[0], kNarrowestLobe);
            *out = static_cast<float>(schlick<double>(0.04, clamp_share(in[2])) *
                                      smith_shadowing<double>(roughness, in[1]));
          },
      .ulps = 4};
}

ShaderFunction lobe_direction_function() {
  return {.name = "heightlight_lobe_direction",
          .formula =
              "A direction into which GGX's visible normals mirror the view, and its cosine to the "
              "microfacet. A part of horizon_occlusion",
          .source = "Heitz 2018, section 3.2",
          .error = "",
          .inputs = {upward_input("view", "to the viewer, in axes whose z is the normal"),
                     roughness_input(kNarrowestLobe),
                     {.name = "u", .meaning = "a place in the unit square", .is_clamped = false},
                     {.name = "v", .meaning = "a place in the unit square", .is_clamped = false}},
          .components = 4,
          .text = kLobeDirectionShader,
          .twin = "mirror_visible_normal",
          .evaluate =
              [](const float* in, float* out) {
                const GgxDirection<float> light = mirror_visible_normal(
                    direction_of(in), clamp_roughness(in[3], kNarrowestLobe), in[4], in[5]);
                put(light.direction, out);
                out[3] = light.facet_cosine;
              },
          .ulps = 64,
          .jumps = 1e-3};  // at the disc's rim, where only rounding is left under a root
}

ShaderFunction frame_function(const std::string& name, const char* text,
                              Direction<float> NormalFrame<float>::*axis) {
  return {.name = name,
          .formula = "A direction in the surface, one of two that make a right-handed frame with its normal",
          .source = "Duff et al. 2017",
          .error = "",
          .inputs = {upward_input("normal", "of the surface")},
          .components = 3,
          .text = text,
          .twin = "NormalFrame",
          .evaluate = [axis](const float* in,
                             float* out) { put(NormalFrame<float>(direction_of(in)).*axis, out); },
          .ulps = 8};
}

constexpr int kPerVector = 4;

std::string slopes_name(int vector) { return "slopes" + std::to_string(vector); }

/// Inputs for stored horizons, four to a vector.
std::vector<ShaderInput> slope_inputs(int horizons) {
  std::vector<ShaderInput> inputs;
  for (int first = 0; first < horizons; first += kPerVector) {
    const int last = std::min(first + kPerVector, horizons) - 1;
    inputs.push_back({.name = slopes_name(first / kPerVector),
                      .meaning = "tangents of the horizon's elevation above the map's plane, toward the "
                                 "azimuths 2 pi k/" +
                                 std::to_string(horizons) + " from x to y, k = " + std::to_string(first) +
                                 " to " + std::to_string(last),
                      .components = kPerVector,
                      .low = -1,
                      .high = 3,
                      .is_clamped = false});
  }
  return inputs;
}

/// "vec4 slopes0, vec4 slopes1" with `before` as "vec4 ", or the names alone with it empty.
std::string list_slopes(int horizons, const std::string& before) {
  std::string list;
  for (int first = 0; first < horizons; first += kPerVector)
    list += (first == 0 ? "" : ", ") + before + slopes_name(first / kPerVector);
  return list;
}

/// Cosines or sines of four azimuths; 0 where there is no such horizon.
std::string azimuth_vector(int horizons, int first, double (*function)(double)) {
  std::string text = "vec4(";
  for (int k = first; k < first + kPerVector; ++k) {
    const double value = k < horizons ? function(2 * kPiOfForms * k / horizons) : 0;
    text += (k == first ? "" : ", ") + shader_literal(std::fabs(value) < 1e-12 ? 0 : value);
  }
  return text + ')';
}

std::vector<float> slopes_of(const float* in, int horizons) { return {in, in + horizons}; }

/// Between two stored horizons a and b, m sin(sector) = a sin(sector − φ) + b sin φ. Each horizon's weight in
/// this is the greater of 0 and sin(sector − |angle to it|), so that no azimuth need be found.
std::string horizon_above_text(int horizons) {
  const double sector = 2 * kPiOfForms / horizons;
  const std::string sine = shader_literal(std::sin(sector));
  std::string text = "float heightlight_horizon_above(vec3 d, " + list_slopes(horizons, "vec4 ") +
                     ") {\n  vec4 none = vec4(0.0, 0.0, 0.0, 0.0);\n  float rise = 0.0;\n";
  for (int first = 0; first < horizons; first += kPerVector) {
    const std::string number = std::to_string(first / kPerVector);
    const std::string x = 'x' + number;
    const std::string y = 'y' + number;
    text += "  vec4 " + x + " = " + azimuth_vector(horizons, first, std::cos) + ";\n  vec4 " + y + " = " +
            azimuth_vector(horizons, first, std::sin) + ";\n  rise += dot(" +
            slopes_name(first / kPerVector) + ", max(none, " + sine + " * (d.x * " + x + " + d.y * " + y +
            ") - " + shader_literal(std::cos(sector)) + " * abs(d.y * " + x + " - d.x * " + y + ")));\n";
  }
  return text + "  return " + sine + " * d.z - rise;\n}\n";
}

ShaderFunction horizon_above_function(int horizons) {
  std::vector<ShaderInput> inputs = slope_inputs(horizons);
  inputs.insert(inputs.begin(), direction_input("d", "a direction, z up"));
  return {.name = "heightlight_horizon_above",
          .formula =
              "How much a direction is above the horizon, not below 0 where it is. Between two stored "
              "horizons it is the great circle through both. A part of horizon_occlusion",
          .source = "",
          .error = "",
          .inputs = std::move(inputs),
          .text = horizon_above_text(horizons),
          .twin = "StoredHorizons",
          .evaluate =
              [horizons](const float* in, float* out) {
                const std::vector<double> slopes(in + 3, in + 3 + horizons);
                const StoredHorizons<double> stored(slopes.data(), slopes.size());
                *out = static_cast<float>(stored.above({in[0], in[1], in[2]}));
              },
          .ulps = 8};
}

ShaderFunction horizon_occlusion_function(int horizons) {
  std::vector<ShaderInput> inputs = slope_inputs(horizons);
  inputs.insert(inputs.begin(), {upward_input("normal", "of the surface, in the map's axes"),
                                 upward_input("view", "to the viewer, in the map's axes, above the surface"),
                                 roughness_input(kNarrowestLobe)});
  return {.name = "heightlight_horizon_occlusion",
          .formula = "What a glossy lobe sees of an even sky, straight from the horizon map: of " +
                     std::to_string(kHorizonSamples) +
                     " of GGX's visible normals, mirrored, those that are above the horizon",
          .source = "visible normals: Heitz 2018",
          .error = "RMSE 0.0345 to 0.0389 at roughness .13 from 45 degrees, on four maps, of 16 horizons",
          .inputs = std::move(inputs),
          .text = fill_in(kHorizonShader, {{"slopes", list_slopes(horizons, "vec4 ")},
                                           {"given", list_slopes(horizons, "")},
                                           {"samples", std::to_string(kHorizonSamples)}}),
          .twin = "horizon_occlusion",
          .evaluate =
              [horizons](const float* in, float* out) {
                const std::vector<float> slopes = slopes_of(in + 7, horizons);
                *out = horizon_occlusion(direction_of(in), direction_of(in + 3),
                                         clamp_roughness(in[6], kNarrowestLobe),
                                         StoredHorizons<float>(slopes.data(), slopes.size()));
              },
          .ulps = 256,
          .jumps = 0.02};  // directions that graze a horizon, views that graze the surface
}

}  // namespace

std::vector<ShaderFunction> gloss_functions(int horizons) {
  assert(horizons >= 3 && horizons <= 360);
  std::vector<ShaderFunction> functions{
      cone_bands_function(),
      cone_harmonics_function("heightlight_cone_sh_0_to_3", 0, 4, kConeHarmonicsShader[0]),
      cone_harmonics_function("heightlight_cone_sh_4_to_7", 4, 4, kConeHarmonicsShader[1]),
      cone_harmonics_function("heightlight_cone_sh_8", 8, 1, kConeHarmonicsShader[2]),
      directional_function(),
      shared_solid_angle_function(),
      cone_cone_function(),
      lagarde_function(),
      falloff_function()};
  for (ShaderFunction& function : table_functions()) functions.push_back(std::move(function));
  for (ShaderFunction& function : std::vector<ShaderFunction>{
           lobe_weight_function(), lobe_direction_function(),
           frame_function("heightlight_tangent", kTangentShader, &NormalFrame<float>::tangent),
           frame_function("heightlight_bitangent", kBitangentShader, &NormalFrame<float>::bitangent),
           horizon_above_function(horizons), horizon_occlusion_function(horizons)})
    functions.push_back(std::move(function));
  return functions;
}

}  // namespace heightlight
