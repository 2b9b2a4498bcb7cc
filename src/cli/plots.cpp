#include "cli/plots.h"

#include <fmt/core.h>

#include <cstdio>

#include "files/printable.h"
#include "plot/gnuplot_run.h"

namespace heightlight {

Plots::Plots() {
  if (const std::string fault = gnuplot_fault(); !fault.empty()) give_up(fault);
}

void Plots::give_up(const std::string& fault) {
  possible_ = false;
  fmt::print(stderr, "heightlight: {}; the results will lack their plots\n", printable(fault));
}

void Plots::draw(StagedFolder& folder, const std::vector<std::string>& names,
                 const std::function<void(const std::vector<std::filesystem::path>&)>& draw) {
  if (!possible_) return;
  std::vector<std::filesystem::path> paths;
  for (const std::string& name : names) paths.push_back(folder.file(name));
  try {
    draw(paths);
  } catch (const PlotError& error) {
    for (const std::string& name : names) folder.leave_out(name);
    give_up(error.what());
  }
}

void Plots::check() const {
  if (!possible_) throw PlotsMissing();
}

}  // namespace heightlight
