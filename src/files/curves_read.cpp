#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "files/input_file.h"
#include "heightlight/error.h"
#include "heightlight/files.h"

namespace heightlight {
namespace {

/// The columns, in the order in which the fields below are kept.
enum Column {
  kKind,
  kBin,
  kLow,
  kHigh,
  kAoMean,
  kCount,
  kBounce,
  kMean,
  kStddev,
  kP05,
  kP50,
  kP95,
  kColumnCount
};
constexpr std::array<std::string_view, kColumnCount> kNames{
    "ao_kind", "bin", "ao_lo", "ao_hi", "ao_mean", "count", "bounce", "mean", "stddev", "p05", "p50", "p95"};
constexpr double kSlack = 1e-6;  // shares as measured stray out of [0, 1] by rounding

std::string read_all(const std::filesystem::path& path) {
  const File file = open_input(path);
  std::string text;
  std::array<char, 65536> chunk{};
  while (const std::size_t got = std::fread(chunk.data(), 1, chunk.size(), file.get())) {
    text.append(chunk.data(), got);
  }
  return text;
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t end = line.find(separator, begin);
    fields.push_back(line.substr(begin, end - begin));
    if (end == std::string_view::npos) return fields;
    begin = end + 1;
  }
}

/// Reads one line after the other, and knows where it is for messages.
class CurvesReader {
 public:
  explicit CurvesReader(const std::filesystem::path& path) : path_(path) {}

  std::vector<BounceCurves> read() {
    const std::string text = read_all(path_);
    for (std::string_view line : split(text, '\n')) {
      ++line_;
      if (line.ends_with('\r')) line.remove_suffix(1);
      if (line_ == 1) {
        find_columns(line);
      } else if (!line.empty()) {
        add(split(line, ','));
      }
    }
    finish();
    return std::move(curves_);
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const {
    throw file_error(path_, "line " + std::to_string(line_) + ": " + fault);
  }

  void find_columns(std::string_view header) {
    const std::vector<std::string_view> names = split(header, ',');
    fields_ = names.size();
    for (std::size_t c = 0; c < kColumnCount; ++c) {
      const auto found = std::find(names.begin(), names.end(), kNames[c]);
      if (found == names.end()) {
        throw file_error(path_,
                         "has no column '" + std::string(kNames[c]) + "': not a table of bounce curves");
      }
      place_[c] = static_cast<std::size_t>(found - names.begin());
    }
  }

  template <class Number>
  Number number(Column column) const {
    const std::string_view text = row_[place_[column]];
    Number value{};
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = end.ec == std::errc() && end.ptr == text.data() + text.size();
    if (!whole || !std::isfinite(static_cast<double>(value))) {
      fail("'" + std::string(text) + "' is no " + std::string(kNames[column]));
    }
    return value;
  }

  AoKind kind() const {
    const std::string_view text = row_[place_[kKind]];
    for (const AoKind known : {AoKind::ambient_occlusion, AoKind::sky_view_factor}) {
      if (text == to_string(known)) return known;
    }
    fail("'" + std::string(text) + "' is no ao_kind; ambient_occlusion and sky_view_factor are");
  }

  void add(std::vector<std::string_view> row) {
    row_ = std::move(row);
    if (row_.size() != fields_) {
      fail(std::to_string(row_.size()) + " fields where the header has " + std::to_string(fields_));
    }
    const AoKind of_row = kind();
    if (curves_.empty() || curves_.back().kind != of_row) begin_kind(of_row);
    const int bounce = number<int>(kBounce);
    if (bounce == 0) begin_bin();
    add_bounce(bounce);
  }

  void begin_kind(AoKind of_row) {
    for (const BounceCurves& before : curves_) {
      if (before.kind == of_row) {
        fail(std::string(to_string(of_row)) + " again: the two kinds of AO are mixed");
      }
    }
    curves_.push_back({of_row, 0, {}});
  }

  void begin_bin() {
    std::vector<CurveBin>& filled = curves_.back().filled;
    CurveBin bin;
    bin.bin = number<int>(kBin);
    bin.ao_lo = number<double>(kLow);
    bin.ao_hi = number<double>(kHigh);
    bin.ao_mean = number<double>(kAoMean);
    bin.count = number<std::size_t>(kCount);
    if (bin.count == 0) fail("a bin without texels; empty bins are absent");
    if (!(0 <= bin.ao_lo && bin.ao_lo < bin.ao_hi && bin.ao_hi <= 1 + kSlack)) {
      fail("ao_lo and ao_hi are not in order within 0 to 1");
    }
    if (bin.ao_mean < bin.ao_lo - kSlack || bin.ao_mean > bin.ao_hi + kSlack) {
      fail("ao_mean is outside its bin");
    }
    if (!filled.empty() && bin.bin <= filled.back().bin) fail("bins are not in ascending order");
    filled.push_back(bin);
  }

  void add_bounce(int bounce) {
    std::vector<CurveBin>& filled = curves_.back().filled;
    if (filled.empty() || number<int>(kBin) != filled.back().bin ||
        bounce != static_cast<int>(filled.back().bounces.size())) {
      fail("bounce " + std::to_string(bounce) + " does not follow on the one before it in its bin");
    }
    BounceStatistics statistics{number<double>(kMean), number<double>(kStddev), number<double>(kP05),
                                number<double>(kP50), number<double>(kP95)};
    if (statistics.mean < -kSlack || statistics.mean > 1 + kSlack) {
      fail("mean is E/π at albedo 1, from 0 to 1, not " + std::string(row_[place_[kMean]]));
    }
    if (statistics.stddev < 0) fail("stddev is negative");
    filled.back().bounces.push_back(statistics);
  }

  /// The number of bins, and the tail, which the file does not hold: by conservation.
  void finish() {
    for (BounceCurves& one : curves_) {
      const std::size_t bounces = one.filled.front().bounces.size();
      one.bins = static_cast<int>(std::lround(1 / (one.filled.front().ao_hi - one.filled.front().ao_lo)));
      for (CurveBin& bin : one.filled) {
        if (bin.bounces.size() != bounces) {
          throw file_error(path_, std::string(to_string(one.kind)) + " bin " + std::to_string(bin.bin) +
                                      " has " + std::to_string(bin.bounces.size()) +
                                      " bounces where the first bin has " + std::to_string(bounces));
        }
        double sum = 0;
        for (const BounceStatistics& bounce : bin.bounces) sum += bounce.mean;
        bin.tail.mean = std::max(0.0, 1 - sum);
      }
    }
    if (curves_.empty()) throw file_error(path_, "holds no curves");
  }

  const std::filesystem::path& path_;
  std::size_t line_ = 0;
  std::size_t fields_ = 0;
  std::array<std::size_t, kColumnCount> place_{};
  std::vector<std::string_view> row_;
  std::vector<BounceCurves> curves_;
};

}  // namespace

std::vector<BounceCurves> read_curves_csv(const std::filesystem::path& path) {
  return CurvesReader(path).read();
}

}  // namespace heightlight
