#include <fmt/core.h>

#include <memory>

#include "cli/commands.h"
#include "cli/completion_script.h"

namespace heightlight {

void add_completion_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "completion", "Print the script that lets a shell complete the options of this program");
  auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "shell for which to print the script: bash or zsh")
      ->required()
      ->check(CLI::IsMember({"bash", "zsh"}));
  command->footer(
      "cmake --install puts both scripts where the shells find them. By hand:\n"
      "  heightlight completion bash > ~/.local/share/bash-completion/completions/heightlight\n"
      "  heightlight completion zsh > DIR/_heightlight                  DIR of zsh's $fpath");
  command->callback(
      [&app, shell] { fmt::print("{}", *shell == "bash" ? bash_completion(app) : zsh_completion(app)); });
}

}  // namespace heightlight
