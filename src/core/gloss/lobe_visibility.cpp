#include "gloss/lobe_visibility.h"

#include <cmath>
#include <limits>

#include "base/hash.h"
#include "base/texel_algebra.h"
#include "heightlight/occlusion_forms.h"

namespace heightlight {
namespace {

/// The frame of a normal, as columns: takes vectors from the frame to the world's axes.
Eigen::Matrix3d frame_of(const Eigen::Vector3d& n) {
  const NormalFrame<double> frame({n.x(), n.y(), n.z()});
  Eigen::Matrix3d axes;
  axes << frame.tangent.x, frame.bitangent.x, n.x(), frame.tangent.y, frame.bitangent.y, n.y(),
      frame.tangent.z, frame.bitangent.z, n.z();
  return axes;
}

/// Fills the workspace's directions and weights, part after part. Returns false where the receiver is missing
/// or faces away from the view.
bool aim_lobe(const Surface& surface, int row, int column, const LookedLobe& lobe, LobeWorkspace& work) {
  if (std::isnan(surface.map.height(row, column))) return false;
  const Eigen::Matrix3d axes = frame_of(as_eigen(surface.normal(row, column)).cast<double>().normalized());
  const Eigen::Vector3d view = axes.transpose() * lobe.view;
  if (!(view.z() > 0)) return false;
  work.directions.clear();
  work.weights.clear();
  const std::uint64_t texel = surface.map.height.index(row, column);
  for (int part = 0; part < kLobeParts; ++part) {
    const std::uint64_t hash = hash_combine(hash_combine(lobe.seed, texel), static_cast<std::uint64_t>(part));
    lobe.sampler(view, lobe.rays / kLobeParts, {unit_real(hash), unit_real(scramble(hash))}, work.part);
    for (const LobeSample& sample : work.part) {
      work.directions.emplace_back((axes * sample.direction).cast<float>());
      work.weights.push_back(sample.weight);
    }
  }
  return true;
}

/// The open share and its error, from the directions' weights and which directions are open.
LobeShare share_of(const LobeWorkspace& work) {
  const std::size_t in_part = work.weights.size() / kLobeParts;
  double whole = 0;
  double open = 0;
  std::array<double, kLobeParts> part_whole{};
  std::array<double, kLobeParts> part_open{};
  for (std::size_t k = 0; k < work.weights.size(); ++k) {
    part_whole.at(k / in_part) += work.weights[k];
    if (work.open[k] != 0) part_open.at(k / in_part) += work.weights[k];
  }
  for (std::size_t part = 0; part < kLobeParts; ++part) {
    whole += part_whole.at(part);
    open += part_open.at(part);
  }
  LobeShare share{.open = open / whole};
  // The error of the ratio to first order (Cochran 1977, section 2.11).
  double squares = 0;
  for (std::size_t part = 0; part < kLobeParts; ++part) {
    const double rest = part_open.at(part) - share.open * part_whole.at(part);
    squares += rest * rest;
  }
  share.error = std::sqrt(squares * kLobeParts / (kLobeParts - 1)) / whole;
  return share;
}

const LobeShare kNoLobe{.open = std::numeric_limits<double>::quiet_NaN()};

}  // namespace

LobeSampler ggx_sampler(const Gloss& gloss) {
  return [gloss](const Eigen::Vector3d& view, int count, const LatticeShift& shift,
                 std::vector<LobeSample>& samples) { sample_ggx(gloss, view, count, shift, samples); };
}

LobeSampler lambert_sampler() {
  return [](const Eigen::Vector3d&, int count, const LatticeShift& shift, std::vector<LobeSample>& samples) {
    sample_lambert(count, shift, samples);
  };
}

LobeShare look_by_rays(const RayCaster& caster, const Surface& surface, int row, int column,
                       const LookedLobe& lobe, LobeWorkspace& work) {
  if (!aim_lobe(surface, row, column, lobe, work)) return kNoLobe;
  caster.look_along(row, column, work.directions, work.rays, work.open);
  return share_of(work);
}

LobeShare look_by_horizons(const ExactWalker& walker, int row, int column, const LookedLobe& lobe,
                           LobeWorkspace& work) {
  if (!aim_lobe(walker.surface(), row, column, lobe, work)) return kNoLobe;
  work.open.clear();
  for (const Eigen::Vector3f& direction : work.directions) {
    const Eigen::Vector3d d = direction.cast<double>();
    const Eigen::Vector2d along = d.head<2>().normalized();
    work.open.push_back(d.z() >= walker.horizon_slope(row, column, along) * d.head<2>().norm() ? 1 : 0);
  }
  return share_of(work);
}

}  // namespace heightlight
