#include <catch2/catch.hpp>
#include <chrono>

#include "files/image_file.h"
#include "files/input_file.h"
#include "files/json_file.h"
#include "files/printable.h"
#include "heightlight/files.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("a file that is replaced while it is in use is read and summed as it was", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_text(scratch / "a", "first");
  const InputFile file(path);
  const std::string sum = sha256_of_file(file);
  write_text(scratch / "b", "other");
  fs::rename(scratch / "b", path);
  CHECK(sha256_of_file(file) == sum);
  CHECK(read_text(file.name_for_libraries()) == "first");
  CHECK_NOTHROW(file.check_unchanged());
}

TEST_CASE("a file that is written to while it is in use is an error", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_text(scratch / "a", "first");
  const InputFile file(path);
  write_text(path, "longer");
  CHECK_THROWS_WITH(file.check_unchanged(), Contains("written to"));
  const fs::path other = write_text(scratch / "b", "first");
  const InputFile kept(other);
  fs::last_write_time(other, fs::last_write_time(other) + std::chrono::seconds(1));
  CHECK_THROWS_WITH(kept.check_unchanged(), Contains("b: was written to"));
}

TEST_CASE("names from outside are fit for one line of text or XML", "[files]") {
  CHECK(printable(std::string("plain ä € 𝛼")) == "plain ä € 𝛼");
  CHECK(printable(std::string("a\nb\tc\x1b[31m\x7f")) == "a?b?c?[31m?");
  CHECK(printable(std::string("\xff\xc0\xafx\xe2\x82")) == "???x??");
  CHECK(printable(std::string("\xed\xa0\x80")) == "?");  // a surrogate
  CHECK(printable(std::string("\xc2\x85\xe2\x80\xae\xef\xbf\xbf")) ==
        "???");  // next line, right-to-left, U+FFFF
}

TEST_CASE("files of JSON are bounded in depth and size", "[files]") {
  const ScratchFolder scratch;
  const fs::path deep = write_text(scratch / "deep.json", std::string(300'000, '['));
  CHECK_THROWS_WITH(read_json(deep), Contains("deep.json") && Contains("64 deep"));
  const fs::path large = write_text(scratch / "large.json", "[" + std::string(17 << 20, ' ') + "]");
  CHECK_THROWS_WITH(read_json(large), Contains("large.json") && Contains("too large"));
  CHECK(read_json(write_text(scratch / "mark.json", "\xef\xbb\xbf{\"a\": 1}"))["a"] == 1);
}

TEST_CASE("a byte-order mark before text is read over, UTF-16 is named", "[files]") {
  const ScratchFolder scratch;
  const std::string grid = "ncols 2\nnrows 1\ncellsize 1\n1 2\n";
  CHECK(load_heightmap(write_text(scratch / "m.asc", "\xef\xbb\xbf" + grid), {}, 1 << 20).facts.highest == 2);
  CHECK_THROWS_WITH(load_heightmap(write_text(scratch / "u.asc", "\xff\xfen\0c\0o\0l\0s\0"), {}, 1 << 20),
                    Contains("UTF-16"));
}

TEST_CASE("what is taken for a heightmap and is none is named, with the way out", "[files]") {
  const ScratchFolder scratch;
  const auto [name, bytes, what] = GENERATE(table<std::string, std::string, std::string>(
      {{"a.bmp", "BM" + std::string(100, '\x01'), "BMP"},
       {"a.gif", "GIF89a" + std::string(50, '\0'), "GIF"},
       {"a.webp", "RIFF1234WEBPVP8 " + std::string(50, '\0'), "WebP"}}));
  CHECK_THROWS_WITH(load_heightmap(write_text(scratch / name, bytes), {}, 1 << 20),
                    Contains(name) && Contains(what) && Contains("convert"));
}

TEST_CASE("lengths that nobody means are refused", "[files]") {
  const ScratchFolder scratch;
  const fs::path path = write_text(scratch / "g.asc", "ncols 2\nnrows 1\ncellsize 1\n1 2\n");
  for (const double length : {1e-40, 3e39, -1.0, 0.0}) {
    CHECK_THROWS_AS(load_heightmap(path, {.relief = length}, 1 << 20), UsageError);
    CHECK_THROWS_AS(load_heightmap(path, {.width = length}, 1 << 20), UsageError);
    CHECK_THROWS_AS(load_heightmap(path, {.texel = Spacing{1, length}}, 1 << 20), UsageError);
  }
}
