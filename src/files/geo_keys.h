#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "heightlight/georeference.h"

namespace heightlight {

// Numbers of the tags of OGC GeoTIFF 1.1, and of the two that GDAL adds.
constexpr std::uint16_t kPixelScaleTag = 33550;
constexpr std::uint16_t kTiePointTag = 33922;
constexpr std::uint16_t kTransformationTag = 34264;
constexpr std::uint16_t kKeyDirectoryTag = 34735;
constexpr std::uint16_t kDoubleParametersTag = 34736;
constexpr std::uint16_t kTextParametersTag = 34737;
constexpr std::uint16_t kGdalMetadataTag = 42112;
constexpr std::uint16_t kGdalNoDataTag = 42113;

/// A tag of one of the three types.
GeoTag make_tag(std::uint16_t number, const std::vector<double>& values);
GeoTag make_tag(std::uint16_t number, const std::vector<std::uint16_t>& values);
GeoTag make_tag(std::uint16_t number, const std::string& text);

/// The values of a tag of that type; nothing of another.
std::vector<double> doubles_of(const GeoTag& tag);
std::vector<std::uint16_t> shorts_of(const GeoTag& tag);
std::string text_of(const GeoTag& tag);  ///< up to its first 0

/// What GDAL's metadata, a text of XML, say of a band in that role ("unittype", "scale", "offset"): the first
/// that has it; empty where none has.
std::string metadata_in_role(const std::string& metadata, const std::string& role);

/// The tag of that number; nullptr where there is none.
const GeoTag* find_tag(const std::vector<GeoTag>& tags, std::uint16_t number);

/// What the keys of a GeoTIFF say of its coordinates (OGC GeoTIFF 1.1, section 7).
struct GeoKeys {
  bool present = false;          ///< there is a directory of keys
  bool point_samples = false;    ///< places are those of samples, not of their cells' corners
  bool in_degrees = false;       ///< geographic coordinates
  std::optional<double> metres;  ///< length of the unit of projected ones
  std::optional<double> height_metres;
  std::optional<double> equator_radius;  ///< of the ellipsoid of degrees, metres
  std::string system;                    ///< "EPSG:32631"
  std::string projection;                ///< well-known text, where the system is told by one
};

/// Reads them. `fault` becomes what is wrong with them, in words that go on after the file's name, and stays
/// empty where nothing is: a damaged directory, coordinates that are neither projected nor geographic, units
/// of an unknown length. A projected system that is named without its unit has metres where it is one of
/// those in wide use that do; else that is a fault.
GeoKeys read_geo_keys(const std::vector<GeoTag>& tags, std::string& fault);

/// The tags that place a map whose file is no GeoTIFF: its corner and cell, a code of the EPSG register where
/// `Georeference::system` has one, or the text of its .prj. What that text is in, degrees or lengths, a
/// program reads from it.
std::vector<GeoTag> make_geo_tags(const Georeference& place);

}  // namespace heightlight
