#include "transport/error_propagation.h"

namespace heightlight {
namespace {

using PerClass = SkyClasses::PerClass<double>;

/// Means of e over the receivers of each class: those of r, and of what the classes' means bring by way of F
/// ρ. A Jacobi iteration converges since F ρ takes less than it finds; slowly where nearly nothing is lost.
PerClass solve_classes(const std::vector<FoundError>& found) {
  constexpr int kIterations = 200;
  PerClass count{};
  PerClass residual{};
  SkyClasses::PerClass<PerClass> seen{};
  for (const FoundError& error : found) {
    count[error.own_class] += 1;
    residual[error.own_class] += error.residual;
    for (std::size_t k = 0; k < SkyClasses::kCount; ++k) seen[error.own_class][k] += error.seen[k];
  }
  PerClass mean{};
  for (int i = 0; i < kIterations; ++i) {
    PerClass next{};
    for (std::size_t c = 0; c < SkyClasses::kCount; ++c) {
      if (count[c] == 0) continue;
      double sum = residual[c];
      for (std::size_t k = 0; k < SkyClasses::kCount; ++k) sum += seen[c][k] * mean[k];
      next[c] = sum / count[c];
    }
    mean = next;
  }
  return mean;
}

}  // namespace

std::vector<double> propagate_errors(const std::vector<FoundError>& found, double alike) {
  const PerClass mean = solve_classes(found);
  PerClass count{};
  PerClass residual{};
  for (const FoundError& error : found) {
    count[error.own_class] += 1;
    residual[error.own_class] += error.residual;
  }
  std::vector<double> errors;
  for (const FoundError& error : found) {
    const double usual = residual[error.own_class] / count[error.own_class];
    double all_seen = 0;
    double own = usual;
    for (std::size_t k = 0; k < SkyClasses::kCount; ++k) {
      all_seen += error.seen[k];
      own += error.seen[k] * mean[k];
    }
    errors.push_back(own + (error.residual - usual) / (1 - alike * all_seen));
  }
  return errors;
}

}  // namespace heightlight
