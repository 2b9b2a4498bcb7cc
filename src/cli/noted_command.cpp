#include "cli/noted_command.h"

#include <fmt/core.h>

#include "files/printable.h"

namespace heightlight {
namespace {

std::string& command_text() {
  static std::string text;
  return text;
}

bool is_plain(const std::string& argument) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=:,./@%";
  return !argument.empty() && argument.find_first_not_of(kPlain) == std::string::npos;
}

/// $'…', bytes beyond ASCII and controls in octal: three digits, so that none that follows is taken in.
std::string byte_quoted(const std::string& argument) {
  std::string text = "$'";
  for (const char letter : argument) {
    const auto byte = static_cast<unsigned char>(letter);
    if (letter == '\n') {
      text += "\\n";
    } else if (letter == '\'' || letter == '\\') {
      text += std::string("\\") + letter;
    } else if (byte < 0x20 || byte >= 0x7f) {
      text += fmt::format("\\{:03o}", byte);
    } else {
      text += letter;
    }
  }
  return text + "'";
}

}  // namespace

std::string shell_quoted(const std::string& argument) {
  if (is_plain(argument)) return argument;
  if (printable(argument) != argument) return byte_quoted(argument);
  std::string text = "'";
  for (const char letter : argument) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

void note_command(int argument_count, const char* const* arguments) {
  command_text() = "heightlight";
  for (int i = 1; i < argument_count; ++i) command_text() += " " + shell_quoted(arguments[i]);
}

const std::string& noted_command() { return command_text(); }

}  // namespace heightlight
