// How time, memory and error grow with the size of the map: for the sky by a fixed walk, then for the sky and
// the total of all bounces with a fixed error, as `simulate` plans them.
//
// All maps have an open boundary and a relief of a tenth of the width. Larger maps have finer detail (fBm
// down to two texels, sharper bricks). Each map is processed in a process of its own, whose peak of memory is
// therefore that of the map. Neither time nor memory includes making the map, and finding the errors by exact
// walks from some hundreds of receivers. All maps up to 4096 take about four minutes on two cores, and 2 GB.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "bench_map.h"
#include "heightlight/error.h"
#include "heightlight/transport.h"
#include "transport/horizon_plan.h"
#include "transport/progressive_gather.h"
#include "visibility/horizon_sky.h"

namespace heightlight {
namespace {

constexpr double kAlbedo = 0.8;
constexpr WalkOptions kFixedWalk{.azimuths = 32, .samples_per_octave = 16, .peak_share = 0.3F};

/// Results for one map. A plain struct, so that it can go through a pipe.
struct Growth {
  Cost fixed_walk;
  Cost calibration;  ///< exact walks of the calibration sample
  Cost sky;          ///< including the pyramid, and the choice of the walk
  Cost plan;         ///< planning of the gathers, including the heights that they look at
  Cost totals;       ///< all gathers
  int sky_azimuths = 0;
  int sky_fineness = 0;
  int gather_azimuths = 0;  ///< number of azimuths of each of the last two gathers
  int gather_fineness = 0;
  int gathers = 0;
  double peak_bytes = 0;  ///< largest resident memory of the process until the totals exist
  HorizonCheck check;

  Cost all() const { return calibration + sky + plan + totals; }
};

/// Largest resident memory of this process so far, in bytes.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

struct Options {
  std::vector<std::string> maps{"brick", "fbm"};
  int smallest = 256;
  int largest = 4096;
  double error = HorizonGoal{}.error;
  std::string csv;
};

/// What totals are gathered from. Other data of the planning are released by then.
struct Planned {
  Map sky;
  PlannedGather gather;
};

/// Plans and finds the sky, and plans the gathers, with the same parts as `simulate`, so that each step can
/// be timed.
Planned plan(const Surface& surface, const Options& options, Growth& growth) {
  HorizonGoal goal;
  goal.error = options.error;
  const Stopwatch calibration_watch;
  GatherCalibration calibration(surface, {.seed = goal.seed});
  growth.calibration = calibration_watch.elapsed();
  const Stopwatch sky_watch;
  const HeightPyramid pyramid = build_height_pyramid(surface);
  PlannedSky sky = find_sky_for_totals(pyramid, goal, {}, calibration, {});
  growth.sky = sky_watch.elapsed();
  const Stopwatch plan_watch;
  Planned planned{.sky = {}, .gather = plan_gather(calibration, pyramid, goal.error, sky)};
  growth.plan = plan_watch.elapsed();
  planned.sky = std::move(sky.sky.sky_view_factor);
  growth.sky_azimuths = sky.plan.walk.azimuths;
  growth.sky_fineness = sky.plan.walk.samples_per_octave;
  growth.gather_azimuths = planned.gather.plan.walk.azimuths;
  growth.gather_fineness = planned.gather.plan.walk.samples_per_octave;
  return planned;
}

Growth measure(const Options& options, const std::string& map, int size) {
  const Surface surface = build_surface(make_bench_map(map, size).value());
  Growth growth;
  {
    const HeightPyramid pyramid = build_height_pyramid(surface);
    growth.fixed_walk = least_cost([&] { walk_horizon_sky(surface, pyramid, {.walk = kFixedWalk}); });
  }
  const Planned planned = plan(surface, options, growth);
  const ProgressiveGoal goal{.error = options.error, .last_azimuths = growth.gather_azimuths};
  const Stopwatch watch;
  const ProgressiveSolution solution =
      gather_progressively(*planned.gather.gather, planned.sky, {{.albedo = kAlbedo}}, goal, {});
  growth.totals = watch.elapsed();
  growth.gathers = solution.gathers;
  growth.peak_bytes = peak_memory();
  const TexelVector sky(planned.sky.values.begin(), planned.sky.values.end());
  growth.check =
      check_by_exact_walks(surface, sky, {{.total = solution.irradiance[0], .albedo = kAlbedo}})[0];
  return growth;
}

/// As above, in a process of its own. This process must not have used threads yet, because threads do not
/// survive a fork.
Growth measure_apart(const Options& options, const std::string& map, int size) {
  int ends[2];
  if (pipe(ends) != 0) throw Error("no pipe to another process");
  const pid_t child = fork();
  if (child < 0) throw Error("no other process");
  if (child == 0) {
    try {
      const Growth growth = measure(options, map, size);
      if (write(ends[1], &growth, sizeof growth) == sizeof growth) _exit(0);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "heightlight_growth_bench: %s\n", error.what());
    }
    _exit(1);
  }
  close(ends[1]);
  Growth growth;
  const bool whole = read(ends[0], &growth, sizeof growth) == sizeof growth;
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!whole || status != 0) throw Error(map + ", " + std::to_string(size) + ": could not be measured");
  return growth;
}

