#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "base/byte_size.h"
#include "files/input_file.h"
#include "files/text_lines.h"
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
constexpr double kSlack = 1e-6;  // measured fractions leave [0, 1] by rounding

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0;;) {
    const std::size_t end = line.find(separator, begin);
    fields.push_back(line.substr(begin, end - begin));
    if (end == std::string_view::npos) return fields;
    begin = end + 1;
  }
}

/// Reads one line after the other, and keeps the position for messages.
class CurvesReader {
 public:
  explicit CurvesReader(const InputFile& file) : file_(file), lines_(file) {}

  std::vector<RunCurves> read() {
    if (const auto header = lines_.next()) find_columns(*header);
    while (const auto line = lines_.next()) {
      if (!line->empty()) add(split(*line, ','));
    }
    if (runs_.empty()) throw file_.error("holds no curves");
    finish(runs_.back().curves);
    return std::move(runs_);
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const { throw lines_.error(fault); }

  /// Reports a text that is not what its column holds. The message is built piece by piece, because g++ 12
  /// wrongly warns about "'" + a string that ends here.
  [[noreturn]] void fail_as_no(std::string_view column, std::string_view text) const {
    fail(std::string("'").append(text).append("' is no ").append(column));
  }

  void find_columns(std::string_view header) {
    const std::vector<std::string_view> names = split(header, ',');
    fields_ = names.size();
    const auto find = [&](std::string_view name) {
      return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    };
    for (std::size_t c = 0; c < kColumnCount; ++c) {
      place_[c] = find(kNames[c]);
      if (place_[c] == fields_)
        throw file_.error("has no column '" + std::string(kNames[c]) + "': not a table of bounce curves");
    }
    run_place_ = find("run");
    map_place_ = find("map");
  }

  /// The value of an optional column in this row; empty if there is no such column.
  std::string text_at(std::size_t place) const {
    return place < fields_ ? std::string(row_[place]) : std::string();
  }

  void begin_run(const std::string& name) {
    if (!runs_.empty()) finish(runs_.back().curves);
    if (!names_.insert(name).second) fail("the run " + name + " again: runs are mixed");
    runs_.push_back({.run = name, .map = text_at(map_place_), .curves = {}});
  }

  template <class Number>
  Number number(Column column) const {
    const std::string_view text = row_[place_[column]];
    Number value{};
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = end.ec == std::errc() && end.ptr == text.data() + text.size();
    if (!whole || !std::isfinite(static_cast<double>(value))) {
      fail_as_no(kNames[column], text);
    }
    return value;
  }

  AoKind kind() const {
    const std::string_view text = row_[place_[kKind]];
    for (const AoKind known : {AoKind::ambient_occlusion, AoKind::sky_view_factor}) {
      if (text == to_string(known)) return known;
    }
    fail_as_no("ao_kind; ambient_occlusion and sky_view_factor are", text);
  }

  void add(std::vector<std::string_view> row) {
    row_ = std::move(row);
    if (row_.size() != fields_) {
      fail(std::to_string(row_.size()) + " fields where the header has " + std::to_string(fields_));
    }
    const std::string run = text_at(run_place_);
    if (runs_.empty() || runs_.back().run != run) begin_run(run);
    const AoKind of_row = kind();
    if (curves().empty() || curves().back().kind != of_row) begin_kind(of_row);
    const int bounce = number<int>(kBounce);
    if (bounce == 0) begin_bin();
    add_bounce(bounce);
  }

  void begin_kind(AoKind of_row) {
    for (const BounceCurves& before : curves()) {
      if (before.kind == of_row) {
        fail(std::string(to_string(of_row)) + " again: the two kinds of AO are mixed");
      }
    }
    curves().push_back({of_row, 0, {}});
  }

  void begin_bin() {
    std::vector<CurveBin>& filled = curves().back().filled;
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
    std::vector<CurveBin>& filled = curves().back().filled;
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

  /// Sets the number of bins, and the tail, which the file does not hold, from conservation of energy.
  void finish(std::vector<BounceCurves>& curves) const {
    for (BounceCurves& one : curves) {
      const std::size_t bounces = one.filled.front().bounces.size();
      one.bins = static_cast<int>(std::lround(1 / (one.filled.front().ao_hi - one.filled.front().ao_lo)));
      for (CurveBin& bin : one.filled) {
        if (bin.bounces.size() != bounces) {
          throw file_.error(std::string(to_string(one.kind)) + " bin " + std::to_string(bin.bin) + " has " +
                            std::to_string(bin.bounces.size()) + " bounces where the first bin has " +
                            std::to_string(bounces));
        }
        double sum = 0;
        for (const BounceStatistics& bounce : bin.bounces) sum += bounce.mean;
        bin.tail.mean = std::max(0.0, 1 - sum);
      }
    }
  }

  std::vector<BounceCurves>& curves() { return runs_.back().curves; }

  const InputFile& file_;
  LineReader lines_;
  std::size_t fields_ = 0;
  std::array<std::size_t, kColumnCount> place_{};
  std::size_t run_place_ = 0;
  std::size_t map_place_ = 0;
  std::vector<std::string_view> row_;
  std::vector<RunCurves> runs_;
  std::set<std::string> names_;
};

}  // namespace

std::vector<RunCurves> read_run_curves(const std::filesystem::path& path, std::uint64_t memory_limit) {
  const InputFile file(path);
  // The shortest lines have about 40 characters and begin a bin each; vectors double as they grow.
  constexpr std::uint64_t kPerByte = 2 * (sizeof(CurveBin) + sizeof(BounceStatistics)) / 40 + 1;
  if (file.size() > memory_limit / kPerByte) {
    const std::uint64_t needed = kPerByte * file.size();
    throw MemoryError(path.string() + ": reading it may take " + format_byte_size(needed) +
                          " of memory, and " + format_byte_size(memory_limit) + " are allowed",
                      needed - std::min(needed, memory_limit), write_enough(needed));
  }
  return CurvesReader(file).read();
}

std::vector<BounceCurves> read_curves_csv(const std::filesystem::path& path) {
  std::vector<RunCurves> runs = read_run_curves(path, ~std::uint64_t{0});
  if (runs.size() > 1) throw file_error(path, "holds the curves of several runs");
  return std::move(runs[0].curves);
}

}  // namespace heightlight
