#pragma once

#include <memory>

#include "heightlight/transport.h"
#include "transport/map_gather.h"

namespace heightlight {

/// How bounces are walked.
struct BounceWalk {
  int azimuths = 8;      ///< number for the first bounce
  double error = 0.002;  ///< RMSE wanted of E_b/π
};

/// Bounces by gathers that walk few azimuths each, and fewer the later the bounce: the irradiance that is
/// left falls from bounce to bounce, and so does the error of few azimuths. As the azimuths turn from gather
/// to gather, energy is not conserved by itself, and what remains of one bounce's noise must not be
/// subtracted from later bounces. Two sequences obey the same recursion: E_b = F E_{b−1}, and the rest after
/// all bounces so far, L_b = 1 − (E₀ + … + E_b) = F L_{b−1}, from which E_b = L_{b−1} − L_b. Where irradiance
/// falls fast, the walks follow L, which is then small; where it falls slowly, they follow E, which is small
/// beside L.
///
/// The mean m of a field, weighted by how much of every place is seen, is gathered without walking: it brings
/// (1 − A) m. Only the deviation from m is walked for. It is gathered as a mean over azimuths that is not
/// divided by the azimuths' weights, because with few azimuths that ratio is biased. Earlier walks are kept,
/// as progressive_gather.h describes for totals: since each field x is about c times the field before, y, the
/// sums continue as
///     N ← λ c N + N[(x − m_x) − λ c (y − m_y)],   F x = (1 − A) m_x + N,
/// where c minimizes the mean square of (x − m_x) − c (y − m_y). A field smaller than a hundredth of the
/// error wanted is not walked for: it is scaled by its ratio to the field before.
class WalkedBounces : public BounceSequence {
 public:
  /// `transport` must outlive this object. The watch is asked whether to go on.
  WalkedBounces(std::shared_ptr<const MapGather> gather, const Transport& transport, const BounceWalk& walk,
                const Watch& watch);

  TexelVector next(const TexelVector& last, const TexelVector& sum) override;

 private:
  /// A field x compared with the field before, y. Means are weighted by how much of every place is seen.
  struct Likeness {
    double mean = 0;           ///< m_x
    double size = 0;           ///< RMS of x
    double ratio = 0;          ///< minimizes the mean square of x − ratio y
    double of_deviations = 0;  ///< c: the same ratio for the deviations from the means
  };
  Likeness compare_with_before(const TexelVector& field) const;
  /// Returns F x, and makes x the field before.
  TexelVector follow(const TexelVector& field, const Likeness& likeness);
  TexelVector walk(const TexelVector& field, const Likeness& likeness);

  std::shared_ptr<const MapGather> gather_;
  const Transport& transport_;
  BounceWalk walk_;
  Watch watch_;
  int bounce_ = 0;            ///< number of the bounce that is being made
  bool follows_rest_ = true;  ///< the walks follow L, not E
  TexelVector before_;
  double mean_before_ = 0;
  Map sums_;             ///< N, in units
  double unit_ = 1;      ///< E/π of one unit
  double azimuths_ = 0;  ///< azimuths in N, each with its weight there; 0 before anything is walked
};

}  // namespace heightlight
