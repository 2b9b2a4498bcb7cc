#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "transport/exact_gather.h"
#include "transport/sky_classes.h"

// Finds the whole error of a total, e = r + F ρ e, from the residuals r that some receivers find at the last
// step. These receivers know by exact walks what they see, F. The means of e over receivers of similar A are
// solved for. The deviation d from these means is passed on in part, too: the places that a receiver sees
// have a share of its d, which is 0 where d is noise of each receiver by itself, and larger where a place and
// what it sees err alike. Some receivers also know r of one of the places that they see, picked by its form
// factor: that share is estimated from these pairs.

namespace heightlight {

/// What one receiver finds.
struct FoundError {
  double residual = 0;                  ///< r
  std::size_t own_class = 0;            ///< class of the receiver by its A
  SkyClasses::PerClass<double> seen{};  ///< Σ F ρ over the places that it sees, by their class

  struct SeenPlace {
    double residual = 0;
    std::size_t own_class = 0;
  };
  std::optional<SeenPlace> place = {};  ///< one of the places seen
};

/// Returns e of each receiver. F ρ must lose part of what it gathers.
std::vector<double> propagate_errors(const std::vector<FoundError>& found);

/// Returns Σ F ρ over the places of an exact view, by class; the nearest texel stands for each place.
/// `albedo(i)` and `sky(i)` are ρ and A of texel i.
template <class Albedo, class Sky>
SkyClasses::PerClass<double> seen_by_class(const SliceView& view, const Surface& surface,
                                           const SkyClasses& classes, Albedo&& albedo, Sky&& sky) {
  SkyClasses::PerClass<double> seen{};
  for (const VisibleInterval& link : view.links) {
    const std::size_t texel = nearest_texel(link.place, surface);
    seen[classes.of(sky(texel))] += link.weight * albedo(texel);
  }
  return seen;
}

}  // namespace heightlight
