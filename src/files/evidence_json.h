#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "files/file_record.h"
#include "heightlight/evidence.h"
#include "heightlight/files.h"
#include "heightlight/surface.h"

// The parts that all files describing a solution have in common, with the same keys in each: summary.json,
// NAME_bake.json, compare.json, dataset.json.

namespace heightlight {

/// Measures that need a look at all heights.
struct MapMeasures {
  double relief = 0;
  std::uint64_t missing = 0;
};

/// Describes a file's map as it was understood: path, sha256, width, height, texel, relief, boundary,
/// missing; and `lowered_by` where the Earth's curvature was applied. `header` needs no heights, only their
/// size.
nlohmann::ordered_json describe_map(const std::filesystem::path& path, const std::string& sha256,
                                    const Heightmap& header, const MapMeasures& measures);

/// As above, for a map whose heights are loaded.
nlohmann::ordered_json describe_map(const std::filesystem::path& path, const std::string& sha256,
                                    const Surface& surface);

/// The keys `visibility`, `links`, `energy_audit`, `energy` and `seen`, as far as the evidence contains them.
nlohmann::ordered_json describe_evidence(const Evidence& evidence);

/// The key `files`: name, size and checksum of each file.
nlohmann::ordered_json describe_files(const std::vector<FileRecord>& files);

/// The key `warnings`: one line each, with the quantity that would help in parentheses.
nlohmann::ordered_json describe_warnings(const std::vector<Warning>& warnings);

/// The part of `time_s` that the solution itself took.
nlohmann::ordered_json describe_times(const SolveTimes& seconds);

/// The key `memory`: the largest amount that this process has held so far, and the estimate of what the
/// solution would hold.
nlohmann::ordered_json describe_memory(const Evidence& evidence);

/// The text of a JSON file. File names may contain bytes that are not UTF-8, which JSON cannot hold; such
/// bytes are replaced.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace heightlight
