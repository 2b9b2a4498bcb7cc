#include <catch2/catch.hpp>

#include "files/geo_keys.h"
#include "files/geotiff_place.h"
#include "files/projection_text.h"

using namespace heightlight;
using Catch::Contains;

namespace {

using Doubles = std::vector<double>;
using Shorts = std::vector<std::uint16_t>;

constexpr int kGridRows = 100;
const GeoTag kScale = make_tag(kPixelScaleTag, Doubles{30, 20, 0});
const GeoTag kTie = make_tag(kTiePointTag, Doubles{2, 1, 0, 5e5, 4e6, 0});
const GeoTag kUtm =
    make_tag(kKeyDirectoryTag, Shorts{1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32631});

GeoTag transformation(double a, double b, double e, double f) {
  return make_tag(kTransformationTag, Doubles{a, b, 0, 499940, e, f, 0, 4000020, 0, 0, 0, 0, 0, 0, 0, 1});
}

std::string fault_of_place(const std::vector<GeoTag>& tags) {
  const GeotiffPlace read = read_geotiff_place(tags, kGridRows);
  CHECK(read.place.has_value() == read.fault.empty());
  return read.fault;
}

}  // namespace

TEST_CASE("a scale and a tie point place the corner, as a transformation does", "[files]") {
  for (const std::vector<GeoTag>& tags :
       {std::vector{kScale, kTie, kUtm}, std::vector{transformation(30, 0, 0, -20), kUtm}}) {
    const GeotiffPlace read = read_geotiff_place(tags, kGridRows);
    REQUIRE(read.place);
    CHECK(read.place->corner == std::array{499940.0, 4000020.0});
    CHECK(read.place->cell.x == 30);
    CHECK(read.place->cell.y == 20);
    CHECK(read.place->metres == 1);
    CHECK(read.place->system == "EPSG:32631");
    CHECK(read.place->tags == tags);
  }
}

TEST_CASE("places of samples are half a cell inside their corners", "[files]") {
  const GeoTag keys =
      make_tag(kKeyDirectoryTag, Shorts{1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 2, 3072, 0, 1, 32631});
  const GeotiffPlace read = read_geotiff_place({kScale, kTie, keys}, kGridRows);
  REQUIRE(read.place);
  CHECK(read.place->corner == std::array{499925.0, 4000030.0});
  const GeotiffPlace shrunk = read_geotiff_place(shrink_place(*read.place, 4).tags, kGridRows / 4);
  REQUIRE(shrunk.place);
  CHECK(shrunk.place->corner == read.place->corner);
  CHECK(shrunk.place->cell.x == 120);
}

TEST_CASE("a TIFF without a place has none, and no fault", "[files]") {
  for (const std::vector<GeoTag>& tags : {std::vector<GeoTag>{}, std::vector{kUtm}}) {
    const GeotiffPlace read = read_geotiff_place(tags, kGridRows);
    CHECK_FALSE(read.place);
    CHECK(read.fault.empty());
  }
}

TEST_CASE("odd and contradictory tags are faults, each in words", "[files]") {
  const auto keys = [](Shorts words) { return make_tag(kKeyDirectoryTag, std::move(words)); };
  CHECK_THAT(fault_of_place({make_tag(kPixelScaleTag, Doubles{30, 0, 0}), kTie}), Contains("positive"));
  CHECK_THAT(fault_of_place({make_tag(kPixelScaleTag, Doubles{30, 20}), kTie}), Contains("pixel scale"));
  CHECK_THAT(fault_of_place({make_tag(kPixelScaleTag, Shorts{30, 20, 0}), kTie}), Contains("pixel scale"));
  CHECK_THAT(fault_of_place({kScale, make_tag(kTiePointTag, Doubles{0, 0, 0})}), Contains("six numbers"));
  CHECK_THAT(fault_of_place({kScale, make_tag(kTiePointTag, Doubles(12))}), Contains("contradict"));
  CHECK_THAT(fault_of_place({kTie}), Contains("no pixel scale"));
  CHECK_THAT(fault_of_place({make_tag(kTiePointTag, Doubles(24))}), Contains("control points"));
  CHECK_THAT(fault_of_place({transformation(30, 1, -1, -20)}), Contains("rotated or sheared"));
  CHECK_THAT(fault_of_place({transformation(30, 0, 0, 20)}), Contains("south to north"));
  CHECK_THAT(fault_of_place({kScale, kTie, transformation(30, 0, 0, -21)}), Contains("contradict"));
  CHECK(fault_of_place({kScale, kTie, transformation(30, 0, 0, -20)}).empty());
  CHECK_THAT(fault_of_place({kScale, kTie, keys({1, 1, 0, 2, 1024, 0, 1, 1})}), Contains("damaged"));
  CHECK_THAT(fault_of_place({kScale, kTie, keys({1, 1, 0, 2, 1024, 0, 1, 1, 1024, 0, 1, 2})}),
             Contains("damaged"));
  CHECK_THAT(fault_of_place({kScale, kTie, keys({1, 1, 0, 1, 1025, 0, 1, 1})}),
             Contains("lengths or degrees"));
  CHECK_THAT(fault_of_place({kScale, kTie, keys({1, 1, 0, 1, 1024, 0, 1, 3})}),
             Contains("lengths or degrees"));
  CHECK_THAT(fault_of_place({kScale, kTie, keys({1, 1, 0, 1, 1024, 0, 1, 1})}), Contains("unit of length"));
  CHECK_THAT(fault_of_place({kScale, kTie, keys({1, 1, 0, 2, 1024, 0, 1, 1, 3076, 0, 1, 9037})}),
             Contains("EPSG:9037"));
  CHECK_THAT(fault_of_place({kScale, kTie, keys({1, 1, 0, 1, 1024, 0, 1, 2})}), Contains("beyond the poles"));
  CHECK_THAT(fault_of_place({kScale, kTie, keys({1, 1, 0, 2, 1024, 0, 1, 2, 2054, 0, 1, 9101})}),
             Contains("EPSG:9101"));
}

