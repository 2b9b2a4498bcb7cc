#include "cli/simulation.h"
#include "files/evidence_json.h"
#include "files/output_file.h"
#include "heightlight/version.h"

namespace heightlight {

void write_summary(const std::filesystem::path& path, const SimulateOptions& options, const Surface& surface,
                   const Albedo& albedo, const Simulation& simulation) {
  const Evidence& evidence = simulation.evidence;
  nlohmann::ordered_json summary;
  summary["version"] = HEIGHTLIGHT_VERSION;
  if (!options.key.empty()) summary["key"] = options.key;
  summary["map"] = describe_map(options.map.path, simulation.facts.sha256, surface);
  summary["files"] = describe_files(simulation.files);
  summary["warnings"] = describe_warnings(simulation.warnings);
  summary.update(describe_evidence(evidence));
  summary["bounces"] = options.bounces;
  summary["albedo"] = albedo.varying.empty() ? nlohmann::ordered_json(albedo.constant)
                                             : nlohmann::ordered_json(options.albedo);
  if (!simulation.light.empty()) {
    summary["light"] = {{"of_total", simulation.light}, {"direct_rmse", simulation.light_rmse}};
  }
  nlohmann::ordered_json& times = summary["time_s"] = describe_times(evidence.seconds);
  times["load"] = simulation.seconds.load;
  if (!simulation.light.empty()) times["light"] = simulation.seconds.light;
  times["curves"] = simulation.seconds.curves;
  times["output"] = simulation.seconds.output;
  times["total"] = simulation.seconds.total;
  summary["memory"] = describe_memory(evidence);
  summary["threads"] = evidence.threads;
  write_bytes(path, json_text(summary));
}

}  // namespace heightlight
