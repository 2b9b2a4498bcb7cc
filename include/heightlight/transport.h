#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "heightlight/image.h"
#include "heightlight/surface.h"
#include "heightlight/visibility.h"
#include "heightlight/watch.h"

namespace heightlight {

/// Diffuse reflectance in [0, 1]: one channel where it is grey, else R, G, B.
struct Albedo {
  std::vector<double> constant = {};      ///< per channel; empty where it varies over the map
  std::vector<TexelVector> varying = {};  ///< per channel; empty where it is constant

  std::size_t channels() const { return constant.size() + varying.size(); }
};

/// A system E = direct + F ρ E, of one channel.
struct IrradianceSystem {
  const TexelVector* direct = nullptr;   ///< E₀/π of light of one's own; null: the sky's
  double albedo = 0;                     ///< where it is the same everywhere
  const TexelVector* varying = nullptr;  ///< ρ per texel, where it is not
};

/// Solutions of systems.
struct Totals {
  std::vector<TexelVector> irradiance;  ///< E/π, per system
  int gathers = 0;                      ///< of walks: one after the other, the most of any system
  int iterations = 0;                   ///< of solvers on stored links, the most of any system
  double residual = 0;                  ///< of solvers, the largest
};

/// Bounces one after the other, at ρ = 1.
class BounceSequence {
 public:
  virtual ~BounceSequence() = default;
  /// E_b/π = F E_{b−1}, where `last` is E_{b−1}: at the first call the direct irradiance, then what the call
  /// before gave, or as much of it as energy allows. `sum` is E₀ + … + E_{b−1}, no more than 1.
  virtual TexelVector next(const TexelVector& last, const TexelVector& sum) = 0;
};

/// The operator F that carries irradiance from bounce to bounce, and the sky's share of every receiver:
/// sky_view_factor_i + Σ_j F_ij = 1. Whatever finds visibility ends in one of these; bounces don't know
/// which.
struct Transport {
  Map ambient_occlusion;  ///< α: share of the hemisphere's solid angle that sees the sky, [0, 1]
  Map sky_view_factor;    ///< A: the same, cosine weighted; NaN where the sample is missing, in both
  TexelVector direct;     ///< E₀/π: A as F complements it to 1, 0 where missing

  Transport() = default;
  Transport(Transport&&) = default;
  Transport& operator=(Transport&&) = default;
  virtual ~Transport() = default;

  /// F x: what each receiver gets when the surface's radiosity / π is x, finite everywhere. 0 where missing.
  /// The same linear F at every call.
  virtual TexelVector gather(const TexelVector& x) const = 0;
  /// Σ F of each receiver as links or walks add it up, not as the sky's share leaves it: gather() may scale
  /// what it finds so that both make 1. 0 where missing.
  virtual TexelVector surface_share() const = 0;
  /// Bounces from the first on. This must outlive them.
  virtual std::unique_ptr<BounceSequence> start_bounces() const;
  /// E/π of all bounces of each system, which is the same, to the last bit, whatever others are beside it. 0
  /// where missing.
  virtual Totals solve(const std::vector<IrradianceSystem>& systems, const Watch& watch) const = 0;
  /// Form factors that are stored, and the bytes that they take.
  virtual std::uint64_t link_count() const = 0;
  virtual std::uint64_t bytes() const = 0;
};

inline TexelVector gather(const Transport& transport, const TexelVector& x) { return transport.gather(x); }

/// |sky + Σ F − 1| over the receivers.
struct RowSumError {
  double largest = 0;
  double rms = 0;
};
RowSumError row_sum_error(const Transport& transport);

/// What a receiver sees in one direction: a place on the surface, and through `weight` the form factor. The
/// place lies in the cell whose upper left vertex is (row, column), at (across, down) / 255 of it.
struct Link {
  std::uint32_t cell = 0;  ///< row × (width + 1) + column: an index into values padded by a column and a row
  std::uint16_t weight = 0;  ///< index into a table of weights, or of the row's own
  std::uint8_t across = 0;
  std::uint8_t down = 0;
};
static_assert(sizeof(Link) == 8);

/// The links of one row of receivers; receiver j's are links[begin[j]] … links[begin[j + 1]].
struct LinkRow {
  std::vector<std::uint64_t> begin;
  std::vector<std::uint8_t> weight_table;  ///< per receiver: which of FormFactors::ray_weights its links use
  std::vector<Link> links;
  std::vector<double> weights;  ///< per link, where form factors come from no table
};

/// Stored links, each to a place on a facet: those of rays, or of exact horizon walks.
struct FormFactors : Transport {
  int width = 0;
  int height = 0;
  std::vector<std::vector<double>>
      ray_weights;  ///< form factor of each ray, per table; empty for exact walks
  std::vector<LinkRow> rows;

  FormFactors() = default;
  FormFactors(int map_width, int map_height);  ///< without links, nothing known of the sky

