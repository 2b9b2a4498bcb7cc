#include <catch2/catch.hpp>

#include "files/image_read.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "png_bytes.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kPngMemory = 1 << 20;

LoadedHeightmap load_png(const ScratchFolder& scratch, const std::string& bytes) {
  return load_heightmap(write_text(scratch / "p.png", bytes), {}, kPngMemory);
}

}  // namespace

TEST_CASE("a wrong checksum of what says nothing of samples is told, of samples it is damage", "[files]") {
  const ScratchFolder scratch;
  const LoadedHeightmap loaded =
      load_png(scratch, small_png(png_chunk("tEXt", std::string("Title\0x", 7), false)));
  CHECK(loaded.facts.highest == 40);
  REQUIRE_FALSE(loaded.warnings.empty());
  CHECK_THAT(loaded.warnings.back().message, Contains("tEXt") && Contains("checksum"));
  std::string many;
  for (int i = 0; i < 1000; ++i) many += png_chunk("tEXt", std::string("Title\0x", 7), false);
  CHECK(load_png(scratch, small_png(many)).warnings.size() == loaded.warnings.size());
  CHECK_THROWS_WITH(load_png(scratch, small_png(png_chunk("tRNS", "abc"))), Contains("tRNS"));
  CHECK_THROWS_WITH(load_png(scratch, small_png(png_chunk("tRNS", std::string("\0\x0a", 2), false))),
                    Contains("p.png") && Contains("damaged") && Contains("tRNS"));
  const std::string header = kPngSignature + png_header(2, 2);
  CHECK_THROWS_WITH(load_png(scratch, header + png_chunk("IDAT", deflated(std::string(6, '\0')), false) +
                                          png_chunk("IEND", "")),
                    Contains("damaged") && Contains("IDAT"));
}

TEST_CASE("a PNG that does not begin with its header is refused, and Apple's own by name", "[files]") {
  const ScratchFolder scratch;
  const std::string image = small_png().substr(8);
  CHECK_THROWS_WITH(load_png(scratch, kPngSignature + png_chunk("CgBI", "abcd") + image), Contains("CgBI"));
  CHECK_THROWS_WITH(load_png(scratch, kPngSignature + png_chunk("gAMA", "abcd") + image),
                    Contains("damaged") && Contains("IHDR"));
}

TEST_CASE("transparent samples are missing", "[files]") {
  const ScratchFolder scratch;
  const LoadedHeightmap by_chunk = load_png(scratch, small_png(png_chunk("tRNS", std::string("\0\x14", 2))));
  CHECK(count_missing(by_chunk.map) == 1);
  CHECK(by_chunk.facts.levels == 3);
  CHECK_THAT(by_chunk.warnings.back().message, Contains("1 of its samples are transparent"));
  const auto with_alpha = [](const std::string& rows) {
    return kPngSignature + png_header(2, 2, 4) + png_chunk("IDAT", deflated(rows)) + png_chunk("IEND", "");
  };
  const LoadedHeightmap by_alpha =
      load_png(scratch, with_alpha(std::string("\0\x0a\xff\x14\0\0\x1e\xff\x28\x01", 10)));
  CHECK(count_missing(by_alpha.map) == 1);
  CHECK(by_alpha.facts.highest == 40);
  // Alpha that is 0 everywhere was never meant as such.
  const LoadedHeightmap all = load_png(scratch, with_alpha(std::string("\0\x0a\0\x14\0\0\x1e\0\x28\0", 10)));
  CHECK(count_missing(all.map) == 0);
  CHECK_THAT(all.warnings.back().message, Contains("alpha"));
}

TEST_CASE("heights in the digits of colours are told apart from pictures", "[files]") {
  const ScratchFolder scratch;
  const auto rgb = [&](auto&& colour_at) {
    std::string rows;
    for (int row = 0; row < 16; ++row) {
      rows += '\0';
      for (int column = 0; column < 16; ++column) rows += colour_at(row, column);
    }
    return kPngSignature + png_header(16, 16, 2) + png_chunk("IDAT", deflated(rows)) + png_chunk("IEND", "");
  };
  const std::string terrarium = rgb([](int row, int column) {
    const int code = (32768 + 500 + 3 * row) * 256 + 77 * column;  // metres, and 256ths of one
    return big_endian(static_cast<std::uint32_t>(code)).substr(1);
  });
  const std::string picture = rgb([](int row, int column) {
    return std::string{static_cast<char>(16 * row), static_cast<char>(9 * column),
                       static_cast<char>(5 * (row + column))};
  });
  CHECK_THROWS_WITH(load_png(scratch, terrarium), Contains("Terrarium") && Contains("decode"));
  try {
    load_png(scratch, picture);
    FAIL("was read");
  } catch (const Error& error) {
    CHECK(error.remedy == "channel");
    CHECK_THAT(error.what(), !Contains("Terrarium"));
  }
}
