#include "base/digits.h"
#include "files/output_file.h"
#include "heightlight/files.h"

namespace heightlight {
namespace {

void append_lines(std::string& text, const CurveBin& bin, AoKind kind) {
  std::string shared = std::string(to_string(kind)) + ',' + std::to_string(bin.bin);
  for (const double value : {bin.ao_lo, bin.ao_hi, bin.ao_mean}) (shared += ',') += in_digits(value);
  shared += ',' + std::to_string(bin.count) + ',';
  for (std::size_t b = 0; b < bin.bounces.size(); ++b) {
    const BounceStatistics& bounce = bin.bounces[b];
    text += shared + std::to_string(b);
    for (const double value : {bounce.mean, bounce.stddev, bounce.p05, bounce.p50, bounce.p95}) {
      (text += ',') += in_digits(value);
    }
    text += '\n';
  }
}

}  // namespace

void write_curves_csv(const std::filesystem::path& path, const std::vector<BounceCurves>& curves) {
  std::string text(kCurvesHeader);
  text += '\n';
  for (const BounceCurves& one : curves) {
    for (const CurveBin& bin : one.filled) append_lines(text, bin, one.kind);
  }
  write_bytes(path, text);
}

}  // namespace heightlight