  TexelVector gather(const TexelVector& x) const override;
  TexelVector surface_share() const override;
  /// By solve_equilibrium.
  Totals solve(const std::vector<IrradianceSystem>& systems, const Watch& watch) const override;
  std::uint64_t link_count() const override;
  std::uint64_t bytes() const override;
};

/// What one receiver sees of each texel: F_ij, j rising. The sky's share and the sum of these are 1.
struct FormFactorRow {
  std::vector<std::uint64_t> texel;  ///< j
  std::vector<double> value;         ///< > 0
};

/// The links of the receiver at (row, column), brought to the texels that they are interpolated from, so that
/// Σ F_ij x_j is what gather(x) gives it.
FormFactorRow form_factor_row(const FormFactors& form_factors, int row, int column);

/// Obscurance and ambient transfer (Umenhoffer et al. 2009, eqs. 5 and 6); NaN where the sample is missing.
struct AmbientTransfer {
  Map obscurance;             ///< O = A + Σ F μ, [0, 1]
  std::vector<Map> transfer;  ///< W = O/(1 − Σ F (1 − μ) ρ) per channel of the albedo, [0, 1]
};

/// From links, with μ of a maximum distance. On a tiling map distances are those to the nearest copy of what
/// is seen: the maximum distance must not pass half the map.
AmbientTransfer find_ambient_transfer(const Surface& surface, const FormFactors& form_factors,
                                      const MaximumDistance& maximum_distance, const Albedo& albedo);

/// What finding links may use, and who watches it.
struct LinkLimits {
  std::uint64_t memory = ~0ULL;  ///< bytes that links may take
  Watch watch = {};              ///< of finding them; gathers ask it whether to go on
};

/// Casts rays from every receiver and stores what they see. The bytes are estimated from a sample of
/// receivers first. Throws MemoryError when they pass `limits.memory`, UsageError for a bad number of rays.
FormFactors build_form_factors(const Surface& surface, const RayOptions& rays, const LinkLimits& limits);

/// Walks exactly along `azimuths` azimuths from every receiver (2 … 65536, even), and stores what they see.
/// Throws as build_form_factors does.
FormFactors build_exact_form_factors(const Surface& surface, int azimuths, const LinkLimits& limits);

/// How horizon walks gather. Gathers bear fewer azimuths than the sky does, since they tell only how what is
/// seen of the surface is divided up, not how much of it there is.
struct GatherPlan {
  WalkOptions walk = {.azimuths = 8};  ///< azimuths: of each of the last two gathers of a total, and of
                                       ///< Transport::gather
  int first_bounce_azimuths = 32;      ///< of the first of single bounces
  double error = 0;       ///< RMSE of the total at ρ = 0.8 expected from gathers alone; 0 of a plan that was
                          ///< not made for an error
  double unevenness = 1;  ///< of the light that the azimuths are planned for, beside the sky's: how much more
                          ///< its radiosity varies over what is seen. More uneven light gets more of them
};

/// Both walks of one map.
struct HorizonPlan {
  SkyPlan sky = {};
  GatherPlan gather = {};
};

/// Throws UsageError for a plan that cannot be walked: azimuths must be even, from 2 to 65536 of the sky and
/// to 4096 of gathers; a multiple of 4 of the sky where open ground walks every other one (full_from > 0); a
/// samples per octave from 1 to 128, a share of the peaks from 0 to 1.
void check_horizon_plan(const HorizonPlan& plan);

/// The operator by horizon walks as planned: nothing is stored, each gather walks. `surface` must outlive it.
/// `error` > 0 is the RMSE that solve() aims at, in units of the brightest direct irradiance. Throws
/// UsageError as check_horizon_plan does.
std::unique_ptr<Transport> build_horizon_transport(const Surface& surface, const HorizonPlan& plan,
                                                   double error = 0.002, const Watch& watch = {});

struct PlannedTransport {
  HorizonPlan plan;
  std::unique_ptr<Transport> transport;
  SkyMoments moments;  ///< those that were wanted
};

/// What a plan is to reach.
struct HorizonGoal {
  double error = 0.002;    ///< RMSE > 0 of A, and of the total irradiance at albedos up to 0.8
  int azimuths = 0;        ///< > 0: those of the sky, fixed
  std::uint64_t seed = 1;  ///< of the sample of receivers
  double sky_share = 1;    ///< of the error, that A may have: less where finer things hang on its walk
  std::span<const TexelVector> direct = {};  ///< E₀/π of light of one's own that totals are to be of, each
                                             ///< in units of its brightest; empty: the sky's
};

/// Chooses a plan by trying ways of walking on a sample of receivers against exact walks; then builds.
PlannedTransport plan_horizon_transport(const Surface& surface, const HorizonGoal& goal,
                                        const SkyWanted& wanted = {}, const Watch& watch = {});

/// What a finished solution errs by, found on some hundred receivers by exact walks (which share no code with
/// the fast ones). A is compared with their sky. Of the total an exact gather of the same light tells only
/// what is wrong at its last step, r = direct + F ρ T − T. The error itself, e = r + F ρ e, also has what is
/// wrong with the light that is gathered. For that, its means over receivers of like A are solved for, with
/// the exact walks' form factors between them, and half of what differs from those means is taken to be seen,
/// too.
struct HorizonCheck {
  int receivers = 0;
  int azimuths = 0;
  double ambient_rmse = 0;          ///< of α; 0 where it was not given
  double sky_rmse = 0;              ///< of A
  double total_rmse = 0;            ///< of E/π
  double total_standard_error = 0;  ///< of total_rmse: it lies within twice that of the truth, mostly
};

/// What is checked: a total, and the surface and the light that it is of.
struct CheckedTotal {
  const TexelVector& total;              ///< E/π of all bounces, per texel
  double albedo = 0;                     ///< where it is the same everywhere
  const TexelVector* varying = nullptr;  ///< the albedo per texel, where it is not
  const TexelVector* direct = nullptr;   ///< E₀/π of light of one's own, where it is not the sky's
};

/// How a check goes about.
struct CheckOptions {
  std::uint64_t seed = 1;                  ///< of the receivers
  double error = 0;                        ///< RMSE wanted; 0: none, every figure is to be exact
  const Map* ambient_occlusion = nullptr;  ///< α to be compared, too
  bool above_horizontal = false;           ///< light of one's own is the sky's, but for what is below the
                                           ///< horizontal: it is checked, too
  Watch watch = {};
};

/// Checks totals at the same receivers, one figure each: 512 receivers, and up to four times as many while
/// the standard error of any figure passes a tenth of it or leaves open whether the error wanted is missed,
/// unless it clearly meets it. `sky` is A per texel, as found.
std::vector<HorizonCheck> check_by_exact_walks(const Surface& surface, const TexelVector& sky,
                                               const std::vector<CheckedTotal>& totals,
                                               const CheckOptions& options = {});

/// The solution x of x = source + F (ρ x), to a residual of 1e-8 of the source's norm, by BiCGSTAB, of stored
/// links (gathers of walks are too coarse for it); `guess` is where it starts. `albedo` is ρ per texel, in
/// [0, 1].
struct Equilibrium {
  TexelVector irradiance;
  int iterations = 0;
  double residual = 0;  ///< |source + F ρ x − x| / |source|
};
Equilibrium solve_equilibrium(const Transport& transport, const TexelVector& source,
                              const TexelVector& albedo, const TexelVector& guess, const Watch& watch = {});

/// Bounces at ρ = 1, from which those at any constant albedo follow: E_b(ρ) = ρ^b E_b. All values are E/π.
struct BounceSeries {
  int bounces = 0;             ///< K: the last one
  TexelVector sum;             ///< E₀ + … + E_K
  TexelVector last;            ///< E_K
  TexelVector next;            ///< E_{K+1} = F E_K
  double spectral_radius = 0;  ///< of F, by the Rayleigh quotient of E_K: a lower bound that E_K makes tight
};

/// Computes E_0 … E_K and hands each to `visit(b, E_b)` as it is made. Texels weigh 1/n_z, their area, in the
/// Rayleigh quotient, under which F is symmetric.
BounceSeries bounce(const Transport& transport, const Surface& surface, int bounces,
                    const std::function<void(int, const TexelVector&)>& visit, const Watch& watch = {});

/// What all bounces after the K-th bring at constant albedo ρ: ρ^{K+1} t, with t = E_{K+1} + ρ F t.
Equilibrium solve_tail(const Transport& transport, const BounceSeries& series, double albedo,
                       const Watch& watch = {});

/// The same without solving, from conservation. At ρ = 1 all bounces sum to 1, so that T = 1 − (E₀ + … + E_K)
/// is left. Taking the bounces from the K-th on to fall by one ratio q per texel, which E_K and T fix (E_K
/// q/(1 − q) = T), what is left at ρ is
///     ρ^{K+1} T (1 − q)/(1 − ρ q),   q = T/(T + E_K).
/// Exact at ρ = 1 and, as a share of the total, ever better the smaller ρ^{K+1} T is. `last` is E_K, `sum` E₀
/// + … + E_K. 0 where missing.
TexelVector conserve_tail(const Transport& transport, const TexelVector& sum, const TexelVector& last,
                          int bounces, double albedo);

/// The same of one receiver, from its own E₀ + … + E_K and E_K.
double conserve_tail(double sum, double last, int bounces, double albedo);

/// Values as a map, NaN where the surface has no receiver.
Map to_map(const TexelVector& values, const Surface& surface);

}  // namespace heightlight
