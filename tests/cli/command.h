#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

#include "scratch_folder.h"

namespace heightlight {

/// How a run of the command ended, and what it said.
struct CommandResult {
  int exit_code = -1;
  std::string out;
  std::string error;
};

/// Runs `heightlight ARGUMENTS`, a line for the shell, in `folder`. What it prints is kept outside that
/// folder.
inline CommandResult run_command(const std::string& arguments, const ScratchFolder& folder) {
  const ScratchFolder streams;
  const std::string line = "cd '" + folder.path().string() + "' && '" HEIGHTLIGHT_COMMAND "' " + arguments +
                           " > '" + (streams / "out").string() + "' 2> '" + (streams / "error").string() +
                           "' < /dev/null";
  const int status = std::system(line.c_str());
  CommandResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.out = read_text(streams / "out");
  result.error = read_text(streams / "error");
  return result;
}

/// Whether nothing was said on stderr but warnings of maps, which these small ones deserve.
inline bool has_only_warnings(const std::string& error) {
  std::istringstream lines(error);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("heightlight: warning: ")) return false;
  }
  return true;
}

}  // namespace heightlight
