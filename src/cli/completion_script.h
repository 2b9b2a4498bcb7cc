#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace heightlight {

/// Scripts by which shells complete commands, their options, what options can be, and files. They are made
/// of the application itself.
std::string bash_completion(const CLI::App& app);
std::string zsh_completion(const CLI::App& app);

}  // namespace heightlight
