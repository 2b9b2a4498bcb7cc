#include <catch2/catch.hpp>
#include <cmath>

#include "files/esri_grid.h"
#include "heightlight/error.h"
#include "remedy.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;

namespace {

constexpr std::uint64_t kGridMemory = 1 << 30;
const std::string kGridHeader = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 200\ncellsize 10\n";

EsriGrid read(const ScratchFolder& scratch, const std::string& text) {
  return read_esri_grid(write_text(scratch / "grid.asc", text), kGridMemory);
}

}  // namespace

TEST_CASE("A grid is read with its first row on top", "[files]") {
  const ScratchFolder scratch;
  const EsriGrid grid = read(scratch, kGridHeader + "NODATA_value -9999\n1 2 3\n4 -9999 6\n");
  CHECK(grid.values.width == 3);
  CHECK(grid.values.height == 2);
  CHECK(grid.values.values == std::vector<double>{1, 2, 3, 4, -9999, 6});
  CHECK(grid.header.cell_x == 10);
  CHECK(grid.header.cell_y == 10);
  CHECK(*grid.header.west == 100);
  CHECK(*grid.header.south == 200);
  CHECK(*grid.header.no_data == -9999);
}

TEST_CASE("Keywords have any case and order, and white space any shape", "[files]") {
  const ScratchFolder scratch;
  const EsriGrid grid = read(
      scratch,
      "\r\n NROWS 2\r\nNcols\t3\r\nDY 5\r\ndx 4\r\nYLLCENTER 8 XllCenter 7\r\n1 2\r\n3 4 +5\r\n\r\n 6e0");
  CHECK(grid.values.values == std::vector<double>{1, 2, 3, 4, 5, 6});
  CHECK(grid.header.cell_x == 4);
  CHECK(grid.header.cell_y == 5);
  CHECK(*grid.header.west == 5);
  CHECK(*grid.header.south == 5.5);
  CHECK_FALSE(grid.header.no_data);
}

TEST_CASE("NaN is a value of a grid, and of its no-data line", "[files]") {
  const ScratchFolder scratch;
  const EsriGrid grid = read(scratch, "ncols 2\nnrows 1\ncellsize 1\nNODATA_value nan\nnan 2\n");
  CHECK(std::isnan(grid.values.values[0]));
  CHECK(std::isnan(*grid.header.no_data));
}

TEST_CASE("A grid longer than the reader's block keeps every value", "[files]") {
  const ScratchFolder scratch;
  constexpr int kSide = 600;
  std::string text = "ncols 600\nnrows 600\ncellsize 1\n";
  for (int i = 0; i < kSide * kSide; ++i) text += std::to_string(i) + (i % 7 == 0 ? "\n" : " ");
  REQUIRE(text.size() > 2 << 20);
  const EsriGrid grid = read(scratch, text);
  bool same = true;
  for (int i = 0; i < kSide * kSide; ++i) same = same && grid.values.values[static_cast<std::size_t>(i)] == i;
  CHECK(same);
}

TEST_CASE("A fault in a grid is named with the file, the line and the word", "[files]") {
  const ScratchFolder scratch;
  const auto fault = [&](const std::string& text, const std::string& place, const std::string& reason) {
    CAPTURE(text);
    CHECK_THROWS_WITH(read(scratch, text), Contains("grid.asc") && Contains(place) && Contains(reason));
  };
  fault(kGridHeader + "1 2 3\n4 5\n", "line 8", "ends after 5 values");
  fault(kGridHeader + "1 2 3\n4 5 6\n7\n", "line 8", "more values than the 3 x 2");
  fault(kGridHeader + "1 2 3\n4 five 6\n", "line 7", "'five' is not a number");
  fault(kGridHeader + "1 2 3\n4 5,5 6\n", "line 7", "'5,5' is not a number");
  fault(kGridHeader + "1 2 3\n4 0x5 6\n", "line 7", "'0x5'");
  fault(kGridHeader + "1 2 3\n4 1e999 6\n", "line 7", "out of the range");
  fault("ncols 3\nncols 3\n", "line 2", "twice");
  fault("ncols 3\nnrows two\n", "line 2", "'two' is not a number");
  fault("ncols 3\nnrows", "line 2", "ends within its header");
  fault("colour blue\n", "line 1", "'colour' is not a keyword");
  fault("nrows 2\ncellsize 1\n1 2", "grid.asc", "lacks ncols");
  fault("ncols 3\nnrows 2\n1 2 3 4 5 6", "grid.asc", "lacks cellsize");
  fault("ncols 2.5\nnrows 2\ncellsize 1\n1 2", "grid.asc", "ncols is not a number of samples");
  fault("ncols -2\nnrows 2\ncellsize 1\n1 2", "grid.asc", "ncols is not a number of samples");
  fault("ncols 0\nnrows 0\ncellsize 1\n", "grid.asc", "0 x 0");
  fault("ncols 1\nnrows 1\ncellsize 0\n1", "grid.asc", "cell size");
  fault("ncols 1\nnrows 1\ncellsize 1\n\x01z", "line 4", "\'?z\' is not a number");
}

TEST_CASE("A header that announces more than its file can hold takes no memory", "[files]") {
  const ScratchFolder scratch;
  CHECK_THROWS_WITH(read(scratch, "ncols 9000\nnrows 9000\ncellsize 1\n1 2 3\n"), Contains("too few values"));
  CHECK_THAT(remedy_of([&] { read(scratch, "ncols 40000\nnrows 40000\ncellsize 1\n1 2 3\n"); }),
             Catch::StartsWith("memory"));
  CHECK_THROWS_WITH(read(scratch, "ncols 4000000\nnrows 4\ncellsize 1\n1 2 3\n"), Contains("too many"));
}

TEST_CASE("A file of one endless word is refused", "[files]") {
  const ScratchFolder scratch;
  CHECK_THROWS_WITH(read(scratch, kGridHeader + std::string(3 << 20, '7')),
                    Contains("grid.asc") && Contains("line 6"));
}
