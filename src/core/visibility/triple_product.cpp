#include "visibility/triple_product.h"

#include <cmath>
#include <numbers>

#include "base/gauss_legendre.h"

namespace heightlight {
namespace {

/// Products of three harmonics are polynomials of degree 6, for which both rules are exact.
std::vector<ProductTerm> find_product_terms() {
  constexpr int kAround = 16;
  constexpr double kNothing = 1e-9;  // what rounding leaves of 0; the least term is 0.06
  std::array<std::array<std::array<double, 9>, 9>, 9> sums{};
  for (const QuadratureNode& node : gauss_legendre(8)) {
    const double z = 2 * node.at - 1;
    const double sine = std::sqrt(1 - z * z);
    for (int step = 0; step < kAround; ++step) {
      const double azimuth = 2 * std::numbers::pi * (step + 0.5) / kAround;
      const NineHarmonics<double> y =
          harmonics_along<double>({sine * std::cos(azimuth), sine * std::sin(azimuth), z});
      const double weight = node.weight * 4 * std::numbers::pi / kAround;
      for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t j = i; j < 9; ++j) {
          for (std::size_t k = j; k < 9; ++k) sums.at(i).at(j).at(k) += weight * y.at(i) * y.at(j) * y.at(k);
        }
      }
    }
  }
  std::vector<ProductTerm> terms;
  for (std::uint8_t i = 0; i < 9; ++i) {
    for (std::uint8_t j = i; j < 9; ++j) {
      for (std::uint8_t k = j; k < 9; ++k) {
        const double value = sums.at(i).at(j).at(k);
        if (std::fabs(value) > kNothing) terms.push_back({i, j, k, value});
      }
    }
  }
  return terms;
}

}  // namespace

const std::vector<ProductTerm>& product_terms() {
  static const std::vector<ProductTerm> kTerms = find_product_terms();
  return kTerms;
}

}  // namespace heightlight
