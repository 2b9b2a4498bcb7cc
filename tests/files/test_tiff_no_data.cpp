#include <catch2/catch.hpp>

#include "files/tiff_no_data.h"
#include "scratch_folder.h"

using namespace heightlight;

namespace {

/// Numbers of a TIFF, byte by byte, in either order.
class TiffText {
 public:
  explicit TiffText(bool little_endian) : little_endian_(little_endian) {}

  TiffText& add(std::uint64_t value, int size) {
    for (int i = 0; i < size; ++i) {
      const int place = little_endian_ ? i : size - 1 - i;
      bytes_ += static_cast<char>(value >> (8 * place) & 255);
    }
    return *this;
  }
  TiffText& add(const std::string& text) {
    bytes_ += text;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  bool little_endian_;
  std::string bytes_;
};

constexpr int kNoDataTag = 42113;
constexpr int kText = 2;

}  // namespace

TEST_CASE("GDAL's no-data tag is found in either byte order, inside its entry or apart from it", "[files]") {
  const ScratchFolder scratch;
  const bool little = GENERATE(true, false);
  const std::string order = little ? "II" : "MM";
  TiffText apart(little);
  apart.add(order).add(42, 2).add(8, 4).add(2, 2);              // header; a directory of two entries at 8
  apart.add(256, 2).add(4, 2).add(1, 4).add(5, 4);              // width
  apart.add(kNoDataTag, 2).add(kText, 2).add(7, 4).add(38, 4);  // seven characters at 38
  apart.add(0, 4).add(std::string("-99999\0", 7));
  CHECK(read_tiff_no_data(write_text(scratch / "apart.tif", apart.bytes())) == -99999.0);

  TiffText inside(little);
  inside.add(order).add(42, 2).add(8, 4).add(1, 2);
  inside.add(kNoDataTag, 2).add(kText, 2).add(3, 4).add(std::string("-1\0\0", 4)).add(0, 4);
  CHECK(read_tiff_no_data(write_text(scratch / "inside.tif", inside.bytes())) == -1.0);
}

TEST_CASE("GDAL's no-data tag is found in BigTIFF", "[files]") {
  const ScratchFolder scratch;
  TiffText big(true);
  big.add("II").add(43, 2).add(8, 2).add(0, 2).add(16, 8).add(1, 8);
  big.add(kNoDataTag, 2).add(kText, 2).add(6, 8).add(std::string("-9999\0\0\0", 8));
  CHECK(read_tiff_no_data(write_text(scratch / "big.tif", big.bytes())) == -9999.0);
}

TEST_CASE("A TIFF without the tag, cut short, or with words in it declares nothing", "[files]") {
  const ScratchFolder scratch;
  TiffText none(true);
  none.add("II").add(42, 2).add(8, 4).add(1, 2).add(256, 2).add(4, 2).add(1, 4).add(5, 4).add(0, 4);
  CHECK_FALSE(read_tiff_no_data(write_text(scratch / "none.tif", none.bytes())));
  CHECK_FALSE(read_tiff_no_data(write_text(scratch / "cut.tif", none.bytes().substr(0, 9))));
  TiffText words(true);
  words.add("II")
      .add(42, 2)
      .add(8, 4)
      .add(1, 2)
      .add(kNoDataTag, 2)
      .add(kText, 2)
      .add(4, 4)
      .add("none")
      .add(0, 4);
  CHECK_FALSE(read_tiff_no_data(write_text(scratch / "words.tif", words.bytes())));
}
