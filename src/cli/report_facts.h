#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "heightlight/evidence.h"
#include "heightlight/files.h"
#include "heightlight/heightmap.h"
#include "report/page.h"

// What the reports of several commands say alike.

namespace heightlight {

/// The name of every command's report; `bake` puts the map's before it.
inline constexpr const char* kReportFile = "report.html";

/// Adds `--report`.
void add_report_option(CLI::App& command, bool& wanted);

/// The size of a map, its spacing, relief and boundary. Of `header` the heights' size counts.
std::vector<PageFact> map_facts(const Heightmap& header, double relief, std::uint64_t missing);

/// How a solution was asked for: the error wanted, and by which method.
std::vector<PageFact> method_facts(const Evidence& evidence);

/// What its checks found, each beside the error wanted, where there is one; how well energy is kept.
std::vector<PageFact> reached_facts(const Evidence& evidence);

/// Seconds, the peak of this process's memory, threads.
std::vector<PageFact> cost_facts(double seconds, int threads);

/// A file that was read.
PageFact input_fact(const std::filesystem::path& path, const std::string& sha256);

/// Of these paths those that are files, as they are now: an albedo may be a number. Throws Error.
std::vector<PageFact> input_facts(const std::vector<std::filesystem::path>& paths);

/// Warnings in the words of the command line.
std::vector<std::string> warning_lines(const std::vector<Warning>& warnings);

/// Adds the facts at the end.
void append(std::vector<PageFact>& facts, const std::vector<PageFact>& more);

}  // namespace heightlight
