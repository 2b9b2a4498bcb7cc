#include "files/esri_grid.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>

#include "files/map_size.h"
#include "files/word_reader.h"

namespace heightlight {
namespace {

enum Keyword {
  kColumns,
  kRows,
  kWestCorner,
  kWestCentre,
  kSouthCorner,
  kSouthCentre,
  kCell,
  kCellX,
  kCellY,
  kNoData
};

constexpr std::array kKeywords{"ncols",     "nrows",    "xllcorner", "xllcenter", "yllcorner",
                               "yllcenter", "cellsize", "dx",        "dy",        "nodata_value"};

using HeaderWords = std::array<std::optional<double>, kKeywords.size()>;

/// The beginning of a word, made printable.
std::string quoted(std::string_view word) {
  std::string text(word.substr(0, 24));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return "'" + text + (word.size() > 24 ? "...'" : "'");
}

bool starts_number(std::string_view word) {
  // Words such as "nan" and "NODATA_value" begin alike, so their length distinguishes them.
  return !word.empty() && (std::isalpha(static_cast<unsigned char>(word[0])) == 0 || word.size() == 3);
}

double parse_value(const WordReader& words, std::string_view word) {
  const char* begin = word.data() + (word.size() > 1 && word[0] == '+' && word[1] != '-' ? 1 : 0);
  const char* end = word.data() + word.size();
  double value = 0;
  const auto [stop, fault] = std::from_chars(begin, end, value);
  if (fault == std::errc::result_out_of_range)
    throw words.error(quoted(word) + " is out of the range of numbers");
  if (fault != std::errc() || stop != end) throw words.error(quoted(word) + " is not a number");
  return value;
}

std::size_t find_keyword(const WordReader& words, std::string_view word) {
  std::string name(word);
  std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = std::find(kKeywords.begin(), kKeywords.end(), name);
  if (found == kKeywords.end())
    throw words.error(quoted(word) + " is not a keyword of an Esri ASCII grid's header");
  return static_cast<std::size_t>(found - kKeywords.begin());
}

/// Reads keyword and value pairs; returns the first word after them in `first_value`.
HeaderWords read_header(WordReader& words, std::string& first_value) {
  HeaderWords header;
  std::string_view word = words.next();
  for (; !word.empty() && !starts_number(word); word = words.next()) {
    const std::size_t keyword = find_keyword(words, word);
    if (header[keyword]) throw words.error(std::string(kKeywords[keyword]) + " appears twice");
    const std::string_view value = words.next();
    if (value.empty()) throw words.error("the file ends within its header");
    header[keyword] = parse_value(words, value);
  }
  first_value = word;
  return header;
}

std::uint64_t get_count(const InputFile& file, const HeaderWords& header, Keyword keyword) {
  const std::string name = kKeywords[keyword];
  if (!header[keyword]) throw file.error("the header lacks " + name);
  const double count = *header[keyword];
  if (!(count >= 0 && count <= 1e15) || count != std::floor(count)) {
    throw file.error(name + " is not a number of samples");
  }
  return static_cast<std::uint64_t>(count);
}

double get_cell_size(const InputFile& file, const HeaderWords& header, Keyword axis) {
  const std::optional<double> size = header[axis] ? header[axis] : header[kCell];
  if (!size) throw file.error("the header lacks cellsize");
  if (!(*size > 0) || !std::isfinite(*size)) throw file.error("the cell size is not a positive number");
  return *size;
}

std::optional<double> get_edge(const HeaderWords& header, Keyword corner, Keyword centre, double cell) {
  if (header[corner]) return header[corner];
  if (header[centre]) return *header[centre] - cell / 2;
  return std::nullopt;
}

void read_values(WordReader& words, std::string_view word, Image<double>& values) {
  const std::string declared = std::to_string(values.width) + " x " + std::to_string(values.height);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (word.empty()) {
      throw words.error("the file ends after " + std::to_string(i) + " values, and its header announces " +
                        declared);
    }
    values.values[i] = parse_value(words, word);
    word = words.next();
  }
  if (!word.empty()) throw words.error("there are more values than the " + declared + " of the header");
}

}  // namespace

EsriGrid read_esri_grid(const InputFile& file, const ReadLimit& limit) {
  WordReader words(file);
  std::string first_value;
  const HeaderWords found = read_header(words, first_value);
  const std::uint64_t columns = get_count(file, found, kColumns);
  const std::uint64_t rows = get_count(file, found, kRows);
  check_map_size(file.path(), columns, rows, sizeof(double) + sizeof(float), limit);
  // Each value takes at least a digit and a space. A header that promises more is rejected before memory is
  // taken.
  if (columns * rows > file.size() / 2 + 1) {
    throw file.error("has too few values: its header announces " + std::to_string(columns) + " x " +
                     std::to_string(rows));
  }

  EsriGrid grid;
  EsriHeader& header = grid.header;
  header.columns = static_cast<int>(columns);
  header.rows = static_cast<int>(rows);
  header.cell_x = get_cell_size(file, found, kCellX);
  header.cell_y = get_cell_size(file, found, kCellY);
  header.west = get_edge(found, kWestCorner, kWestCentre, header.cell_x);
  header.south = get_edge(found, kSouthCorner, kSouthCentre, header.cell_y);
  header.no_data = found[kNoData];
  grid.values = Image<double>(header.columns, header.rows);
  read_values(words, first_value, grid.values);
  return grid;
}

}  // namespace heightlight
