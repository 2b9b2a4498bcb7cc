#include "cli/relief_table.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "cli/length.h"
#include "files/text_lines.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") + 1 - first));
}

/// Fields between commas where there is one, else words.
std::vector<std::string> fields_of(std::string_view line) {
  std::vector<std::string> fields;
  std::istringstream stream{std::string(line)};
  const bool has_commas = line.find(',') != std::string_view::npos;
  for (std::string field; has_commas ? !!std::getline(stream, field, ',') : !!(stream >> field);)
    fields.push_back(trimmed(field));
  return fields;
}

/// `error` makes the error of a place in the table, of what is wrong there.
template <class MakeError>
double parse_positive(const std::string& text, const MakeError& error) {
  const std::optional<Length> length = read_length(text);
  if (!length) throw error("'" + text + "' is not a length, such as 0.05 or 5cm");
  if (!(length->value > 0)) throw error("'" + text + "' must be positive");
  return length->value;
}

template <class MakeError>
NamedRelief parse_entry(const std::vector<std::string>& fields, const MakeError& error) {
  if (fields.size() < 2 || fields.size() > 3 || fields[0].empty())
    throw error("must be a name, a relief and optionally a width");
  NamedRelief entry{.name = fields[0], .relief = parse_positive(fields[1], error)};
  if (fields.size() == 3) entry.width = parse_positive(fields[2], error);
  return entry;
}

template <class MakeError>
void add_entry(std::vector<NamedRelief>& reliefs, NamedRelief entry, const MakeError& error) {
  const bool known = std::any_of(reliefs.begin(), reliefs.end(),
                                 [&](const NamedRelief& other) { return other.name == entry.name; });
  if (known) throw error("'" + entry.name + "' is given twice");
  reliefs.push_back(std::move(entry));
}

std::vector<NamedRelief> read_given_reliefs(const std::string& text) {
  const auto error = [](const std::string& fault) { return UsageError("reliefs", "", fault); };
  std::vector<NamedRelief> reliefs;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) {
    const std::size_t equals = part.rfind('=');
    if (equals == std::string::npos) throw UsageError("reliefs", text, "must be like brick=5cm,leather=1mm");
    add_entry(reliefs,
              parse_entry({trimmed(part.substr(0, equals)), trimmed(part.substr(equals + 1))}, error), error);
  }
  return reliefs;
}

std::vector<NamedRelief> read_relief_file(const std::filesystem::path& path) {
  const InputFile file(path);
  LineReader lines(file);
  const auto error = [&](const std::string& fault) { return lines.error(fault); };
  std::vector<NamedRelief> reliefs;
  bool may_be_heading = true;
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::vector<std::string> fields = fields_of(*line);
    if (fields.empty() || fields[0].starts_with('#')) continue;
    const bool is_heading = may_be_heading && fields[0] == "name";
    may_be_heading = false;
    if (!is_heading) add_entry(reliefs, parse_entry(fields, error), error);
  }
  if (reliefs.empty()) throw file_error(path, "contains no reliefs");
  return reliefs;
}

}  // namespace

std::vector<NamedRelief> read_reliefs(const std::string& text) {
  const bool is_given = text.find('=') != std::string::npos;
  return is_given ? read_given_reliefs(text) : read_relief_file(text);
}

const NamedRelief* find_relief(const std::vector<NamedRelief>& reliefs, const std::filesystem::path& map) {
  const auto found = std::find_if(reliefs.begin(), reliefs.end(), [&](const NamedRelief& entry) {
    return entry.name == map.stem().string() || entry.name == map.filename().string();
  });
  return found == reliefs.end() ? nullptr : &*found;
}

}  // namespace heightlight
