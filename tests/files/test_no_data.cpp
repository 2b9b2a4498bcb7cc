#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "files/no_data.h"
#include "heightlight/error.h"
#include "heightlight/files.h"
#include "scratch_folder.h"
#include "tiff_bytes.h"
#include "write_samples.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kNoDataMemory = 1 << 30;
constexpr float kLowest = std::numeric_limits<float>::lowest();

LoadedHeightmap load_any(const fs::path& path, const LoadOptions& options = {}) {
  return load_heightmap(path, options, kNoDataMemory);
}

fs::path write_tagged(const ScratchFolder& scratch, const std::string& no_data, float missing) {
  const std::vector<float> samples{1, 2, missing, 4};
  return write_text(scratch / "t.tif", TiffBytes(2, 2, samples, 3).add_text(42113, no_data).bytes());
}

}  // namespace

TEST_CASE("a no-data value stands for the nearest that samples can take", "[files]") {
  CHECK(as_stored(-9999.9, "float") == double{-9999.9F});
  CHECK(as_stored(-9999.9, "text") == double{-9999.9F});
  CHECK(as_stored(-9999.9, "double") == -9999.9);
  CHECK(as_stored(-3.4028235e+38, "float") == double{kLowest});  // rounded beyond it
  CHECK(as_stored(-9999, "half") == -10000.0);                   // eight apart up there
  CHECK(as_stored(1.0 / 3, "half") == 0.333251953125);
  CHECK(as_stored(std::ldexp(3, -26), "half") == std::ldexp(1, -24));  // the least denormal half
  CHECK_FALSE(as_stored(1e6, "half"));
  CHECK(as_stored(-32768.4, "int16") == -32768.0);
  CHECK_FALSE(as_stored(-9999, "uint8"));
  CHECK_FALSE(as_stored(-9999, "uint16"));
  CHECK_FALSE(as_stored(std::nan(""), "float"));
}

TEST_CASE("no-data text is a number to its end, or none", "[files]") {
  CHECK(parse_no_data(" -9999 ") == -9999.0);
  CHECK(parse_no_data("+1e20") == 1e20);
  CHECK(std::isnan(*parse_no_data("nan")));
  for (const char* text : {"-1.#IND", "-3,40e+38", "none", "", " ", "1e400"})
    CHECK_FALSE(parse_no_data(text));
}

TEST_CASE("what a TIFF declares goes missing, however many digits it has", "[files]") {
  const ScratchFolder scratch;
  const auto [text, missing] =
      GENERATE(table<std::string, float>({{"-3.4028235e+38", kLowest},
                                          {"-3.4028234663852886e+38", kLowest},
                                          {"-3.40282306074e+38", kLowest},  // as ArcGIS rounds it
                                          {"-9999.9", -9999.9F},
                                          {"1e20", 1e20F},
                                          {"-9999", -9999}}));
  CAPTURE(text);
  const LoadedHeightmap loaded = load_any(write_tagged(scratch, text, missing));
  CHECK(count_missing(loaded.map) == 1);
  CHECK(loaded.facts.lowest == 1);
  CHECK(loaded.facts.highest == 4);
}

TEST_CASE("a no-data tag that is no number is told, and takes nothing away", "[files]") {
  const ScratchFolder scratch;
  const LoadedHeightmap loaded = load_any(write_tagged(scratch, "-1.#IND", -1));
  CHECK(count_missing(loaded.map) == 0);
  CHECK_FALSE(loaded.facts.declared_no_data);
  REQUIRE_FALSE(loaded.warnings.empty());
  CHECK_THAT(loaded.warnings.back().message, Contains("'-1.#IND'"));
}

TEST_CASE("no-data given by the user meets half, text and integers as they are stored", "[files]") {
  const ScratchFolder scratch;
  const std::vector<float> halves{1, -9999, 3, 4};
  const fs::path half =
      write_samples(scratch / "h.exr", 2, 2, {"Y"}, halves, OIIO::TypeDesc(OIIO::TypeDesc::HALF));
  CHECK(count_missing(load_any(half, {.no_data = -9999}).map) == 1);
  const fs::path text = write_text(
      scratch / "t.asc", "ncols 2\nnrows 2\ncellsize 1\nNODATA_value -9999.9\n1 2 -9999.900390625 4\n");
  CHECK(count_missing(load_any(text).map) == 1);
  const fs::path far = write_text(
      scratch / "f.asc", "ncols 2\nnrows 2\ncellsize 1\nNODATA_value 1e20\n1 2 100000002004087734272 4\n");
  CHECK(count_missing(load_any(far).map) == 1);
  CHECK_THROWS_AS(load_any(text, {.no_data = std::nan("")}), UsageError);
}

TEST_CASE("Esri's default is missing where an ASCII grid names none, and that is told", "[files]") {
  const ScratchFolder scratch;
  const LoadedHeightmap loaded =
      load_any(write_text(scratch / "e.asc", "ncols 2\nnrows 2\ncellsize 1\n1 2 -9999 4\n"));
  CHECK(count_missing(loaded.map) == 1);
  CHECK(loaded.facts.declared_no_data == -9999.0);
  REQUIRE_FALSE(loaded.warnings.empty());
  CHECK_THAT(loaded.warnings.back().message, Contains("-9999"));
}

TEST_CASE("undeclared values far from all others are suspected, lowest or highest", "[files]") {
  const ScratchFolder scratch;
  const double odd = GENERATE(-32768.0, 32767.0, -9999.0, 9999.0, 1e10, 1e20, 3.4e38);
  std::vector<float> samples(100);
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = 500 + static_cast<float>(i);
  samples[42] = static_cast<float>(odd);
  const fs::path path = write_samples(scratch / "s.tif", 10, 10, {"Y"}, samples);
  CAPTURE(odd);
  std::string message;
  std::string remedy;
  try {
    const LoadedHeightmap loaded = load_any(path);
    REQUIRE_FALSE(loaded.warnings.empty());
    message = loaded.warnings[0].message;
    remedy = loaded.warnings[0].remedy;
  } catch (const Error& error) {  // beyond what can be computed
    CHECK(odd >= 1e20);
    message = error.what();
    remedy = error.remedy;
  }
  CHECK_THAT(message, Contains("row 4 and column 2") && Contains("far"));
  REQUIRE_THAT(remedy, Catch::StartsWith("no_data "));
  // What is advised does what it says.
  const LoadedHeightmap cured = load_any(path, {.no_data = std::stod(remedy.substr(8))});
  CHECK(count_missing(cured.map) == 1);
}

TEST_CASE("heights that are all of a kind are not suspected", "[files]") {
  const ScratchFolder scratch;
  const std::vector<float> step{0, 0, 0, 1, 1, 1};
  for (const Warning& warning : load_any(write_samples(scratch / "s.tif", 3, 2, {"Y"}, step)).warnings)
    CHECK_THAT(warning.message, !Contains("far"));
  const std::vector<std::uint16_t> wide{0, 6000, 14000, 20000, 26000, 32767};
  for (const Warning& warning : load_any(write_samples(scratch / "w.png", 3, 2, {"Y"}, wide)).warnings)
    CHECK_THAT(warning.message, !Contains("far"));
}
