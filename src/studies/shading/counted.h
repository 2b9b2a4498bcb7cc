#pragma once

#include <cmath>

namespace heightlight {

/// A number that counts what is done with it, for operations per texel: the closed forms are templates, so
/// that what is counted is what is run. Of one thread; constants are free, and so are comparisons.
struct Counted {
  double value = 0;
  static inline thread_local long arithmetic = 0;  ///< additions, subtractions, multiplications, divisions
  static inline thread_local long functions = 0;   ///< roots, powers, circular functions

  constexpr Counted() = default;
  constexpr explicit Counted(double number) : value(number) {}

  static Counted done(double number) {
    ++arithmetic;
    return Counted(number);
  }
  static Counted called(double number) {
    ++functions;
    return Counted(number);
  }

  friend Counted operator+(const Counted& a, const Counted& b) { return done(a.value + b.value); }
  friend Counted operator-(const Counted& a, const Counted& b) { return done(a.value - b.value); }
  friend Counted operator*(const Counted& a, const Counted& b) { return done(a.value * b.value); }
  friend Counted operator/(const Counted& a, const Counted& b) { return done(a.value / b.value); }
  friend bool operator<(const Counted& a, const Counted& b) { return a.value < b.value; }
  friend Counted sqrt(const Counted& a) { return called(std::sqrt(a.value)); }
};

/// What `run` does.
struct OperationCount {
  long arithmetic = 0;
  long functions = 0;
};

template <class Run>
OperationCount count_operations(const Run& run) {
  Counted::arithmetic = Counted::functions = 0;
  run();
  return {Counted::arithmetic, Counted::functions};
}

}  // namespace heightlight
