#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "base/fixed_sum.h"
#include "base/hash.h"

using namespace heightlight;

TEST_CASE("A fixed sum is the same in any order, and right to 2^-63 a term", "[base]") {
  std::vector<double> terms;
  long double exact = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    const double term = std::ldexp(unit_real(scramble(i)) - 0.4, static_cast<int>(i % 50) - 40);
    terms.push_back(term);
    exact += term;
  }
  FixedSum forwards;
  for (const double term : terms) forwards.add(term);
  FixedSum parts[3];
  std::reverse(terms.begin(), terms.end());
  for (std::size_t i = 0; i < terms.size(); ++i) parts[i % 3].add(terms[i]);
  FixedSum backwards = parts[2];
  backwards.add(parts[0]);
  backwards.add(parts[1]);
  CHECK(forwards == backwards);
  CHECK(std::fabs(forwards.value() - static_cast<double>(exact)) < 1e-15);
  FixedSum negative;
  negative.add(-1e-3);
  negative.add(-5);
  CHECK(negative.value() == Approx(-5.001).epsilon(1e-15));
  CHECK(FixedSum(negative.whole(), negative.part()) == negative);
}
