#pragma once

#include <cstdint>
#include <vector>

#include "heightlight/occlusion_forms.h"

namespace heightlight {

/// ∫ Y_i Y_j Y_k dω of three harmonics of l ≤ 2, i ≤ j ≤ k.
struct ProductTerm {
  std::uint8_t i = 0;
  std::uint8_t j = 0;
  std::uint8_t k = 0;
  double value = 0;
};

/// All terms that are not 0.
const std::vector<ProductTerm>& product_terms();

/// ∫ a b c dω of three functions, given by their harmonics (the triple product of Snyder 2006). It is a sum
/// over the terms, each in all orders of its three harmonics.
template <class Real>
Real triple_product(const NineHarmonics<Real>& a, const NineHarmonics<Real>& b,
                    const NineHarmonics<Real>& c) {
  Real sum(0);
  for (const ProductTerm& term : product_terms()) {
    const auto [i, j, k, value] = term;
    Real orders = a[i] * (j == k ? b[j] * c[k] : b[j] * c[k] + b[k] * c[j]);
    if (i != j) orders = orders + a[j] * (i == k ? b[i] * c[k] : b[i] * c[k] + b[k] * c[i]);
    if (k != j && k != i) orders = orders + a[k] * (i == j ? b[i] * c[j] : b[i] * c[j] + b[j] * c[i]);
    sum = sum + Real(value) * orders;
  }
  return sum;
}

}  // namespace heightlight
