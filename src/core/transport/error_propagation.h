#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "transport/exact_gather.h"
#include "transport/sky_classes.h"

// What is wrong with a total in all, e = r + F ρ e, from what some receivers find wrong at the last step, r.
// They know by exact walks what they see, F. The means of e over receivers of like A are solved for. Of what
// differs from these means, d, what is seen has a share, too: none where it is noise of each receiver by
// itself, more where a place and what it sees err alike. Some receivers know r of one of the places that they
// see, picked by its form factor: these pairs tell that share.

namespace heightlight {

/// What one receiver finds.
struct FoundError {
  double residual = 0;                  ///< r
  std::size_t own_class = 0;            ///< by its A
  SkyClasses::PerClass<double> seen{};  ///< Σ F ρ over the places that it sees, by their class

  struct SeenPlace {
    double residual = 0;
    std::size_t own_class = 0;
  };
  std::optional<SeenPlace> place = {};  ///< one of the places seen
};

/// e of each receiver. ρ F must take something from what it gathers.
std::vector<double> propagate_errors(const std::vector<FoundError>& found);

/// Σ F ρ over the places of an exact view, by their class; the place's texel stands for it. `albedo(i)` and
/// `sky(i)` are ρ and A of texel i.
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
