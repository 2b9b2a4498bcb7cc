#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/georeference.h"

namespace heightlight {

// Tag numbers of OGC GeoTIFF 1.1, and the two that GDAL adds.
constexpr std::uint16_t kPixelScaleTag = 33550;
constexpr std::uint16_t kTiePointTag = 33922;
constexpr std::uint16_t kTransformationTag = 34264;
constexpr std::uint16_t kKeyDirectoryTag = 34735;
constexpr std::uint16_t kDoubleParametersTag = 34736;
constexpr std::uint16_t kTextParametersTag = 34737;
constexpr std::uint16_t kGdalMetadataTag = 42112;
constexpr std::uint16_t kGdalNoDataTag = 42113;

/// Makes a tag of type double, short or text.
GeoTag make_tag(std::uint16_t number, const std::vector<double>& values);
GeoTag make_tag(std::uint16_t number, const std::vector<std::uint16_t>& values);
GeoTag make_tag(std::uint16_t number, const std::string& text);

/// The values of a tag that has the type asked for; empty for a tag of another type.
std::vector<double> doubles_of(const GeoTag& tag);
std::vector<std::uint16_t> shorts_of(const GeoTag& tag);
std::string text_of(const GeoTag& tag);  ///< up to its first zero byte

/// Finds what GDAL's metadata, an XML text, says about a band in a role ("unittype", "scale", "offset").
/// Takes the first entry with that role; empty where there is none.
std::string metadata_in_role(const std::string& metadata, const std::string& role);

/// The tag with that number; nullptr where there is none.
const GeoTag* find_tag(const std::vector<GeoTag>& tags, std::uint16_t number);

/// What the keys of a GeoTIFF say about its coordinates (OGC GeoTIFF 1.1, section 7).
struct GeoKeys {
  bool present = false;          ///< whether there is a directory of keys
  bool point_samples = false;    ///< whether coordinates are those of samples, not of cell corners
  bool in_degrees = false;       ///< whether the coordinates are geographic
  std::optional<double> metres;  ///< length of the unit of projected coordinates, in metres
  std::optional<double> height_metres;
  std::optional<double>
      equator_radius;      ///< equatorial radius of the ellipsoid of geographic coordinates, metres
  std::string system;      ///< "EPSG:32631"
  std::string projection;  ///< well-known text, where the system is given as text
};

/// Reads the GeoTIFF keys. `fault` receives what is wrong with them, in words that continue a sentence after
/// the file's name; it stays empty where nothing is wrong. Faults are a damaged directory, coordinates that
/// are neither projected nor geographic, and units of unknown length. A projected system without a unit is
/// taken to use metres if it is one of the widely used systems that do; otherwise this is a fault.
GeoKeys read_geo_keys(const std::vector<GeoTag>& tags, std::string& fault);

/// Makes GeoTIFF tags for a map whose file is not a GeoTIFF: its corner and cell size, and the EPSG code if
/// `Georeference::system` has one, else the text of its .prj. In the latter case, a reader learns from that
/// text whether coordinates are degrees or lengths.
std::vector<GeoTag> make_geo_tags(const Georeference& place);

}  // namespace heightlight
