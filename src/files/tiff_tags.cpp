#include "files/tiff_tags.h"

#include <array>

#include "files/geo_keys.h"

namespace heightlight {
namespace {

/// Describes a tag that takes any number of values of a type.
TIFFFieldInfo field(std::uint16_t number, TIFFDataType type, const char* name) {
  return {number, TIFF_VARIABLE2, TIFF_VARIABLE2, type, FIELD_CUSTOM, 1, 1, const_cast<char*>(name)};
}

std::string escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) {
    if (c == '<') {
      xml += "&lt;";
    } else if (c == '&') {
      xml += "&amp;";
    } else {
      xml += c;
    }
  }
  return xml;
}

std::string metadata_item(const std::string& role, std::size_t band, const std::string& text) {
  if (text.empty()) return "";
  return "  <Item name=\"" + role + "\" sample=\"" + std::to_string(band) + "\" role=\"" + role + "\">" +
         escaped(text) + "</Item>\n";
}

void set_samples(TIFF* tiff, const TextureLayout& layout) {
  const auto channels = static_cast<std::uint16_t>(layout.channels.size());
  const bool is_float = layout.type == SampleType::half || layout.type == SampleType::real;
  const std::uint16_t bits = layout.type == SampleType::uint8 ? 8 : layout.type == SampleType::real ? 32 : 16;
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, channels);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, is_float ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
  // Bands of a georeferenced map are not colours, whatever their number.
  const bool is_colour = !layout.place && (channels == 3 || channels == 4);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, is_colour ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
  const int extra = channels - (is_colour ? 3 : 1);
  const std::vector<std::uint16_t> kinds(static_cast<std::size_t>(extra), EXTRASAMPLE_UNSPECIFIED);
  if (extra > 0) TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, extra, kinds.data());
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  if (layout.type != SampleType::half)  // libtiff has no predictor for half
    TIFFSetField(tiff, TIFFTAG_PREDICTOR, is_float ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
}

/// Sets a tag. libtiff takes the number of values, not of bytes; for texts it takes none if a host program
/// registered the tag so.
void set_place_tag(TIFF* tiff, const GeoTag& tag) {
  const TIFFField* field = TIFFFindField(tiff, tag.number, TIFF_ANY);
  if (field && !TIFFFieldPassCount(field)) {
    if (tag.type == TIFF_ASCII) TIFFSetField(tiff, tag.number, tag.bytes.c_str());
    return;
  }
  const std::size_t size = tag.type == TIFF_DOUBLE  ? sizeof(double)
                           : tag.type == TIFF_SHORT ? sizeof(short)
                                                    : 1;
  TIFFSetField(tiff, tag.number, static_cast<std::uint32_t>(tag.bytes.size() / size), tag.bytes.data());
}

void set_place(TIFF* tiff, const TextureLayout& layout) {
  for (const GeoTag& tag : layout.place->tags) {
    const bool is_of_samples = tag.number == kGdalMetadataTag || tag.number == kGdalNoDataTag;
    if (!is_of_samples) set_place_tag(tiff, tag);
  }
  const GeoTag* no_data = find_tag(layout.place->tags, kGdalNoDataTag);
  if (no_data && layout.type == SampleType::real) set_place_tag(tiff, *no_data);
  const std::string metadata = band_metadata(layout.bands);
  if (!metadata.empty()) set_place_tag(tiff, make_tag(kGdalMetadataTag, metadata));
}

}  // namespace

std::string band_metadata(const std::vector<BandText>& bands) {
  std::string items;
  for (std::size_t band = 0; band < bands.size(); ++band) {
    items += metadata_item("description", band, bands[band].description);
    items += metadata_item("unittype", band, bands[band].unit);
  }
  return items.empty() ? "" : "<GDALMetadata>\n" + items + "</GDALMetadata>\n";
}

void know_place_tags(TIFF* tiff) {
  static const std::array<TIFFFieldInfo, 8> kFields{
      field(kPixelScaleTag, TIFF_DOUBLE, "ModelPixelScaleTag"),
      field(kTiePointTag, TIFF_DOUBLE, "ModelTiepointTag"),
      field(kTransformationTag, TIFF_DOUBLE, "ModelTransformationTag"),
      field(kKeyDirectoryTag, TIFF_SHORT, "GeoKeyDirectoryTag"),
      field(kDoubleParametersTag, TIFF_DOUBLE, "GeoDoubleParamsTag"),
      field(kTextParametersTag, TIFF_ASCII, "GeoAsciiParamsTag"),
      field(kGdalMetadataTag, TIFF_ASCII, "GDALMetadata"),
      field(kGdalNoDataTag, TIFF_ASCII, "GDALNoDataValue")};
  TIFFMergeFieldInfo(tiff, kFields.data(), static_cast<std::uint32_t>(kFields.size()));
}

void set_tiff_tags(TIFF* tiff, const TextureLayout& layout, int factor) {
  constexpr std::uint32_t kTile = 256;
  const auto reduced = [factor](int side) {
    return static_cast<std::uint32_t>((side + factor - 1) / factor);
  };
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, reduced(layout.width));
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, reduced(layout.height));
  TIFFSetField(tiff, TIFFTAG_TILEWIDTH, kTile);
  TIFFSetField(tiff, TIFFTAG_TILELENGTH, kTile);
  set_samples(tiff, layout);
  if (factor > 1) {
    TIFFSetField(tiff, TIFFTAG_SUBFILETYPE, FILETYPE_REDUCEDIMAGE);
    return;
  }
  for (const auto& [name, text] : layout.attributes) {
    if (name == "ImageDescription") TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, text.c_str());
  }
  if (layout.place) set_place(tiff, layout);
}

}  // namespace heightlight
