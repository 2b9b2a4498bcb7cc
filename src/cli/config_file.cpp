#include "cli/config_file.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "heightlight/error.h"

namespace heightlight {
namespace {

constexpr std::string_view kBlanks = " \t\r";

/// One line of TOML, read from the left. Throws UsageError, without the line's place, for what is no TOML, or
/// more of it than options need: tables of tables, dates, strings and arrays of several lines.
class TomlLine {
 public:
  explicit TomlLine(std::string_view text) : rest_(text) { skip_blanks(); }

  bool is_done() const { return rest_.empty() || rest_.front() == '#'; }

  /// Of "[name]"; nothing where the line is something else.
  std::optional<std::string> section() {
    if (!take('[')) return std::nullopt;
    const std::string name = bare("]");
    expect(']', "']' after the name of a section");
    expect_end();
    return name;
  }

  std::string key() {
    const std::string name = is_quoted() ? value() : bare("=");
    expect('=', "'=' after '" + name + "'");
    return name;
  }

  /// One value, or those of an array.
  std::vector<std::string> values() {
    std::vector<std::string> all;
    if (!take('[')) {
      all.push_back(value());
    } else {
      while (!take(']')) {
        all.push_back(value());
        if (!take(',') && (rest_.empty() || rest_.front() != ']'))
          throw UsageError("an array needs ',' or ']'");
      }
    }
    expect_end();
    return all;
  }

 private:
  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size())); }

  bool is_quoted() const { return !rest_.empty() && (rest_.front() == '"' || rest_.front() == '\''); }

  bool take(char wanted) {
    if (rest_.empty() || rest_.front() != wanted) return false;
    rest_.remove_prefix(1);
    skip_blanks();
    return true;
  }

  void expect(char wanted, const std::string& what) {
    if (!take(wanted)) throw UsageError("there is no " + what);
  }

  void expect_end() const {
    if (!is_done())
      throw UsageError("'" + std::string(rest_) + "' is not expected here (texts must be in quotes)");
  }

  /// Up to a blank, a comment, or one of these.
  std::string bare(const std::string& ends) {
    const std::size_t end = std::min(rest_.find_first_of(std::string(kBlanks) + '#' + ends), rest_.size());
    if (end == 0) throw UsageError("a name or a value is missing");
    std::string text(rest_.substr(0, end));
    rest_.remove_prefix(end);
    skip_blanks();
    return text;
  }

  std::string value() { return is_quoted() ? quoted() : bare(",]"); }

  std::string quoted() {
    const char mark = rest_.front();
    std::string text;
    std::size_t at = 1;
    for (; at < rest_.size() && rest_[at] != mark; ++at) {
      if (mark == '"' && rest_[at] == '\\') {
        ++at;
        if (at == rest_.size() || (rest_[at] != '"' && rest_[at] != '\\'))
          throw UsageError(
              "after a backslash, only '\"' or a second backslash may follow; in '…', backslashes are "
              "ordinary characters");
      }
      text += rest_[at];
    }
    if (at >= rest_.size()) throw UsageError("a quoted text has no closing quote");
    rest_.remove_prefix(at + 1);
    skip_blanks();
    return text;
  }

  std::string_view rest_;
};

const CLI::App* find_command(const CLI::App& app, const std::string& name) {
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

/// Throws UsageError unless an option of a command has that name.
void check_key(const CLI::App& app, const std::string& section, const std::string& key) {
  if (section.empty())
    throw UsageError("'" + key +
                     "' is in no section; put the options of a command below its name, such as [bake]");
  const CLI::App* command = find_command(app, section);
  const CLI::Option* option = command->get_option_no_throw("--" + key);
  if (option == nullptr) option = command->get_option_no_throw(key);
  if (option == nullptr || !option->get_configurable())
    throw UsageError(section + " has no option '" + key + "'");
}

/// How CLI11 reads the file.
class CommandConfig : public CLI::Config {
 public:
  explicit CommandConfig(const CLI::App& app) : app_(app) {}

  /// The options of the command that is to run; those of others are only looked at.
  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    Reading reading;
    int number = 1;
    for (std::string line; std::getline(input, line); ++number) {
      try {
        read_line(line, reading);
      } catch (const UsageError& error) {
        throw UsageError(config_file_of(app_) + ", line " + std::to_string(number) + ": " + error.what());
      }
    }
    return reading.found;
  }

  std::string to_config(const CLI::App*, bool, bool, std::string) const override { return ""; }

 private:
  /// As far as the file was read.
  struct Reading {
    std::string section;
    std::set<std::string> keys;  ///< "bake.relief"
    std::vector<CLI::ConfigItem> found;
  };

  void read_line(const std::string& text, Reading& reading) const {
    TomlLine line(text);
    if (line.is_done()) return;
    if (const std::optional<std::string> name = line.section()) {
      if (find_command(app_, *name) == nullptr) throw UsageError("there is no command '" + *name + "'");
      reading.section = *name;
      return;
    }
    const std::string key = line.key();
    check_key(app_, reading.section, key);
    if (!reading.keys.insert(reading.section + '.' + key).second)
      throw UsageError("'" + key + "' is given twice in section " + reading.section);
    CLI::ConfigItem item;
    item.parents = {reading.section};
    item.name = key;
    item.inputs = line.values();
    const bool is_run = reading.section == app_.get_subcommands().front()->get_name();
    if (is_run) reading.found.push_back(std::move(item));
  }

  const CLI::App& app_;
};

}  // namespace

void add_config_options(CLI::App& app) {
  app.set_config("--config")->group("");
  app.config_formatter(std::make_shared<CommandConfig>(app));
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    command
        ->add_option_function<std::string>(
            "--config",
            [&app](const std::string& file) {
              if (app.get_config_ptr()->count() > 0) throw UsageError("--config: give one file");
              app.get_config_ptr()->add_result(file);
            },
            "TOML file with options by their names, in the section [" + command->get_name() +
                "]; options on the command line take precedence")
        ->type_name("FILE")
        ->configurable(false)
        ->trigger_on_parse();
  }
}

std::string config_file_of(const CLI::App& app) {
  const CLI::Option* option = app.get_config_ptr();
  return option->count() == 0 ? "" : option->results().front();
}

}  // namespace heightlight
