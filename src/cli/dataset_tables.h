#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/dataset_runs.h"

namespace heightlight {

/// `inputs` are the files that the job reads, its manifest first. Writes into the folder, from its origin
/// (describe_origin) and from the folders of the runs that are done,
///  `dataset.csv`   run, map, relief_share, boundary, options, and the columns of curves.csv: all curves,
///  tidy; `dataset.json`  what every run came from and how far to trust it, and why those that failed did;
///  `costs.csv`     seconds and links of every run, which differ from one making to the next;
///  `report.html`   a page for browsers, where it is wanted.
/// The first two are the same to the last byte for the same manifest, inputs and version. Throws Error naming
/// a result of a run that cannot be read, OutputError, Cancelled while another process writes them.
void write_tables(const nlohmann::ordered_json& origin, const std::vector<DatasetRun>& runs,
                  const std::filesystem::path& folder, const std::vector<std::filesystem::path>& inputs,
                  bool with_report);

/// Throws UsageError naming an input that these tables, or the record of their origin, would replace.
void refuse_to_replace(const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& folder);

/// Throws an exception of the JSON library where the summary of a run lacks what these tables tell of it.
void check_summary(const DatasetRun& run, const nlohmann::json& summary);

}  // namespace heightlight
