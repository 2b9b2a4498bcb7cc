#include "cli/plots.h"

#include <fstream>

#include "cli/tell.h"
#include "plot/gnuplot_run.h"

namespace heightlight {

Plots::Plots() {
  if (const std::string fault = gnuplot_fault(); !fault.empty()) give_up(fault);
}

namespace {

/// What gnuplot's terminals svg and pngcairo begin with.
void check_picture(const std::filesystem::path& path) {
  const std::string begin = path.extension() == ".svg" ? "<?xml" : "\x89PNG\r\n";
  std::string bytes(begin.size(), '\0');
  std::ifstream(path, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (bytes != begin) throw PlotError("plots need gnuplot, but it drew no picture");
}

}  // namespace

void Plots::give_up(const std::string& fault) {
  possible_ = false;
  tell(fault + "; the results will have no plots");
}

void Plots::draw(StagedFolder& folder, const std::vector<std::string>& names,
                 const std::function<void(const std::vector<std::filesystem::path>&)>& draw) {
  if (!possible_) return;
  std::vector<std::filesystem::path> paths;
  for (const std::string& name : names) paths.push_back(folder.file(name));
  try {
    draw(paths);
    for (const std::filesystem::path& path : paths) check_picture(path);
  } catch (const PlotError& error) {
    for (const std::string& name : names) folder.leave_out(name);
    give_up(error.what());
  }
}

void Plots::check() const {
  if (!possible_) throw PlotsMissing();
}

}  // namespace heightlight
