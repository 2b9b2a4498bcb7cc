#pragma once

#include <memory>

#include "heightlight/transport.h"
#include "transport/map_gather.h"

namespace heightlight {

/// How bounces are walked.
struct BounceWalk {
  int azimuths = 8;      ///< of the first bounce
  double error = 0.002;  ///< RMSE wanted
};

/// Bounces by gathers that walk few azimuths each, and fewer the later: what is left falls from bounce to
/// bounce, and with it what few azimuths cost. As gathers turn from one to the next, energy is not kept by
/// itself, and what is left over of one bounce's noise must not be taken from later ones. Two sequences obey
/// one law: E_b = F E_{b−1}, and what all bounces have left, L_b = 1 − (E₀ + … + E_b) = F L_{b−1}, for which
/// E_b = L_{b−1} − L_b. Where irradiance falls fast, L is followed, of which little is left; where it falls
/// slowly, E, which is little beside L.
///
/// The mean m of a field, weighted by how much every place is seen, is gathered without walking: it brings
/// (1 − A) m. What differs from it is walked for, as a mean over azimuths and without dividing by what they
/// weigh: among few azimuths that ratio errs to one side. What was walked before is kept, as
/// progressive_gather.h has it for totals: since fields x are about c times those before, y, the sums go on
/// as
///     N ← λ c N + N[(x − m_x) − λ c (y − m_y)],   F x = (1 − A) m_x + N,
/// where c makes (x − m_x) − c (y − m_y) least in the mean square. What nobody will miss, of less than a
/// hundredth of the error wanted, falls by a ratio alone.
class WalkedBounces : public BounceSequence {
 public:
  /// `transport` must outlive it. The watch is asked whether to go on.
  WalkedBounces(std::shared_ptr<const MapGather> gather, const Transport& transport, const BounceWalk& walk,
                const Watch& watch);

  TexelVector next(const TexelVector& last, const TexelVector& sum) override;

 private:
  /// A field x beside the one before, y. Means are weighted by how much every place is seen.
  struct Likeness {
    double mean = 0;           ///< m_x
    double size = 0;           ///< RMS of x
    double ratio = 0;          ///< that makes x − ratio y least in the mean square
    double of_deviations = 0;  ///< c
  };
  Likeness compare_with_before(const TexelVector& field) const;
  /// F x, and x is then the field before.
  TexelVector follow(const TexelVector& field, const Likeness& likeness);
  TexelVector walk(const TexelVector& field, const Likeness& likeness);

  std::shared_ptr<const MapGather> gather_;
  const Transport& transport_;
  BounceWalk walk_;
  Watch watch_;
  int bounce_ = 0;            ///< the one being made
  bool follows_rest_ = true;  ///< L, not E
  TexelVector before_;
  double mean_before_ = 0;
  Map sums_;             ///< N, in units
  double unit_ = 1;      ///< of E/π
  double azimuths_ = 0;  ///< in N, as they weigh there; 0 before anything is walked
};

}  // namespace heightlight
