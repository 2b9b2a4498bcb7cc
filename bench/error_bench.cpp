// Time to error: what each method needs, including set-up, to find a whole map with a given root mean square
// error. All methods run in one process, one after the other, on the same maps. They are compared with
// Embree, in the fastest of its modes.
//
// Choice of maps: brick has cliffs and deep joints, fBm has slopes at every scale, ground054 is a scanned
// material. There are two sizes because a ray costs more on a larger map. Choice of errors: in an image of
// eight bits, .002 is half a level and .001 a quarter; for the total of all bounces, on the same scale, the
// target is .005, a level and a quarter. The sky at 1024² takes twelve minutes on two cores; the whole
// benchmark takes up to 3 GB.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench_map.h"
#include "embree_methods.h"
#include "horizon_method.h"
#include "ray_methods.h"
#include "result_table.h"
#include "sky_reference.h"
#include "total_reference.h"

namespace heightlight {
namespace {

constexpr double kAlbedo = 0.8;

/// The methods to compare. To add one, write a function that returns a Method, and add a line here.
std::vector<Method> sky_methods(const Surface& surface, const EmbreeBest& embree) {
  std::vector<Method> methods = embree_sky_methods(surface, embree);
  methods.push_back(ray_sky_method(surface));
  for (Method& method : horizon_sky_methods(surface)) methods.push_back(std::move(method));
  return methods;
}

std::vector<Method> total_methods(const Surface& surface) {
  return {ray_total_method(surface, kAlbedo), horizon_total_method(surface, kAlbedo)};
}

void print_embree_ways(const EmbreeBest& best) {
  std::printf("Embree's ways: core-ns per ray, %d rays per texel\n%-26s", kEmbreeTrialRays, "");
  for (const EmbreeTree& tree : best.trees) {
    std::printf(" %16s", tree.primitive == EmbreePrimitive::quad ? "quads" : "triangles");
  }
  std::printf("\n%-26s", "tree: quality, core-s");
  for (const EmbreeTree& tree : best.trees) {
    const char* quality = tree.quality == RTC_BUILD_QUALITY_HIGH ? "high" : "medium";
    std::printf(" %9s %6.3f", quality, tree.built.core);
  }
  const std::vector<EmbreeMode> modes = embree_modes();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    std::printf("\n%-26s", to_string(modes[i]).c_str());
    for (const EmbreeTree& tree : best.trees) std::printf(" %16.1f", tree.ray_core_ns[i]);
  }
  std::printf("\nchosen: %s, tree of %.3f core-s; of packets: %s, tree of %.3f core-s\n",
              to_string(best.any.mode).c_str(), best.any.built.core, to_string(best.packets.mode).c_str(),
              best.packets.built.core);
}

/// Prints how far a method is from the reference with so many rays that its own noise is negligible.
void print_bias(const Method& method, const ReferenceValues& reference) {
  constexpr int kRays = 65536;
  method.set_up(kRays);
  const std::vector<float> values = method.run_receivers(kRays, reference.receivers);
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] - reference.values[i];
  std::printf("%s, %d rays: RMSE %.5f, mean %+.5f\n", method.name.c_str(), kRays,
              rmse(values, reference.values), sum / static_cast<double>(values.size()));
}

/// The results, and where they are written.
struct Tables {
  ResultTable results;
  std::string csv;                   ///< path of the results; empty: standard output only
  std::optional<CurveTable> curves;  ///< only if curves are wanted
  std::string curve_csv;

  void write() const {
    if (!csv.empty()) results.write_csv(csv);
    if (curves) curves->write_csv(curve_csv);
  }
};

void race(Tables& tables, const RaceName& name, const std::vector<Method>& methods, const Surface& surface,
          const ReferenceValues& reference, const std::vector<double>& targets) {
  std::vector<TimeToError> results;
  for (const Method& method : methods) {
    for (const TimeToError& result : time_to_error(method, surface, reference, targets)) {
      results.push_back(result);
    }
  }
  tables.results.add(name, results);
  if (!tables.curves) return;
  // Curves of methods that trace rays end at the last target, those of walks at half of it.
  for (const Method& method : methods) {
    const double least_error = targets.back() * (method.run_map && !method.is_baseline ? 0.5 : 1);
    tables.curves->add(name, error_curve(method, surface, reference, least_error));
  }
}

