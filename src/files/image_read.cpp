#include "files/image_read.h"

#include <OpenImageIO/imageio.h>

#include <array>
#include <memory>

#include "files/input_file.h"
#include "files/map_size.h"
#include "files/tiff_no_data.h"

namespace heightlight {
namespace {

/// A sample type that this reader takes: as stored, and as kept.
struct StoredType {
  OIIO::TypeDesc::BASETYPE stored;
  OIIO::TypeDesc::BASETYPE kept;
  const char* name;
  StoredSamples (*make)(std::size_t count);
};

template <class T>
StoredSamples make_samples(std::size_t count) {
  return std::vector<T>(count);
}

const std::array kStoredTypes{
    StoredType{OIIO::TypeDesc::UINT8, OIIO::TypeDesc::UINT8, "uint8", make_samples<std::uint8_t>},
    StoredType{OIIO::TypeDesc::INT8, OIIO::TypeDesc::INT8, "int8", make_samples<std::int8_t>},
    StoredType{OIIO::TypeDesc::UINT16, OIIO::TypeDesc::UINT16, "uint16", make_samples<std::uint16_t>},
    StoredType{OIIO::TypeDesc::INT16, OIIO::TypeDesc::INT16, "int16", make_samples<std::int16_t>},
    StoredType{OIIO::TypeDesc::UINT32, OIIO::TypeDesc::UINT32, "uint32", make_samples<std::uint32_t>},
    StoredType{OIIO::TypeDesc::INT32, OIIO::TypeDesc::INT32, "int32", make_samples<std::int32_t>},
    StoredType{OIIO::TypeDesc::HALF, OIIO::TypeDesc::FLOAT, "half", make_samples<float>},
    StoredType{OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::FLOAT, "float", make_samples<float>},
    StoredType{OIIO::TypeDesc::DOUBLE, OIIO::TypeDesc::DOUBLE, "double", make_samples<double>},
};

const StoredType& find_stored_type(const std::filesystem::path& path, const OIIO::ImageSpec& spec) {
  for (const StoredType& type : kStoredTypes) {
    if (spec.format.basetype == type.stored) return type;
  }
  throw file_error(
      path, std::string("its samples are of type ") + spec.format.c_str() + ", which is not supported");
}

/// OpenImageIO 2.4 leaves zeros or garbage, without a word, where a TIFF's samples are 64-bit in tiles or in
/// a single row, or of more than 16 bits without filling their type.
void check_tiff_layout(const std::filesystem::path& path, const OIIO::ImageSpec& spec, int bits) {
  const int type_bits = static_cast<int>(spec.format.size()) * 8;
  if (type_bits == 64 && (spec.tile_width > 0 || spec.height == 1)) {
    throw file_error(
        path, "64-bit TIFF samples in tiles or in a single row are not supported; use strips or 32 bits");
  }
  if (bits > 16 && bits != type_bits) {
    throw file_error(path, std::to_string(bits) + "-bit TIFF samples are not supported; use 16 or 32 bits");
  }
}

/// Messages of libraries may hold several lines and the path once more.
std::string first_line(const std::string& text) {
  return text.empty() ? "damaged or truncated" : text.substr(0, text.find('\n'));
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& path, FileFormat format,
                                             OIIO::ImageSpec& spec) {
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(to_string(format));
  if (!input) throw file_error(path, "cannot be read: no reader for " + std::string(to_string(format)));
  OIIO::ImageSpec configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);  // heights are not to be multiplied by alpha
  if (!input->open(path.string(), spec, configuration)) {
    throw file_error(
        path, std::string("cannot be read as ") + to_string(format) + ": " + first_line(input->geterror()));
  }
  return input;
}

}  // namespace

StoredImage read_image(const std::filesystem::path& path, FileFormat format, std::uint64_t memory_limit) {
  if (format == FileFormat::png) return read_png(path, memory_limit);

  OIIO::ImageSpec spec;
  const std::unique_ptr<OIIO::ImageInput> input = open_image(path, format, spec);
  if (spec.deep || spec.depth > 1) throw file_error(path, "holds deep or volume data, not an image");
  const StoredType& type = find_stored_type(path, spec);
  const OIIO::TypeDesc kept(type.kept);
  const auto channels = static_cast<std::uint64_t>(spec.nchannels);
  check_map_size(path, static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height),
                 bytes_per_texel(channels * kept.size()), memory_limit);

  StoredImage image;
  image.width = spec.width;
  image.height = spec.height;
  image.sample_type = type.name;
  image.bits = spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(spec.format.size()) * 8);
  image.is_integer = !spec.format.is_floating_point();
  image.channels = spec.channelnames;
  if (format == FileFormat::tiff) {
    check_tiff_layout(path, spec, image.bits);
    image.no_data = read_tiff_no_data(path);
  }
  image.samples = type.make(spec.image_pixels() * channels);
  const bool read = std::visit(
      [&](auto& samples) { return input->read_image(0, 0, 0, spec.nchannels, kept, samples.data()); },
      image.samples);
  // The readers of TIFF and JPEG fill what a truncated file lacks, say so in a message, and report success.
  if (!read || input->has_error()) {
    throw file_error(path, "is damaged or truncated: " + first_line(input->geterror()));
  }
  return image;
}

}  // namespace heightlight
