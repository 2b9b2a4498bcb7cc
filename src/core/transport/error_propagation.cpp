#include "transport/error_propagation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace heightlight {
namespace {

using PerClass = SkyClasses::PerClass<double>;

/// Σ F ρ over all that a receiver sees.
double all_seen(const FoundError& error) {
  return std::accumulate(error.seen.begin(), error.seen.end(), 0.0);
}

/// Regression of r on Σ F ρ: the mean of r per unit of what is seen.
double error_per_seen(const std::vector<FoundError>& found) {
  double products = 0;
  double squares = 0;
  for (const FoundError& error : found) {
    products += all_seen(error) * error.residual;
    squares += all_seen(error) * all_seen(error);
  }
  return squares > 0 ? products / squares : 0;
}

/// Mean of r over the receivers of each class, with little of its random error, which would be passed on as
/// if the whole class had it. The part proportional to what is seen is known from all receivers. In the rest,
/// a class mean with standard error s has s² of its square by chance.
PerClass mean_residuals(const std::vector<FoundError>& found) {
  const double per_seen = error_per_seen(found);
  PerClass count{};
  PerClass seen{};
  PerClass sum{};
  for (const FoundError& error : found) {
    count[error.own_class] += 1;
    seen[error.own_class] += all_seen(error);
    sum[error.own_class] += error.residual - per_seen * all_seen(error);
  }
  PerClass of_mean{};  // the square of each mean's standard error
  for (const FoundError& error : found) {
    const std::size_t c = error.own_class;
    const double rest = error.residual - per_seen * all_seen(error) - sum[c] / count[c];
    of_mean[c] += std::pow(rest / count[c], 2);
  }
  PerClass means{};
  for (std::size_t c = 0; c < SkyClasses::kCount; ++c) {
    if (count[c] == 0) continue;
    const double mean = sum[c] / count[c];
    means[c] = per_seen * seen[c] / count[c];
    if (of_mean[c] > 0 && mean * mean > of_mean[c])
      means[c] += std::copysign(std::sqrt(mean * mean - of_mean[c]), mean);
  }
  return means;
}

/// Means of e over the receivers of each class: the mean of r, plus what F ρ gathers from the classes' means.
/// The Jacobi iteration converges since F ρ loses part of what it gathers; slowly where it loses hardly
/// anything.
PerClass solve_classes(const std::vector<FoundError>& found, const PerClass& residual) {
  constexpr int kIterations = 200;
  PerClass count{};
  SkyClasses::PerClass<PerClass> seen{};
  for (const FoundError& error : found) {
    count[error.own_class] += 1;
    for (std::size_t k = 0; k < SkyClasses::kCount; ++k) seen[error.own_class][k] += error.seen[k];
  }
  PerClass mean{};
  for (int i = 0; i < kIterations; ++i) {
    PerClass next{};
    for (std::size_t c = 0; c < SkyClasses::kCount; ++c) {
      if (count[c] == 0) continue;
      next[c] =
          residual[c] + std::inner_product(seen[c].begin(), seen[c].end(), mean.begin(), 0.0) / count[c];
    }
    mean = next;
  }
  return mean;
}

/// The share of d that the places seen have on average: the regression of the places' d on the receivers' d.
double share_of_places(const std::vector<FoundError>& found, const PerClass& residual) {
  double products = 0;
  double squares = 0;
  for (const FoundError& error : found) {
    if (!error.place) continue;
    const double own = error.residual - residual[error.own_class];
    products += all_seen(error) * own * (error.place->residual - residual[error.place->own_class]);
    squares += all_seen(error) * own * own;
  }
  return squares > 0 ? std::clamp(products / squares, 0.0, 1.0) : 0;
}

}  // namespace

std::vector<double> propagate_errors(const std::vector<FoundError>& found) {
  const PerClass residual = mean_residuals(found);
  const PerClass mean = solve_classes(found, residual);
  const double alike = share_of_places(found, residual);
  std::vector<double> errors;
  for (const FoundError& error : found) {
    const double usual = residual[error.own_class];
    const double passed_on = std::inner_product(error.seen.begin(), error.seen.end(), mean.begin(), 0.0);
    errors.push_back(usual + passed_on + (error.residual - usual) / (1 - alike * all_seen(error)));
  }
  return errors;
}

}  // namespace heightlight
