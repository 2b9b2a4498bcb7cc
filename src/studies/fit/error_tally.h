#pragma once

#include <algorithm>
#include <cmath>

namespace heightlight {

/// Weighted errors, model − measured, as they come in.
struct ErrorTally {
  double weight = 0;
  double sum = 0;
  double squares = 0;
  double largest = 0;  ///< |error|, whatever its weight

  void add(double error, double weight_of_it) {
    weight += weight_of_it;
    sum += weight_of_it * error;
    squares += weight_of_it * error * error;
    largest = std::max(largest, std::abs(error));
  }
  void add(const ErrorTally& other) {
    weight += other.weight;
    sum += other.sum;
    squares += other.squares;
    largest = std::max(largest, other.largest);
  }
  double bias() const { return weight > 0 ? sum / weight : 0; }
  double rms() const { return weight > 0 ? std::sqrt(squares / weight) : 0; }
};

}  // namespace heightlight
