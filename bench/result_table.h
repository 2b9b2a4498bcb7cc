#pragma once

#include <string>
#include <vector>

#include "time_to_error.h"

namespace heightlight {

/// What is measured: a quantity on a map.
struct RaceName {
  std::string quantity;  ///< "sky view factor"
  std::string map;
  int size = 0;
};

/// Collects results, and prints those of each race on standard output as they arrive.
class ResultTable {
 public:
  void add(const RaceName& race, const std::vector<TimeToError>& results);

  /// Writes the results as comma-separated values. Throws Error when the file cannot be written.
  void write_csv(const std::string& path) const;

 private:
  struct Row {
    RaceName race;
    TimeToError result;
    double core_gain;  ///< baseline's core-seconds over this method's; NaN if either misses the target
    double wall_gain;
  };
  std::vector<Row> rows_;
};

/// Collects whole curves of error against time.
class CurveTable {
 public:
  void add(const RaceName& race, const std::vector<CurvePoint>& curve);

  /// Writes the points as comma-separated values. Throws Error when the file cannot be written.
  void write_csv(const std::string& path) const;

 private:
  struct Row {
    RaceName race;
    CurvePoint point;
  };
  std::vector<Row> rows_;
};

}  // namespace heightlight
