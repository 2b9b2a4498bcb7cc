#include "files/sample_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include "files/geo_keys.h"
#include "files/map_size.h"
#include "files/printable.h"

namespace heightlight {
namespace {

/// A sample type.
struct SampleKind {
  const char* code;  ///< NumPy's type code without byte order
  const char* name;
  std::size_t bytes;
  bool is_integer;
  double (*read)(const unsigned char* bytes);  ///< reads one sample in this machine's byte order
};

template <class T>
double read_as(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return static_cast<double>(value);
}

/// Reads an IEEE 754 half: 1 sign bit, 5 exponent bits, 10 fraction bits.
double read_half(const unsigned char* bytes) {
  std::uint16_t half = 0;
  std::memcpy(&half, bytes, sizeof half);
  const double sign = (half & 0x8000) != 0 ? -1 : 1;
  const int exponent = half >> 10 & 0x1f;
  const double fraction = half & 0x3ff;
  if (exponent == 0) return sign * std::ldexp(fraction, -24);
  if (exponent == 31) return fraction == 0 ? sign * HUGE_VAL : std::nan("");
  return sign * std::ldexp(1024 + fraction, exponent - 25);
}

constexpr std::array kTypes{
    SampleKind{"u1", "uint8", 1, true, read_as<std::uint8_t>},
    SampleKind{"i1", "int8", 1, true, read_as<std::int8_t>},
    SampleKind{"u2", "uint16", 2, true, read_as<std::uint16_t>},
    SampleKind{"i2", "int16", 2, true, read_as<std::int16_t>},
    SampleKind{"u4", "uint32", 4, true, read_as<std::uint32_t>},
    SampleKind{"i4", "int32", 4, true, read_as<std::int32_t>},
    SampleKind{"u8", "uint64", 8, true, read_as<std::uint64_t>},
    SampleKind{"i8", "int64", 8, true, read_as<std::int64_t>},
    SampleKind{"f2", "half", 2, false, read_half},
    SampleKind{"f4", "float", 4, false, read_as<float>},
    SampleKind{"f8", "double", 8, false, read_as<double>},
};

const SampleKind& find_type(std::string_view code) {
  return *std::find_if(kTypes.begin(), kTypes.end(),
                       [&](const SampleKind& type) { return type.code == code; });
}

/// Position and layout of the samples in a file.
struct SampleLayout {
  const SampleKind& type;
  int width = 0;
  int height = 0;
  std::uint64_t begin = 0;  ///< offset of the first sample, in bytes
  bool big_endian = false;
  bool by_columns = false;
};

SampleGrid read_samples(const InputFile& file, const SampleLayout& layout, const ReadLimit& limit) {
  const SampleKind& type = layout.type;
  const auto width = static_cast<std::uint64_t>(layout.width);
  const auto height = static_cast<std::uint64_t>(layout.height);
  check_map_size(file.path(), width, height, sizeof(double) + sizeof(float), limit);
  const std::uint64_t needed = layout.begin + width * height * type.bytes;
  if (file.size() < needed)
    throw file.error("is truncated: " + std::to_string(file.size()) + " bytes of " + std::to_string(needed));
  std::FILE* stream = file.rewound();
  if (fseeko(stream, static_cast<off_t>(layout.begin), SEEK_SET) != 0) throw file.error("cannot be read");
  SampleGrid grid{.sample_type = type.name,
                  .bits = static_cast<int>(8 * type.bytes),
                  .is_integer = type.is_integer,
                  .values = Image<double>(layout.width, layout.height),
                  .place = {}};
  const bool swaps = layout.big_endian != (std::endian::native == std::endian::big);
  const std::uint64_t lines = layout.by_columns ? width : height;
  std::vector<unsigned char> line((layout.by_columns ? height : width) * type.bytes);
  for (std::uint64_t i = 0; i < lines; ++i) {
    if (std::fread(line.data(), 1, line.size(), stream) != line.size())
      throw file.error("ended while it was read");
    for (std::size_t k = 0; k * type.bytes < line.size(); ++k) {
      unsigned char* bytes = line.data() + k * type.bytes;
      if (swaps) std::reverse(bytes, bytes + type.bytes);
      grid.values.values[layout.by_columns ? k * width + i : i * width + k] = type.read(bytes);
    }
  }
  return grid;
}

/// The text after `'key':` in the dictionary of a NumPy header, up to the next key.
std::string header_value(const InputFile& file, const std::string& header, const std::string& key) {
  const std::size_t at = header.find("'" + key + "':");
  if (at == std::string::npos) throw file.error("is damaged: its header has no " + key);
  std::string value = header.substr(at + key.size() + 3);
  const bool is_tuple = value.find('(') < value.find('\'');
  value = value.substr(0, value.find(is_tuple ? ')' : ','));
  std::erase_if(value, [](unsigned char c) { return std::isspace(c) || c == '\'' || c == '(' || c == '}'; });
  return value;
}

/// Reads a shape such as "(480, 640)": rows and columns.
std::array<int, 2> parse_shape(const InputFile& file, const std::string& text) {
  std::array<int, 2> shape{};
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); ++count) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string number = text.substr(at, end - at);
    constexpr std::size_t kMostDigits = 9;
    if (number.empty() || number.size() > kMostDigits ||
        number.find_first_not_of("0123456789") != std::string::npos)
      throw file.error("is damaged: its header's shape is (" + printable(text) + ")");
    if (count < shape.size()) shape.at(count) = std::stoi(number);
    at = end + 1;
  }
  if (count != shape.size())
    throw file.error("holds an array of " + std::to_string(count) + " dimensions; heights have two");
  return shape;
}

