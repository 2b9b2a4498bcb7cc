#include <algorithm>
#include <cmath>
#include <limits>

#include "base/byte_size.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "transport/link_packing.h"
#include "visibility/exact_walk.h"

namespace heightlight {
namespace {

constexpr std::uint64_t kLinkBytes = sizeof(Link) + sizeof(double);

/// Mean number of links per receiver, from receivers picked by a hash.
double estimate_links(const Surface& surface, const ExactWalker& walker) {
  constexpr int kSample = 128;
  std::vector<std::size_t> links(kSample, 0);
  parallel_for(kSample, [&](std::int64_t i) {
    const std::uint64_t texel = scramble(static_cast<std::uint64_t>(i)) % surface.map.height.size();
    const auto width = static_cast<std::uint64_t>(surface.width());
    SliceView view;
    walker.view(static_cast<int>(texel / width), static_cast<int>(texel % width), view);
    links[static_cast<std::size_t>(i)] = view.links.size();
  });
  double sum = 0;
  for (const std::size_t count : links) sum += static_cast<double>(count);
  return sum / kSample;
}

/// Finds the links of one row. It can be stopped at any receiver, since a row of exact walks takes long.
void fill_row(const ExactWalker& walker, int row, const Progress& progress, FormFactors& form_factors) {
  const Surface& surface = walker.surface();
  constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();
  LinkRow& out = form_factors.rows[static_cast<std::size_t>(row)];
  out.begin.push_back(0);
  SliceView view;
  for (int column = 0; column < form_factors.width; ++column) {
    progress.throw_if_stopped();
    walker.view(row, column, view);
    const bool present = !std::isnan(view.sky_view_factor);
    for (const VisibleInterval& link : view.links) {
      out.links.push_back(pack_link(0, link.place, surface.map.height));
      out.weights.push_back(link.weight);
    }
    form_factors.ambient_occlusion(row, column) =
        present ? static_cast<float>(view.ambient_occlusion) : kMissing;
    form_factors.sky_view_factor(row, column) = present ? static_cast<float>(view.sky_view_factor) : kMissing;
    form_factors.direct[form_factors.sky_view_factor.index(row, column)] = present ? view.sky_view_factor : 0;
    out.begin.push_back(out.links.size());
  }
  out.links.shrink_to_fit();
  out.weights.shrink_to_fit();
}

}  // namespace

FormFactors build_exact_form_factors(const Surface& surface, int azimuths, const LinkLimits& limits) {
  check_azimuths(azimuths);
  const ExactWalker walker(surface, azimuths);
  constexpr double kMargin = 1.2;
  const double bytes = kMargin * estimate_links(surface, walker) * static_cast<double>(kLinkBytes) *
                       static_cast<double>(surface.map.height.size());
  if (bytes > static_cast<double>(limits.memory)) {
    throw MemoryError(
        "the exact links of " + std::to_string(surface.width()) + " × " + std::to_string(surface.height()) +
            " texels along " + std::to_string(azimuths) + " azimuths need " +
            format_byte_size(static_cast<std::uint64_t>(bytes)) + ", more than the " +
            format_byte_size(limits.memory) +
            " of memory that is left for them: use fewer azimuths, an error above 0, or more memory",
        static_cast<std::uint64_t>(bytes) - limits.memory);
  }
  FormFactors form_factors(surface.width(), surface.height());
  Progress progress("visibility", surface.height(), limits.watch);
  parallel_for(
      surface.height(),
      [&](std::int64_t row) { fill_row(walker, static_cast<int>(row), progress, form_factors); }, &progress);
  return form_factors;
}

}  // namespace heightlight
