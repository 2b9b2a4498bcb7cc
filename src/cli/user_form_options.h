#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace heightlight {

/// The forms that a user gives, as text until they are read (read_user_forms).
struct UserFormOptions {
  std::vector<std::string> forms;
  std::filesystem::path file;
};

/// Adds `--form` and `--forms`.
void add_user_form_options(CLI::App& command, UserFormOptions& options);

}  // namespace heightlight
