// Tables of bounce curves, of one run or of many.

#include <cmath>

#include "fuzz_input.h"
#include "heightlight/files.h"

namespace {

void check_curves(const heightlight::BounceCurves& curves) {
  using namespace heightlight;
  require(!curves.filled.empty(), "curves have a bin");
  for (const CurveBin& bin : curves.filled) {
    require(bin.count > 0, "a bin has texels");
    require(std::isfinite(bin.ao_mean), "a bin's AO is a number");
    require(bin.bounces.size() == curves.filled.front().bounces.size(), "bins have as many bounces");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace heightlight;
  static MemoryFile file;
  const auto& path = file.hold(data, size);
  expect_line_or_result(path, [&] {
    for (const RunCurves& run : read_run_curves(path, kReaderMemory)) {
      for (const BounceCurves& curves : run.curves) check_curves(curves);
    }
  });
  return 0;
}
