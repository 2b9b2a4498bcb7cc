// Hard cases: the error and the cost of each method for visibility, on maps where something might break.
//
// The reference is A by exact slices along 1024 azimuths at up to 64 receivers; the tests compare these
// slices with an implementation in extended precision. Each method has the settings of a normal use: 1024
// rays, 128 exact azimuths, walks planned for an error of .002. `energy` is the largest |E₀ + … + E₂₀ + tail
// − 1| at albedo 1 over all texels; the tail is solved for where links are stored, and follows from
// conservation where bounces are found by walks.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "stability/hard_maps.h"
#include "visibility/exact_walk.h"

namespace heightlight {
namespace {

struct Way {
  const char* name;
  std::function<std::unique_ptr<Transport>(const Surface&)> find;
};

std::vector<Way> ways() {
  return {{"rays",
           [](const Surface& surface) {
             return std::make_unique<FormFactors>(build_form_factors(surface, {.rays = 1024, .seed = 1}, {}));
           }},
          {"exact slices",
           [](const Surface& surface) {
             return std::make_unique<FormFactors>(build_exact_form_factors(surface, 128, {}));
           }},
          {"horizon walks",
           [](const Surface& surface) { return plan_horizon_transport(surface, {}).transport; }}};
}

/// The reference: A at some receivers, given by their texels.
struct Answer {
  std::vector<std::size_t> texels;
  std::vector<double> values;
};

Answer find_answer(const Surface& surface) {
  constexpr int kAzimuths = 1024;
  constexpr std::size_t kReceivers = 64;
  const ExactWalker walker(surface, kAzimuths);
  const std::size_t size = surface.map.height.size();
  const std::size_t count = std::min(size, kReceivers);
  Answer answer;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t texel = size * i / count;
    SliceView view;
    walker.view(static_cast<int>(texel) / surface.width(), static_cast<int>(texel) % surface.width(), view);
    if (std::isnan(view.sky_view_factor)) continue;
    answer.texels.push_back(texel);
    answer.values.push_back(view.sky_view_factor);
  }
  return answer;
}

struct Finding {
  double rmse = 0;
  double largest = 0;
  double energy = 0;
  double core_seconds = 0;
};

double energy_error(const Surface& surface, const Transport& transport) {
  const BounceSeries series = bounce(transport, surface, 20, [](int, const TexelVector&) {});
  const TexelVector tail = transport.link_count() > 0
                               ? solve_tail(transport, series, 1).irradiance
                               : conserve_tail(transport, series.sum, series.last, series.bounces, 1);
  double largest = 0;
  for (std::size_t i = 0; i < tail.size(); ++i) {
    if (std::isnan(surface.map.height.values[i])) continue;
    largest = std::max(largest, std::fabs(series.sum[i] + tail[i] - 1));
  }
  return largest;
}

Finding try_way(const Way& way, const Surface& surface, const Answer& answer) {
  Finding finding;
  const Stopwatch watch;
  const std::unique_ptr<Transport> transport = way.find(surface);
  finding.core_seconds = watch.elapsed().core;
  double squares = 0;
  for (std::size_t i = 0; i < answer.texels.size(); ++i) {
    const double error = transport->direct[answer.texels[i]] - answer.values[i];
    squares += error * error;
    finding.largest = std::max(finding.largest, std::fabs(error));
  }
  finding.rmse = answer.values.empty() ? 0 : std::sqrt(squares / static_cast<double>(answer.values.size()));
  finding.energy = energy_error(surface, *transport);
  return finding;
}

void run(const std::string& csv) {
  std::ofstream file;
  if (!csv.empty()) {
    file.open(csv);
    file << "case,method,rmse,largest,energy,core_seconds\n";
  }
  std::printf("%-56s %-14s %9s %9s %9s %9s\n", "case", "method", "RMSE A", "largest", "energy", "core-ms");
  for (const HardMap& hard : hard_maps()) {
    const Surface surface = build_surface(hard.map);
    const Answer answer = find_answer(surface);
    for (const Way& way : ways()) {
      const Finding f = try_way(way, surface, answer);
      std::printf("%-56s %-14s %9.1e %9.1e %9.1e %9.2f\n", hard.name.c_str(), way.name, f.rmse, f.largest,
                  f.energy, f.core_seconds * 1e3);
      if (file.is_open()) {
        file << '"' << hard.name << "\"," << way.name << ',' << f.rmse << ',' << f.largest << ',' << f.energy
             << ',' << f.core_seconds << '\n';
      }
    }
  }
  if (!csv.empty() && !file.flush()) throw Error(csv + ": cannot be written");
}

}  // namespace
}  // namespace heightlight

int main(int argument_count, char** arguments) {
  try {
    CLI::App app("Errors and times on hard maps; the head of the source says more");
    std::string csv;
    app.add_option("--csv", csv, "file for the table");
    CLI11_PARSE(app, argument_count, arguments);
    heightlight::run(csv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heightlight_stability_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