void race_sky(Tables& tables, const std::string& map, const Surface& surface) {
  constexpr int kReceivers = 1024;
  std::printf("\n== sky view factor A, %s, %d ==\n", map.c_str(), surface.width());
  const SkyReference sky = make_sky_reference(surface, kReceivers);
  std::printf("reference: %d receivers, 2 × 65536 rays, own RMSE %.6f\n", kReceivers, sky.own_rmse);
  const EmbreeBest embree = find_embree_best(surface);
  print_embree_ways(embree);
  const std::vector<Method> methods = sky_methods(surface, embree);
  print_bias(methods.front(), sky.reference);
  race(tables, {"sky view factor", map, surface.width()}, methods, surface, sky.reference, {0.002, 0.001});
}

/// Makes the reference for totals again, with different rays and twice as many per texel, on a map where that
/// is cheap, and prints the difference.
void print_total_reference_error(const std::string& map) {
  constexpr int kSize = 256;
  const Surface surface = build_surface(make_bench_map(map, kSize).value());
  TotalReferenceOptions options;
  options.albedo = kAlbedo;
  const ReferenceValues reference = make_total_reference(surface, options);
  options.seed += 1;
  options.field_rays *= 2;
  const ReferenceValues other = make_total_reference(surface, options);
  std::printf("\nreference of totals, %s, %d: RMSE %.6f from one of other rays, and twice as many\n",
              map.c_str(), kSize, rmse(reference.values, other.values));
}

void race_total(Tables& tables, const std::string& map, const Surface& surface) {
  TotalReferenceOptions options;
  options.albedo = kAlbedo;
  std::printf("\n== total irradiance / π at albedo %g, all bounces, %s, %d ==\n", kAlbedo, map.c_str(),
              surface.width());
  const ReferenceValues reference = make_total_reference(surface, options);
  std::printf("reference: %d receivers, 65536 rays each, over a field of %d rays per texel\n",
              options.receivers, options.field_rays);
  race(tables, {"total irradiance", map, surface.width()}, total_methods(surface), surface, reference,
       {0.005});
}

struct Options {
  std::vector<std::string> maps{"brick", "fbm", "ground054"};
  std::vector<int> sizes{512, 1024};
  std::string section = "both";
  std::string csv;
  std::string curve;
};

void run(const Options& options) {
  std::printf(
      "core-s: processor seconds of all threads, with the set-up; that alone: 0 where it is in the run\n"
      "others: processors that other programs kept busy meanwhile; wall times suffer from them\n"
      "gain: how many times cheaper than the cheapest baseline (Embree; stored links)\n"
      "*: timed on rows from all over the map, and multiplied\n"
      "%d threads\n",
      thread_count());
  Tables tables;
  tables.csv = options.csv;
  tables.curve_csv = options.curve;
  if (!options.curve.empty()) tables.curves.emplace();
  for (const std::string& map : options.maps) {
    if (!make_bench_map(map, options.sizes.front())) {
      std::printf("\n%s is not there: left out\n", map.c_str());
      continue;
    }
    if (options.section != "a") print_total_reference_error(map);
    for (const int size : options.sizes) {
      const Surface surface = build_surface(make_bench_map(map, size).value());
      if (options.section != "total") race_sky(tables, map, surface);
      if (options.section != "a") race_total(tables, map, surface);
      tables.write();
    }
  }
}

}  // namespace
}  // namespace heightlight

int main(int argument_count, char** arguments) {
  try {
    heightlight::Options options;
    CLI::App app("Time to error, ours and Embree's; the head of the source says more");
    app.add_option("--maps", options.maps, "brick, fbm, ground054")
        ->delimiter(',')
        ->check(CLI::IsMember({"brick", "fbm", "ground054"}));
    app.add_option("--sizes", options.sizes, "texels along an edge")
        ->delimiter(',')
        ->check(CLI::Range(64, 4096));
    app.add_option("--section", options.section, "a (sky view factor), total, or both")
        ->check(CLI::IsMember({"a", "total", "both"}));
    app.add_option("--csv", options.csv, "file for the results");
    app.add_option("--curve", options.curve, "file for all settings' errors and times");
    CLI11_PARSE(app, argument_count, arguments);
    heightlight::run(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heightlight_error_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
