// Tables of bounce curves.

#include <cmath>

#include "fuzz_input.h"
#include "heightlight/files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace heightlight;
  static MemoryFile file;
  const auto& path = file.hold(data, size);
  expect_line_or_result(path, [&] {
    for (const BounceCurves& curves : read_curves_csv(path)) {
      require(!curves.filled.empty(), "curves have a bin");
      for (const CurveBin& bin : curves.filled) {
        require(bin.count > 0, "a bin has texels");
        require(std::isfinite(bin.ao_mean), "a bin's AO is a number");
        require(bin.bounces.size() == curves.filled.front().bounces.size(), "bins have as many bounces");
      }
    }
  });
  return 0;
}
