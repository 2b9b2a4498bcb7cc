#include "bake/material.h"

#include <algorithm>
#include <chrono>
#include <numbers>

#include "core/byte_size.h"
#include "heightlight/error.h"
#include "transport/horizon_pilot.h"
#include "transport/horizon_plan.h"

namespace heightlight {
namespace {

/// Of the error wanted, what ending the bounces may take.
constexpr double kBounceShare = 0.2;

/// Of the error wanted, that A may have where moments are wanted too: at an RMSE of 0.002 bent normals err by
/// 0.1 to 0.4 degrees, and at most by 0.3 at this share of it (brick walls; other maps by half of that).
constexpr double kMomentShare = 0.6;

/// Calls work() and returns the seconds that it took.
template <class Work>
double seconds_of(Work&& work) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  work();
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What has to be found.
struct Needs {
  bool sky = false;  ///< shares and moments, as far as the reach
  SkyWanted moments;
  bool bounces = false;
  bool model = false;
  bool horizons = false;

  bool transport() const { return bounces || model; }
};

Needs find_needs(const BakeOptions& options) {
  const auto wanted = [&](MaterialMap map) { return is_wanted(options, map); };
  Needs needs;
  needs.moments.second = wanted(MaterialMap::sh);
  needs.moments.first =
      needs.moments.second || wanted(MaterialMap::bent_normal) || wanted(MaterialMap::bent_cone);
  needs.sky = needs.moments.first || wanted(MaterialMap::ao);
  needs.bounces = wanted(MaterialMap::multibounce);
  needs.model = wanted(MaterialMap::ao_n);
  needs.horizons = wanted(MaterialMap::horizon);
  return needs;
}

/// Bytes per texel beside links, at the moment when most is held.
std::uint64_t bytes_per_texel(const Needs& needs, const BakeOptions& options) {
  constexpr std::uint64_t kSurface = 4 + 12 + 4;  // heights, normals, mips
  std::uint64_t bytes = kSurface + horizon_sky_bytes(needs.moments);
  if (needs.horizons) bytes += 4 * static_cast<std::uint64_t>(options.horizon_azimuths);
  if (!needs.transport()) return bytes + 12;
  // The direct light, bounces and their sum, mips of what is gathered, the check's albedo and radiosity.
  constexpr std::uint64_t kGathers = 62;
  const std::size_t varying = options.albedo.varying.size();
  const std::size_t totals =
      (needs.bounces ? options.albedo.channels() : 0) + (needs.model ? checked_albedos().size() : 0);
  return bytes + kGathers + 8 * (totals + varying) + (needs.bounces && varying > 0 ? 64 : 0);
}

std::uint64_t memory_for_links(const Surface& surface, const Needs& needs, const BakeOptions& options,
                               const std::string& name) {
  const std::uint64_t needed = surface.map.height.size() * bytes_per_texel(needs, options);
  if (needed < options.memory) return options.memory - needed;
  throw Error(name + ": baking " + std::to_string(surface.width()) + " × " +
              std::to_string(surface.height()) + " texels needs " + format_byte_size(needed) +
              ", more than the " + format_byte_size(options.memory) + " allowed by --memory");
}

HorizonGoal goal_of(const BakeOptions& options, bool total_only, bool moments) {
  return {options.error, total_only, options.azimuths, options.seed, moments ? kMomentShare : 1};
}

/// E/π at every constant albedo asked for: those of the bounces, then those that judge the model.
void find_totals(const Transport& transport, const Needs& needs, const BakeOptions& options,
                 std::vector<TexelVector>& totals, std::vector<TexelVector>& judged, Material& material) {
  std::vector<double> albedos;
  if (needs.bounces) albedos = options.albedo.constant;
  const std::size_t own = albedos.size();
  if (needs.model) albedos.insert(albedos.end(), checked_albedos().begin(), checked_albedos().end());
  if (!albedos.empty()) {
    TotalIrradiance solved = solve_totals(transport, albedos, kBounceShare * options.error, options.quiet);
    material.bounces = solved.bounces;
    for (std::size_t i = 0; i < albedos.size(); ++i) {
      (i < own ? totals : judged).push_back(std::move(solved.totals[i]));
    }
  }
  if (!needs.bounces) return;
  for (const TexelVector& albedo : options.albedo.varying) {
    totals.push_back(
        solve_equilibrium(transport, transport.direct, albedo, transport.direct, options.quiet).irradiance);
  }
}

/// By exact walks, of the channel that reflects most.
void check_totals(const Transport& transport, const BakeOptions& options,
                  const std::vector<TexelVector>& totals, Material& material) {
  const auto& constant = options.albedo.constant;
  std::size_t brightest = 0;
  TexelVector albedo;
  if (!constant.empty()) {
    brightest =
        static_cast<std::size_t>(std::max_element(constant.begin(), constant.end()) - constant.begin());
    albedo = TexelVector::Constant(totals[brightest].size(), constant[brightest]);
  } else {
    const auto& varying = options.albedo.varying;
    for (std::size_t i = 0; i < varying.size(); ++i) {
      if (varying[i].sum() > varying[brightest].sum()) brightest = i;
    }
    albedo = varying[brightest];
  }
  const HorizonCheck check =
      check_by_exact_walks(*material.surface, transport, totals[brightest], albedo, options.seed);
  if (check.receivers > 0) material.total_check = check;
}

void find_model(const Transport& transport, const std::vector<TexelVector>& judged, Material& material) {
  const std::vector<double>& albedos = checked_albedos();
  const auto fitted =
      static_cast<std::size_t>(std::find(albedos.begin(), albedos.end(), kSeenAlbedo) - albedos.begin());
  material.whole_sky = transport.sky_view_factor;
  material.model_n = fit_model_map(material.whole_sky, judged[fitted]);
  for (std::size_t i = 0; i < albedos.size(); ++i) {
    material.model_errors.push_back(
        judge_model_map(material.whole_sky, material.model_n, judged[i], albedos[i]));
  }
}

/// The pass with links; the sky comes with it, unless that ends at a reach.
void find_light(const Needs& needs, const BakeOptions& options, std::uint64_t link_memory,
                Material& material) {
  const Surface& surface = *material.surface;
  const bool keeps_sky = needs.sky && !options.reach;
  PlannedTransport planned;
  material.seconds.visibility += seconds_of([&] {
    const bool total_only = !keeps_sky && !needs.model;
    planned = plan_horizon_transport(surface, goal_of(options, total_only, keeps_sky && needs.moments.first),
                                     {link_memory, options.quiet}, keeps_sky ? needs.moments : SkyWanted{});
  });
  Transport& transport = *planned.transport;
  material.plan = planned.plan;
  material.has_links = true;
  material.links = transport.link_count();
  material.link_bytes = transport.bytes();
  std::vector<TexelVector> totals;
  std::vector<TexelVector> judged;
  material.seconds.bounces =
      seconds_of([&] { find_totals(transport, needs, options, totals, judged, material); });
  material.seconds.check += seconds_of([&] {
    if (needs.bounces) check_totals(transport, options, totals, material);
    if (needs.model) find_model(transport, judged, material);
  });
  for (TexelVector& total : totals) {
    material.totals.push_back(to_map(total, surface));
    total.resize(0);
  }
  if (!keeps_sky) return;
  material.sky = {std::move(transport.ambient_occlusion), std::move(transport.sky_view_factor),
                  std::move(planned.moments)};
}

/// Walks of the sky alone: its part of a plan, if none is there yet, and no links.
void find_sky(const Needs& needs, const BakeOptions& options, Material& material) {
  const Surface& surface = *material.surface;
  if (!material.plan || options.reach) {
    HorizonPilot pilot(surface, options.seed);
    const HorizonPlan plan = plan_sky(pilot, goal_of(options, false, needs.moments.first));
    if (!material.plan) material.plan = plan;
    material.plan->sky = plan.sky;
    material.plan->sky_full_from = options.reach ? 0 : plan.sky_full_from;  // found without a reach
    material.plan->sky_full_share = options.reach ? 1 : plan.sky_full_share;
    material.plan->sky_error = plan.sky_error;
  }
  const HeightMips mips = build_height_mips(surface);
  const bool has_sky = material.sky.sky_view_factor.size() > 0;
  if (needs.sky && !has_sky) {
    material.sky = walk_horizon_sky(surface, mips, material.plan->sky, options.quiet,
                                    {needs.moments, options.reach, material.plan->sky_full_from});
  }
  if (!needs.horizons) return;
  std::vector<double> azimuths;
  for (int k = 0; k < options.horizon_azimuths; ++k) {
    azimuths.push_back((options.y_down ? -2 : 2) * std::numbers::pi * k / options.horizon_azimuths);
  }
  material.horizons =
      walk_horizons(surface, mips, material.plan->sky, azimuths, options.reach, options.quiet);
}

}  // namespace

bool is_wanted(const BakeOptions& options, MaterialMap map) {
  return std::find(options.maps.begin(), options.maps.end(), map) != options.maps.end() ||
         std::any_of(options.packed.begin(), options.packed.end(),
                     [map](const PackedChannel& channel) { return channel.map == map; });
}

Material find_material(const Surface& surface, const BakeOptions& options, const std::string& name) {
  const Needs needs = find_needs(options);
  Material material;
  material.surface = &surface;
  const std::uint64_t link_memory = memory_for_links(surface, needs, options, name);
  if (needs.transport()) find_light(needs, options, link_memory, material);
  const bool has_sky = material.sky.sky_view_factor.size() > 0;
  if (needs.horizons || (needs.sky && !has_sky)) {
    material.seconds.visibility += seconds_of([&] { find_sky(needs, options, material); });
  }
  if (needs.sky) {
    material.seconds.check += seconds_of(
        [&] { material.sky_check = check_sky(surface, material.sky, options.reach, options.seed); });
  }
  return material;
}

}  // namespace heightlight