/// Degrees from "N45" or "W123" at position `at` in a name; empty if there are none.
std::optional<double> parse_degrees(const std::string& name, std::size_t at, std::size_t digits,
                                    std::string_view letters) {
  if (name.size() < at + 1 + digits) return std::nullopt;
  const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(name[at])));
  const std::string number = name.substr(at + 1, digits);
  if (letters.find(letter) == letters.npos || number.find_first_not_of("0123456789") != number.npos)
    return std::nullopt;
  return (letter == letters[0] ? 1 : -1) * std::stod(number);
}

constexpr std::array<int, 2> kSrtmSides{1201, 3601};

int srtm_side(const InputFile& file) {
  for (const int side : kSrtmSides) {
    if (file.size() == 2 * static_cast<std::uint64_t>(side) * static_cast<std::uint64_t>(side)) return side;
  }
  return 0;
}

}  // namespace

SampleGrid read_numpy(const InputFile& file, const ReadLimit& limit) {
  std::array<unsigned char, 12> head{};
  std::FILE* stream = file.rewound();
  if (std::fread(head.data(), 1, head.size(), stream) != head.size()) throw file.error("is truncated");
  const bool is_long = head[6] >= 2;  // version 2 and later: the header's length has four bytes
  const std::uint64_t begin = is_long ? 12 : 10;
  std::uint64_t length = head[8] | head[9] << 8;
  if (is_long) length |= static_cast<std::uint64_t>(head[10] | head[11] << 8) << 16;
  constexpr std::uint64_t kLongestHeader = 65536;
  if (head[6] < 1 || head[6] > 3 || length > kLongestHeader)
    throw file.error("is a NumPy array of a version that is not known");
  std::string header(length, '\0');
  if (fseeko(stream, static_cast<off_t>(begin), SEEK_SET) != 0 ||
      std::fread(header.data(), 1, length, stream) != length)
    throw file.error("is truncated");
  const std::string type = header_value(file, header, "descr");
  const std::array<int, 2> shape = parse_shape(file, header_value(file, header, "shape"));
  const auto known = std::find_if(kTypes.begin(), kTypes.end(), [&](const SampleKind& one) {
    return type.size() == 3 && type.substr(1) == one.code &&
           std::string_view("<>|=").find(type[0]) != std::string_view::npos;
  });
  if (known == kTypes.end())
    throw file.error("holds samples of type " + printable(type.substr(0, 32)) + "; heights are numbers");
  return read_samples(file,
                      {.type = *known,
                       .width = shape[1],
                       .height = shape[0],
                       .begin = begin + length,
                       .big_endian = type[0] == '>',
                       .by_columns = header_value(file, header, "fortran_order") == "True"},
                      limit);
}

bool is_srtm(const InputFile& file) {
  std::string extension = file.path().extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".hgt" && srtm_side(file) > 0;
}

std::optional<Georeference> srtm_place(const InputFile& file) {
  const int side = srtm_side(file);
  const std::string name = file.path().filename().string();
  const std::optional<double> south = parse_degrees(name, 0, 2, "NS");
  const std::optional<double> west = parse_degrees(name, 3, 3, "EW");
  if (side == 0 || !south || !west) return std::nullopt;
  // The outermost samples lie on the degree's border, so their cells extend half a cell beyond it.
  const double cell = 1.0 / (side - 1);
  Georeference place{.corner = {{*west - cell / 2, *south + 1 + cell / 2}},
                     .cell = {cell, cell},
                     .in_degrees = true,
                     .system = "EPSG:4326"};
  place.tags = make_geo_tags(place);
  return place;
}

SampleGrid read_srtm(const InputFile& file, const ReadLimit& limit) {
  const int side = srtm_side(file);
  if (side == 0) throw file.error("is no SRTM tile: these have 1201 or 3601 samples a side");
  SampleGrid grid =
      read_samples(file, {.type = find_type("i2"), .width = side, .height = side, .big_endian = true}, limit);
  grid.place = srtm_place(file);
  return grid;
}

SampleGrid read_raw(const InputFile& file, const RawLayout& layout, const ReadLimit& limit) {
  const std::uint64_t count =
      static_cast<std::uint64_t>(layout.width) * static_cast<std::uint64_t>(layout.height);
  for (const char* code : {"u1", "u2", "f4"}) {
    const SampleKind& type = find_type(code);
    if (file.size() != count * type.bytes) continue;
    return read_samples(
        file, {.type = type, .width = layout.width, .height = layout.height, .big_endian = layout.big_endian},
        limit);
  }
  throw file.error("has " + std::to_string(file.size()) + " bytes, which " + std::to_string(layout.width) +
                       " × " + std::to_string(layout.height) + " samples of 8, 16 or 32 bits do not have",
                   "size");
}

Error raw_needs_size(const InputFile& file) {
  const auto side = static_cast<std::uint64_t>(std::llround(std::sqrt(static_cast<double>(file.size()) / 2)));
  const std::string size = std::to_string(side) + "x" + std::to_string(side);
  return file.error("holds raw samples, without a header that gives their size",
                    2 * side * side == file.size() && side > 0 ? "size " + size : "size");
}

}  // namespace heightlight
