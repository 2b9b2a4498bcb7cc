#include <array>
#include <charconv>

#include "heightlight/curves.h"
#include "io/output_file.h"

namespace heightlight {
namespace {

/// The shortest digits that read back as the same double, in any locale.
void append(std::string& text, double value) {
  std::array<char, 32> digits{};
  const std::to_chars_result end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), end.ptr);
}

void append_lines(std::string& text, const CurveBin& bin, AoKind kind) {
  std::string shared = std::string(to_string(kind)) + ',' + std::to_string(bin.bin);
  for (const double value : {bin.ao_lo, bin.ao_hi, bin.ao_mean}) append(shared += ',', value);
  shared += ',' + std::to_string(bin.count) + ',';
  for (std::size_t b = 0; b < bin.bounces.size(); ++b) {
    const BounceStatistics& bounce = bin.bounces[b];
    text += shared + std::to_string(b);
    for (const double value : {bounce.mean, bounce.stddev, bounce.p05, bounce.p50, bounce.p95}) {
      append(text += ',', value);
    }
    text += '\n';
  }
}

}  // namespace

void write_curves_csv(const std::filesystem::path& path, const std::vector<BounceCurves>& curves) {
  std::string text = "ao_kind,bin,ao_lo,ao_hi,ao_mean,count,bounce,mean,stddev,p05,p50,p95\n";
  for (const BounceCurves& one : curves) {
    for (const CurveBin& bin : one.filled) append_lines(text, bin, one.kind);
  }
  write_bytes(path, text);
}

}  // namespace heightlight