TEST_CASE("texts of projections tell degrees, lengths and codes", "[files]") {
  const auto note = [](const char* text) {
    Georeference place;
    note_projection(text, place);
    return place;
  };
  CHECK(note("GEOGCS[\"GCS_WGS_1984\",UNIT[\"Degree\",0.0174532925199433]]").in_degrees);
  const Georeference feet = note(
      "PROJCS[\"NAD83 / Texas\",GEOGCS[\"NAD83\",UNIT[\"degree\",0.01745]],UNIT[\"US survey "
      "foot\",0.3048006096],"
      "AUTHORITY[\"EPSG\",\"2277\"]]");
  CHECK(feet.metres == Approx(1200.0 / 3937));
  CHECK(feet.system == "EPSG:2277");
  CHECK(note("PROJCS[\"x\",GEOGCS[\"y\",AUTHORITY[\"EPSG\",\"4326\"]],UNIT[\"metre\",1]]").system == "x");
  CHECK(note("Projection UTM Zone 31 Units METERS Zunits NO").metres == 1.0);
  CHECK(note("Projection GEOGRAPHIC Units DD").in_degrees);
  CHECK_FALSE(note("nothing that is known").metres);
}

TEST_CASE("keywords are words of their own, in any order", "[files]") {
  Georeference degrees;
  note_projection("Projection GEOGRAPHIC\nDatum WGS84\nZunits METERS\nUnits DD\nParameters\n", degrees);
  CHECK(degrees.in_degrees);
  CHECK_FALSE(degrees.metres);
  CHECK(degrees.height_metres == 1.0);
  CHECK(degrees.system == "EPSG:4326");
  CHECK(degrees.projection == "Projection GEOGRAPHIC Datum WGS84 Zunits METERS Units DD Parameters");
  Georeference zone;
  note_projection("Projection UTM\r\nZone 31\r\nDatum WGS84\r\nZunits NO\r\nUnits METERS\r\n", zone);
  CHECK(zone.metres == 1.0);
  CHECK_FALSE(zone.height_metres);
  CHECK(zone.system == "EPSG:32631");
  Georeference south;
  note_projection("Projection UTM Zone 31 Datum WGS84 Units METERS Yshift 10000000.0", south);
  CHECK(south.system.empty());
}

TEST_CASE("compound and bound systems are read for their horizontal part, and for the heights' unit",
          "[files]") {
  const std::string utm =
      "PROJCS[\"utm\",GEOGCS[\"wgs\",UNIT[\"degree\",0.0174]],UNIT[\"metre\",1],AUTHORITY[\"EPSG\",\"32631\"]"
      "]";
  const std::string feet =
      "VERT_CS[\"height\",VERT_DATUM[\"d\",2005],UNIT[\"foot\",0.3048],AUTHORITY[\"EPSG\",\"8228\"]]";
  for (const std::string& text : {"COMPD_CS[\"a [odd name\"," + utm + "," + feet + "]", utm + "," + feet}) {
    INFO(text);
    Georeference place;
    note_projection(text, place);
    CHECK(place.metres == 1.0);
    CHECK(place.height_metres == 0.3048);
    CHECK(place.system == "EPSG:32631");
  }
  Georeference bound;
  note_projection(
      "BOUNDCRS[SOURCECRS[PROJCRS[\"utm\",BASEGEOGCRS[\"wgs\"],LENGTHUNIT[\"metre\",1],ID[\"EPSG\",32631]]],"
      "TARGETCRS[GEOGCRS[\"other\",ID[\"EPSG\",4326]]]]",
      bound);
  CHECK_FALSE(bound.in_degrees);
  CHECK(bound.system == "EPSG:32631");
  Georeference moon;
  note_projection("GEOGCS[\"moon\",DATUM[\"moon\",SPHEROID[\"moon\",1737400.0,0.0]],UNIT[\"Degree\",0.0174]]",
                  moon);
  CHECK(moon.equator_radius == 1737400.0);
}

TEST_CASE("codes that keys do not hold stay in the text", "[files]") {
  Georeference place{.corner = {{0, 0}},
                     .cell = {1, 1},
                     .metres = 1,
                     .system = "EPSG:102100",
                     .projection = "PROJCS[\"x\"]"};
  const std::vector<GeoTag> tags = make_geo_tags(place);
  REQUIRE(find_tag(tags, kTextParametersTag));
  CHECK(text_of(*find_tag(tags, kTextParametersTag)) == "ESRI PE String = PROJCS[\"x\"]|");
}

TEST_CASE("vertical systems in feet tell the heights' unit", "[files]") {
  for (const auto& [code, metres] : {std::pair{6360, 1200.0 / 3937}, {8228, 0.3048}}) {
    const GeoTag keys = make_tag(kKeyDirectoryTag, Shorts{1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, 32631, 4096,
                                                          0, 1, static_cast<std::uint16_t>(code)});
    const GeotiffPlace read = read_geotiff_place({kScale, kTie, keys}, kGridRows);
    REQUIRE(read.place);
    CHECK(read.place->height_metres == metres);
  }
}

TEST_CASE("units that a file defines itself are named in words", "[files]") {
  const GeoTag keys = make_tag(kKeyDirectoryTag, Shorts{1, 1, 0, 2, 1024, 0, 1, 2, 2054, 0, 1, 32767});
  CHECK_THAT(fault_of_place({make_tag(kPixelScaleTag, Doubles{0.1, 0.1, 0}), keys}),
             Contains("of the file's own"));
}
