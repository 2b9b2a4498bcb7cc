#include "files/image_read.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <memory>

#include "files/exr_header.h"
#include "files/input_file.h"
#include "files/map_size.h"
#include "files/named.h"

namespace heightlight {
namespace {

/// A sample type that this reader accepts: as stored in the file, and as kept in memory.
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

const StoredType& find_stored_type(const InputFile& file, const OIIO::ImageSpec& spec) {
  for (const StoredType& type : kStoredTypes) {
    if (spec.format.basetype == type.stored) return type;
  }
  throw file.error(std::string("its samples are of type ") + spec.format.c_str() +
                   ", which is not supported");
}

/// OpenImageIO 2.4 silently delivers zeros or garbage where a TIFF's samples are 64-bit and in tiles or in a
/// single row, or have more than 16 bits without filling their type. Throws Error for such files.
void check_tiff_layout(const InputFile& file, const OIIO::ImageSpec& spec, int bits) {
  const int type_bits = static_cast<int>(spec.format.size()) * 8;
  if (type_bits == 64 && (spec.tile_width > 0 || spec.height == 1))
    throw file.error(
        "64-bit TIFF samples in tiles or in a single row are not supported; use strips or 32 bits");
  if (bits > 16 && bits != type_bits)
    throw file.error(std::to_string(bits) + "-bit TIFF samples are not supported; use 16 or 32 bits");
}

/// Checks for content that would crash a library or exhaust memory.
void check_before_opening(const InputFile& file, FileFormat format, StoredImage& image) {
  if (format == FileFormat::openexr) check_exr_headers(file);
  if (format != FileFormat::tiff) return;
  image.tiff = read_tiff_facts(file);
  if (image.tiff->is_cmyk_in_tiles)
    throw file.error("a CMYK image in tiles is not supported; convert it to grey or RGB");
}

std::unique_ptr<OIIO::ImageInput> open_image(const InputFile& file, FileFormat format,
                                             OIIO::ImageSpec& spec) {
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(to_string(format));
  if (!input) throw file.error("cannot be read: no reader for " + std::string(to_string(format)));
  OIIO::ImageSpec configuration;
  configuration.attribute("oiio:UnassociatedAlpha", 1);  // heights must not be multiplied by alpha
  if (!input->open(file.name_for_libraries(), spec, configuration)) {
    throw file.error(std::string("cannot be read as ") + to_string(format) + ": " +
                     file.explain(input->geterror()));
  }
  return input;
}

std::vector<std::string> part_names(OIIO::ImageInput& input) {
  std::vector<std::string> names;
  for (int part = 0; input.seek_subimage(part, 0); ++part) {
    names.push_back(input.spec().get_string_attribute("oiio:subimagename", std::to_string(part)));
  }
  static_cast<void>(input.geterror());  // clears the error that there is no part after the last
  return names;
}

/// Index of the image to read.
int choose_part(const InputFile& file, FileFormat format, OIIO::ImageInput& input,
                const std::optional<std::string>& part) {
  if (format != FileFormat::openexr) return 0;
  const std::vector<std::string> names = part_names(input);
  if (part) return static_cast<int>(find_named("part", file, names, *part));
  if (names.size() <= 1) return 0;
  throw file.error("has " + std::to_string(names.size()) + " parts: " + join_names(names) + "; choose one",
                   "part");
}

/// OpenImageIO inverts 8-bit grey where white is zero, but no other type. This restores the file's values.
void turn_back_white_is_zero(StoredImage& image) {
  if (!image.tiff || !image.tiff->white_is_zero) return;
  if (auto* levels = std::get_if<std::vector<std::uint8_t>>(&image.samples)) {
    for (std::uint8_t& level : *levels) level = static_cast<std::uint8_t>(255 - level);
  }
}

/// An image as its header describes it; its samples are to be read as `kept`.
StoredImage describe_image(const OIIO::ImageSpec& spec, const StoredType& type, StoredImage image) {
  image.width = spec.width;
  image.height = spec.height;
  image.sample_type = type.name;
  image.bits = spec.get_int_attribute("oiio:BitsPerSample", static_cast<int>(spec.format.size()) * 8);
  image.is_integer = !spec.format.is_floating_point();
  image.channels = spec.channelnames;
  return image;
}

}  // namespace

struct TiffRows::Library {
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
  const StoredType* type = nullptr;
};

TiffRows::TiffRows(const InputFile& file) : file_(file), library_(std::make_unique<Library>()) {
  check_before_opening(file, FileFormat::tiff, header_);
  library_->input = open_image(file, FileFormat::tiff, library_->spec);
  library_->type = &find_stored_type(file, library_->spec);
  header_ = describe_image(library_->spec, *library_->type, std::move(header_));
  check_tiff_layout(file, library_->spec, header_.bits);
  check_tiff_blocks(file);
}

TiffRows::~TiffRows() = default;

int TiffRows::together() const {
  const int strip = library_->spec.get_int_attribute("tiff:RowsPerStrip", 1);
  return library_->spec.tile_height > 0 ? library_->spec.tile_height : std::clamp(strip, 1, 256);
}

StoredImage TiffRows::read(int first, int count) {
  const OIIO::ImageSpec& spec = library_->spec;
  StoredImage rows = header_;
  rows.height = count;
  rows.samples = library_->type->make(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(count) *
                                      static_cast<std::size_t>(spec.nchannels));
  const OIIO::TypeDesc kept(library_->type->kept);
  const bool read = std::visit(
      [&](auto& samples) {
        return spec.tile_width > 0 ? library_->input->read_tiles(0, 0, 0, spec.width, first, first + count, 0,
                                                                 1, 0, spec.nchannels, kept, samples.data())
                                   : library_->input->read_scanlines(0, 0, first, first + count, 0, 0,
                                                                     spec.nchannels, kept, samples.data());
      },
      rows.samples);
  if (!read || library_->input->has_error())
    throw file_.error("is damaged or truncated: " + file_.explain(library_->input->geterror()));
  turn_back_white_is_zero(rows);
  return rows;
}

StoredImage read_image(const InputFile& file, FileFormat format, const ReadLimit& limit,
                       const std::optional<std::string>& part) {
  if (part && format != FileFormat::openexr)
    throw UsageError(file.path().string() + ": has no parts; only EXR files have");
  if (format == FileFormat::png) return read_png(file, limit);
  StoredImage image;
  check_before_opening(file, format, image);
  OIIO::ImageSpec spec;
  const std::unique_ptr<OIIO::ImageInput> input = open_image(file, format, spec);
  const int chosen = choose_part(file, format, *input, part);
  spec = input->spec(chosen);
  if (spec.deep || spec.depth > 1) throw file.error("holds deep or volume data, not an image");
  const StoredType& type = find_stored_type(file, spec);
  const OIIO::TypeDesc kept(type.kept);
  const auto channels = static_cast<std::uint64_t>(spec.nchannels);
  check_map_size(file.path(), static_cast<std::uint64_t>(spec.width), static_cast<std::uint64_t>(spec.height),
                 bytes_per_texel(channels * kept.size()), limit);

  image = describe_image(spec, type, std::move(image));
  if (format == FileFormat::tiff) {
    check_tiff_layout(file, spec, image.bits);
    check_tiff_blocks(file);
  }
  image.samples = type.make(spec.image_pixels() * channels);
  const bool read = std::visit(
      [&](auto& samples) { return input->read_image(chosen, 0, 0, spec.nchannels, kept, samples.data()); },
      image.samples);
  // The readers of TIFF and JPEG fill in the missing part of a truncated file, say so in a message, and
  // report success.
  if (!read || input->has_error())
    throw file.error("is damaged or truncated: " + file.explain(input->geterror()));
  turn_back_white_is_zero(image);
  return image;
}

int count_channels(const InputFile& file, FileFormat format) {
  StoredImage image;
  check_before_opening(file, format, image);
  OIIO::ImageSpec spec;
  open_image(file, format, spec);
  return spec.nchannels;
}

}  // namespace heightlight
