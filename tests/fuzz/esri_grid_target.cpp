// Esri ASCII grids.

#include "files/esri_grid.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace heightlight;
  static MemoryFile file;
  const auto& path = file.hold(data, size);
  expect_line_or_result(path, [&] {
    const EsriGrid grid = read_esri_grid(path, kReaderMemory);
    require(grid.header.columns > 0 && grid.header.rows > 0, "a grid has columns and rows");
    require(grid.values.size() ==
                static_cast<std::size_t>(grid.header.columns) * static_cast<std::size_t>(grid.header.rows),
            "a grid has its values");
    require(grid.header.cell_x > 0 && grid.header.cell_y > 0, "cells have a size");
  });
  return 0;
}
