#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "heightlight/forms.h"
#include "heightlight/transport.h"
#include "transport/link_corners.h"
#include "visibility/exact_sky.h"

// Umenhoffer et al. 2009, eqs. 5 and 6, from the links of a receiver. Each link is a surface seen with a form
// factor F at a distance d, which counts as open by the share μ(d):
//     O = A + Σ F μ(d),   W = O/(1 − Σ F (1 − μ(d)) ρ).

namespace heightlight {
namespace {

/// The place where a link ends, in texels, with its height and albedo.
struct SeenPlace {
  double row = 0;
  double column = 0;
  double height = 0;
  double albedo = 0;
};

SeenPlace find_place(const Surface& surface, const FormFactors& form_factors, const Link& link,
                     const TexelVector* varying) {
  SeenPlace place;
  for (const LinkCorner& corner : corners_of(link, form_factors.width)) {
    if (corner.share <= 0) continue;
    const auto i = static_cast<int>(corner.row % static_cast<std::uint64_t>(form_factors.height));
    const auto j = static_cast<int>(corner.column % static_cast<std::uint64_t>(form_factors.width));
    place.row += corner.share * static_cast<double>(corner.row);
    place.column += corner.share * static_cast<double>(corner.column);
    place.height += corner.share * double{surface.map.height(i, j)};
    if (varying) place.albedo += corner.share * (*varying)[surface.map.height.index(i, j)];
  }
  return place;
}

/// The shorter of the distances around a tiling map, in texels, with its sign.
double shorter(double texels, int period, bool tiles) {
  return tiles ? texels - period * std::round(texels / period) : texels;
}

double distance_to(const Surface& surface, const SeenPlace& place, int row, int column) {
  const double x = surface.map.spacing.x * shorter(place.column - column, surface.width(), surface.tiles());
  const double y = surface.map.spacing.y * shorter(place.row - row, surface.height(), surface.tiles());
  const double z = place.height - double{surface.map.height(row, column)};
  return std::sqrt(x * x + y * y + z * z);
}

/// Collects what the receiver sees; set_albedos then adds the albedos of one channel.
void collect_occluders(const Surface& surface, const FormFactors& form_factors,
                       const MaximumDistance& maximum_distance, std::size_t receiver,
                       std::vector<Occluder<double>>& occluders) {
  const int row = static_cast<int>(receiver / static_cast<std::size_t>(surface.width()));
  const int column = static_cast<int>(receiver % static_cast<std::size_t>(surface.width()));
  const LinkRow& line = form_factors.rows[static_cast<std::size_t>(row)];
  const auto j = static_cast<std::size_t>(column);
  occluders.clear();
  for (std::uint64_t k = line.begin[j]; k < line.begin[j + 1]; ++k) {
    const Link& link = line.links[k];
    const double form_factor = form_factors.ray_weights.empty()
                                   ? line.weights[k]
                                   : form_factors.ray_weights[line.weight_table[j]][link.weight];
    const SeenPlace place = find_place(surface, form_factors, link, nullptr);
    occluders.push_back(
        {form_factor, open_share(maximum_distance, distance_to(surface, place, row, column)), 0});
  }
}

void set_albedos(const Surface& surface, const FormFactors& form_factors, const Albedo& albedo,
                 std::size_t channel, std::size_t receiver, std::vector<Occluder<double>>& occluders) {
  const std::size_t row = receiver / static_cast<std::size_t>(surface.width());
  const std::size_t column = receiver % static_cast<std::size_t>(surface.width());
  const LinkRow& line = form_factors.rows[row];
  for (std::size_t k = 0; k < occluders.size(); ++k) {
    occluders[k].albedo =
        albedo.varying.empty()
            ? albedo.constant[channel]
            : find_place(surface, form_factors, line.links[line.begin[column] + k], &albedo.varying[channel])
                  .albedo;
  }
}

}  // namespace

AmbientTransfer find_ambient_transfer(const Surface& surface, const FormFactors& form_factors,
                                      const MaximumDistance& maximum_distance, const Albedo& albedo) {
  assert(form_factors.width == surface.width() && form_factors.height == surface.height());
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  AmbientTransfer found;
  found.obscurance = Map(surface.width(), surface.height(), kMissing);
  found.transfer.assign(albedo.channels(), found.obscurance);
  parallel_for(surface.height(), [&](std::int64_t row) {
    std::vector<Occluder<double>> occluders;
    for (int column = 0; column < surface.width(); ++column) {
      const std::size_t i = surface.map.height.index(static_cast<int>(row), column);
      const SkyViewFactor sky(double{form_factors.sky_view_factor.values[i]});
      if (std::isnan(sky.value)) continue;
      collect_occluders(surface, form_factors, maximum_distance, i, occluders);
      double obscurance = sky.value;
      for (const Occluder<double>& seen : occluders) obscurance += seen.form_factor * seen.openness;
      found.obscurance.values[i] = static_cast<float>(clamp_share(obscurance));
      for (std::size_t channel = 0; channel < found.transfer.size(); ++channel) {
        set_albedos(surface, form_factors, albedo, channel, i, occluders);
        found.transfer[channel].values[i] = static_cast<float>(ambient_transfer(sky, occluders));
      }
    }
  });
  return found;
}

}  // namespace heightlight