void print_head(const Options& options) {
  std::printf(
      "fixed walk: core-ns per texel and azimuth, %d azimuths, %d samples per octave\n"
      "the rest: sky and totals at albedo %g, planned for an error of %g; core-seconds\n"
      "others: processors that other programs kept busy meanwhile; wall times suffer from them\n"
      "B/texel: peak of memory; sky, walks: azimuths and samples per octave of the sky and of the last two "
      "gathers\n"
      "RMSE: by exact walks\n"
      "%-6s %6s %6s %7s %7s %7s %7s %8s %8s %6s %8s %8s %-8s %-8s %7s %8s %8s\n",
      kFixedWalk.azimuths, kFixedWalk.samples_per_octave, kAlbedo, options.error, "map", "size", "fixed",
      "calibrate", "sky", "plan", "totals", "core-s", "wall-s", "others", "peak MB", "B/texel", "sky",
      "walks", "gathers", "RMSE A", "total");
}

void print_row(const std::string& map, int size, const Growth& g) {
  const double texels = static_cast<double>(size) * size;
  const std::string sky = std::to_string(g.sky_azimuths) + "/" + std::to_string(g.sky_fineness);
  const std::string walks = std::to_string(g.gather_azimuths) + "/" + std::to_string(g.gather_fineness);
  const Cost all = g.all();
  std::printf(
      "%-6s %6d %6.2f %7.3f %7.3f %7.3f %7.3f %8.3f %8.3f %6.2f %8.0f %8.1f %-8s %-8s %7d %8.5f %8.5f\n",
      map.c_str(), size, 1e9 * g.fixed_walk.core / (texels * kFixedWalk.azimuths), g.calibration.core,
      g.sky.core, g.plan.core, g.totals.core, all.core, all.wall, all.others / all.wall, 1e-6 * g.peak_bytes,
      g.peak_bytes / texels, sky.c_str(), walks.c_str(), g.gathers, g.check.sky_rmse, g.check.total_rmse);
  std::fflush(stdout);
}

void write_row(std::ostream& file, const std::string& map, int size, const Growth& g) {
  const double texels = static_cast<double>(size) * size;
  const Cost all = g.all();
  file << map << ',' << size << ',' << 1e9 * g.fixed_walk.core / (texels * kFixedWalk.azimuths) << ','
       << g.calibration.core << ',' << g.sky.core << ',' << g.plan.core << ',' << g.totals.core << ','
       << all.core << ',' << all.wall << ',' << all.others << ',' << g.peak_bytes << ','
       << g.peak_bytes / texels << ',' << g.sky_azimuths << ',' << g.sky_fineness << ',' << g.gather_azimuths
       << ',' << g.gather_fineness << ',' << g.gathers << ',' << g.check.sky_rmse << ',' << g.check.total_rmse
       << '\n';
}

void run(const Options& options) {
  std::ofstream file;
  if (!options.csv.empty()) {
    file.open(options.csv);
    file << "map,size,fixed_walk_core_ns,calibration_core_s,sky_core_s,plan_core_s,totals_core_s,core_s,"
            "wall_s,others_core_s,peak_bytes,bytes_per_texel,sky_azimuths,sky_fineness,gather_azimuths,"
            "gather_fineness,gathers,rmse_sky,rmse_total\n";
  }
  print_head(options);
  for (const std::string& map : options.maps) {
    for (int size = options.smallest; size <= options.largest; size *= 2) {
      const Growth growth = measure_apart(options, map, size);
      print_row(map, size, growth);
      if (file.is_open()) write_row(file, map, size, growth);
    }
  }
  file.close();
  if (!options.csv.empty() && !file) throw Error(options.csv + ": could not be written");
}

}  // namespace
}  // namespace heightlight

int main(int argument_count, char** arguments) {
  try {
    heightlight::Options options;
    CLI::App app("Time, memory and error against the size of the map; the head of the source says more");
    app.add_option("--maps", options.maps, "brick, fbm")
        ->delimiter(',')
        ->check(CLI::IsMember({"brick", "fbm"}));
    app.add_option("--smallest", options.smallest, "texels along an edge, doubled up to")
        ->check(CLI::Range(64, 16384));
    app.add_option("--largest", options.largest, "this (4096)")->check(CLI::Range(64, 16384));
    app.add_option("--error", options.error, "RMSE wanted, of A and of the total")
        ->check(CLI::PositiveNumber);
    app.add_option("--csv", options.csv, "file for the results");
    CLI11_PARSE(app, argument_count, arguments);
    heightlight::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heightlight_growth_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
