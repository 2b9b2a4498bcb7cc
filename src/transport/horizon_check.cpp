#include <algorithm>
#include <cmath>
#include <vector>

#include "core/hash.h"
#include "core/parallel.h"
#include "heightlight/transport.h"
#include "transport/exact_gather.h"

namespace heightlight {
namespace {

constexpr std::int64_t kReceivers = 256;
constexpr int kAzimuths = 256;

struct ReceiverError {
  bool present = false;
  double sky = 0;
  double total = 0;
  double gain = 1;  ///< 1/(1 − ρ (1 − A))
};

/// The i-th of `count` texels, one from each of as many equal parts of a map of `texels`.
Eigen::Index pick_texel(std::int64_t i, std::int64_t count, std::int64_t texels, std::uint64_t seed) {
  const std::int64_t begin = texels * i / count;
  const std::int64_t end = texels * (i + 1) / count;
  const std::uint64_t pick = hash_combine(seed + 2, static_cast<std::uint64_t>(i));
  return begin + static_cast<Eigen::Index>(pick % static_cast<std::uint64_t>(end - begin));
}

}  // namespace

HorizonCheck check_by_exact_walks(const Surface& surface, const Transport& transport,
                                  const TexelVector& total, const TexelVector& albedo, std::uint64_t seed) {
  const ExactWalker walker(surface, kAzimuths);
  const TexelVector radiosity = albedo.cwiseProduct(total);
  const auto texels = static_cast<std::int64_t>(surface.map.height.size());
  const std::int64_t count = std::min(kReceivers, texels);
  std::vector<ReceiverError> errors(static_cast<std::size_t>(count));
  parallel_for(count, [&](std::int64_t i) {
    const Eigen::Index texel = pick_texel(i, count, texels, seed);
    SliceView view;
    walker.view(static_cast<int>(texel / surface.width()), static_cast<int>(texel % surface.width()), view);
    if (std::isnan(view.sky_view_factor)) return;
    ReceiverError& error = errors[static_cast<std::size_t>(i)];
    error.present = true;
    error.sky = transport.direct[texel] - view.sky_view_factor;
    error.total = total[texel] - view.sky_view_factor - gather_exactly(view, radiosity, surface);
    error.gain = 1 / std::max(1e-3, 1 - albedo[texel] * (1 - view.sky_view_factor));
  });
  HorizonCheck check;
  check.azimuths = kAzimuths;
  double sky_squares = 0;
  double squares = 0;
  double sum = 0;
  double gain = 0;
  for (const ReceiverError& error : errors) {
    if (!error.present) continue;
    ++check.receivers;
    sky_squares += error.sky * error.sky;
    squares += error.total * error.total;
    sum += error.total;
    gain += error.gain;
  }
  if (check.receivers == 0) return check;
  const double mean = sum / check.receivers;
  const double spread = std::max(0.0, squares / check.receivers - mean * mean);
  check.sky_rmse = std::sqrt(sky_squares / check.receivers);
  check.total_rmse = std::hypot(std::sqrt(spread), mean * gain / check.receivers);
  return check;
}

}  // namespace heightlight
