#pragma once

#include <functional>
#include <string>
#include <vector>

#include "files/staged_output.h"

namespace heightlight {

/// Thrown when all results are there but plots, which has been told. The command then exits with
/// kExitWithoutPlots.
struct PlotsMissing {};
constexpr int kExitWithoutPlots = 3;

/// The plots of a command's results. Where gnuplot does not work, that is told once, and the results do
/// without.
class Plots {
 public:
  /// Looks for gnuplot, before anything is computed.
  Plots();

  /// Whether plots can be drawn, as far as is known.
  bool possible() const { return possible_; }

  /// Calls draw() with the places of the files of these names, which it writes. Where it throws PlotError,
  /// the folder has no such files.
  void draw(StagedFolder& folder, const std::vector<std::string>& names,
            const std::function<void(const std::vector<std::filesystem::path>&)>& draw);

  /// Throws PlotsMissing where any was left out.
  void check() const;

 private:
  void give_up(const std::string& fault);

  bool possible_ = true;
};

}  // namespace heightlight
