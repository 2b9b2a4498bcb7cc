#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "base/byte_size.h"
#include "base/hash.h"
#include "base/parallel.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "transport/link_packing.h"
#include "visibility/ray_caster.h"

namespace heightlight {
namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Mean number of hits per receiver, from receivers picked by a hash.
double estimate_hits(const Surface& surface, const RayCaster& caster) {
  constexpr int kSample = 512;
  const std::size_t texels = surface.map.height.size();
  std::vector<std::int64_t> hits(kSample, 0);
  parallel_for(kSample, [&](std::int64_t i) {
    const std::uint64_t texel = scramble(static_cast<std::uint64_t>(i)) % texels;
    RayWorkspace workspace(caster.rays());
    ReceiverView view;
    caster.view(static_cast<int>(texel / static_cast<std::uint64_t>(surface.width())),
                static_cast<int>(texel % static_cast<std::uint64_t>(surface.width())), workspace, view);
    hits[static_cast<std::size_t>(i)] = static_cast<std::int64_t>(view.ray.size());
  });
  double sum = 0;
  for (const std::int64_t count : hits) sum += static_cast<double>(count);
  return sum / kSample;
}

void check_memory(std::uint64_t bytes, const Surface& surface, int rays, std::uint64_t allowed) {
  if (bytes <= allowed) return;
  throw MemoryError("the links of " + std::to_string(surface.width()) + " × " +
                        std::to_string(surface.height()) + " texels at " + std::to_string(rays) +
                        " rays need " + format_byte_size(bytes) + ", more than the " +
                        format_byte_size(allowed) +
                        " of memory that is left for them: use fewer rays, a smaller map, or more memory",
                    bytes - allowed);
}

/// Casts one row's rays into its links and its part of the sky maps.
void fill_row(const Surface& surface, const RayCaster& caster, int row, FormFactors& form_factors) {
  LinkRow& out = form_factors.rows[static_cast<std::size_t>(row)];
  const int width = form_factors.width;
  out.begin.reserve(static_cast<std::size_t>(width) + 1);
  out.begin.push_back(0);
  out.weight_table.assign(static_cast<std::size_t>(width), 0);
  std::vector<Link> links;
  RayWorkspace workspace(caster.rays());
  ReceiverView view;
  for (int column = 0; column < width; ++column) {
    caster.view(row, column, workspace, view);
    for (std::size_t hit = 0; hit < view.ray.size(); ++hit) {
      links.push_back(pack_link(view.ray[hit], view.place[hit], surface.map.height));
    }
    const bool present = view.rays > 0;
    const SkyShare sky = present ? sky_share(view) : SkyShare{};
    form_factors.ambient_occlusion(row, column) =
        present ? static_cast<float>(sky.ambient_occlusion) : kMissing;
    form_factors.sky_view_factor(row, column) = present ? static_cast<float>(sky.sky_view_factor) : kMissing;
    form_factors.direct[form_factors.sky_view_factor.index(row, column)] = present ? sky.sky_view_factor : 0;
    out.weight_table[static_cast<std::size_t>(column)] = view.weight_table;
    out.begin.push_back(links.size());
  }
  out.links.assign(links.begin(), links.end());  // without the growth's slack
}

}  // namespace

FormFactors::FormFactors(int map_width, int map_height) : width(map_width), height(map_height) {
  ambient_occlusion = Map(width, height);
  sky_view_factor = Map(width, height);
  direct.assign(sky_view_factor.size(), 0);
  rows.resize(static_cast<std::size_t>(height));
}

std::uint64_t FormFactors::link_count() const {
  std::uint64_t count = 0;
  for (const LinkRow& row : rows) count += row.links.size();
  return count;
}

std::uint64_t FormFactors::bytes() const {
  std::uint64_t bytes = 0;
  for (const LinkRow& row : rows) {
    bytes += row.links.size() * sizeof(Link) + row.begin.size() * sizeof(std::uint64_t) +
             row.weights.size() * sizeof(double) + row.weight_table.size();
  }
  return bytes;
}

FormFactors build_form_factors(const Surface& surface, const RayOptions& rays, const LinkLimits& limits) {
  const RayCaster caster(surface, rays);
  constexpr double kMargin = 1.1;
  const double receiver_bytes =
      kMargin * estimate_hits(surface, caster) * sizeof(Link) + sizeof(std::uint64_t) + 1;
  const double texels = static_cast<double>(surface.map.height.size());
  check_memory(static_cast<std::uint64_t>(receiver_bytes * texels), surface, rays.rays, limits.memory);

  FormFactors form_factors(surface.width(), surface.height());
  form_factors.ray_weights.assign(caster.directions().weight.begin(), caster.directions().weight.end());
  std::atomic<std::uint64_t> taken{0};
  Progress progress("visibility", surface.height(), limits.watch);
  parallel_for(
      surface.height(),
      [&](std::int64_t row) {
        fill_row(surface, caster, static_cast<int>(row), form_factors);
        const std::uint64_t row_bytes =
            form_factors.rows[static_cast<std::size_t>(row)].links.size() * sizeof(Link);
        check_memory(taken.fetch_add(row_bytes) + row_bytes, surface, rays.rays, limits.memory);
      },
      &progress);
  return form_factors;
}

}  // namespace heightlight
