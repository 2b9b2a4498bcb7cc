#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace heightlight {

struct QuadratureNode {
  double at = 0;
  double weight = 0;
};

/// Nodes of the Gauss–Legendre rule with n ≥ 1 nodes on [0, 1], ascending; weights sum to 1. The rule is
/// exact for polynomials of degree 2n − 1. Nodes come from Newton's method on the three-term recurrence and
/// are accurate to a few roundings.
inline std::vector<QuadratureNode> gauss_legendre(int n) {
  std::vector<QuadratureNode> nodes;
  for (int i = n; i >= 1; --i) {
    double x = std::cos(std::numbers::pi * (i - 0.25) / (n + 0.5));
    double slope = 1;
    for (int step = 0; step < 8; ++step) {
      double before = 1;
      double here = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * here - (k - 1) * before) / k;
        before = here;
        here = next;
      }
      slope = n * (x * here - before) / (x * x - 1);
      x -= here / slope;
    }
    nodes.push_back({0.5 * (1 + x), 1 / ((1 - x * x) * slope * slope)});
  }
  return nodes;
}

}  // namespace heightlight
