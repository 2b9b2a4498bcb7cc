#pragma once

#include <filesystem>
#include <vector>

#include "cli/simulation.h"
#include "heightlight/curves.h"
#include "heightlight/solve.h"
#include "report/preview.h"

namespace heightlight {

/// Bounces that the report shows, from b = 0.
constexpr int kReportedBounces = 6;

/// What a simulation found, as far as its report shows it.
struct ReportedSimulation {
  const Surface& surface;
  const Results& results;
  const std::vector<Map>& totals;
  const std::vector<Map>& direct;           ///< of light of one's own; empty: an even sky's
  const std::vector<Preview>& bounces;      ///< the first of them, at albedo 1
  const std::vector<BounceCurves>& curves;  ///< over α, and over A
};

/// Bytes of the pictures, and of the page while it is made.
std::uint64_t simulation_report_bytes(int width, int height, const Albedo& albedo, bool has_own_light);

/// Writes report.html. Throws OutputError.
void write_simulation_report(const std::filesystem::path& path, const SimulateOptions& options,
                             const Simulation& simulation, const ReportedSimulation& found);

}  // namespace heightlight
