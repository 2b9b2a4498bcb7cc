#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "files/file_record.h"
#include "heightlight/evidence.h"
#include "heightlight/files.h"
#include "heightlight/surface.h"

// What every file that tells of a solution says, with the same keys wherever it stands: summary.json,
// NAME_bake.json, compare.json, dataset.json.

namespace heightlight {

/// What is found by looking at all heights.
struct MapMeasures {
  double relief = 0;
  std::uint64_t missing = 0;
};

/// A file's map as it was understood: path, sha256, width, height, texel, relief, boundary, missing. Of
/// `header` the heights' size counts.
nlohmann::ordered_json describe_map(const std::filesystem::path& path, const std::string& sha256,
                                    const Heightmap& header, const MapMeasures& measures);

/// The same of a map whose heights are there.
nlohmann::ordered_json describe_map(const std::filesystem::path& path, const std::string& sha256,
                                    const Surface& surface);

/// The keys `visibility`, `links`, `energy_audit`, `energy` and `seen`, as far as the evidence has them.
nlohmann::ordered_json describe_evidence(const Evidence& evidence);

/// `files`: name, size and checksum of each.
nlohmann::ordered_json describe_files(const std::vector<FileRecord>& files);

/// `warnings`: a line each, with the quantity that would help in parentheses.
nlohmann::ordered_json describe_warnings(const std::vector<Warning>& warnings);

/// The solution's own part of `time_s`.
nlohmann::ordered_json describe_times(const SolveTimes& seconds);

/// `memory`: what this process held at most so far, and what the solution was estimated to hold.
nlohmann::ordered_json describe_memory(const Evidence& evidence);

/// The text of a file of JSON. Names of files may hold bytes that are no UTF-8, which JSON cannot: they are
/// replaced.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace heightlight
