#include "files/specular_table_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "files/input_file.h"
#include "files/output_file.h"

namespace heightlight {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

/// The first twelve bytes of a KTX file, version 1 (Khronos, KTX File Format Specification).
constexpr std::array<unsigned char, 12> kIdentifier{0xAB, 'K',  'T',  'X',  ' ',  '1',
                                                    '1',  0xBB, '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t kSameOrder = 0x04030201;
constexpr std::uint32_t kUnsignedByte = 0x1401;  // GL_UNSIGNED_BYTE
constexpr std::uint32_t kRed = 0x1903;           // GL_RED
constexpr std::uint32_t kRed8 = 0x8229;          // GL_R8
constexpr const char* kKey = "heightlight";

struct KtxHeader {
  std::uint32_t order = kSameOrder;
  std::uint32_t type = kUnsignedByte;
  std::uint32_t type_size = 1;
  std::uint32_t format = kRed;
  std::uint32_t internal_format = kRed8;
  std::uint32_t base_format = kRed;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t depth = 0;
  std::uint32_t elements = 0;
  std::uint32_t faces = 1;
  std::uint32_t levels = 1;
  std::uint32_t key_bytes = 0;
};
static_assert(sizeof(KtxHeader) == 52);

constexpr std::size_t kBeforeKeys = kIdentifier.size() + sizeof(KtxHeader);

void append(std::string& bytes, std::uint32_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

std::string describe_layout(int side) {
  return fmt::format(
      "Specular occlusion of a cone, GGX, reflectance 0.04 (Jimenez 2016, eq. 30); 255 is 1. a: half-angle "
      "of the cone of openness; b: angle between bent normal and mirrored view; r: GGX's alpha; t: angle "
      "between normal and view. Coordinates from 0 to 1 in {0} values each: width a/(pi/2), height (F(b) - "
      "F(0))/(F(pi) - F(0)) with F(b) = w/sqrt(1 + w^2), w = (b - a)/(2 r), layers sqrt(r) within blocks of "
      "{0} layers, one block after the other t/(pi/2).",
      side);
}

/// The key and its value, preceded by their length, and padded to whole words.
std::string key_and_value(int side) {
  std::string pair = std::string(kKey) + '\0' + describe_layout(side) + '\0';
  std::string bytes;
  append(bytes, static_cast<std::uint32_t>(pair.size()));
  bytes += pair;
  bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
  return bytes;
}

}  // namespace

void write_specular_table(const std::filesystem::path& path, const SpecularTable& table) {
  const auto side = static_cast<std::uint32_t>(table.side);
  const std::string keys = key_and_value(table.side);
  const KtxHeader header{.width = side,
                         .height = side,
                         .depth = side * side,
                         .key_bytes = static_cast<std::uint32_t>(keys.size())};
  std::string bytes(kIdentifier.begin(), kIdentifier.end());
  bytes.append(reinterpret_cast<const char*>(&header), sizeof(header));
  bytes += keys;
  append(bytes, static_cast<std::uint32_t>(table.values.size()));
  bytes.append(table.values.begin(), table.values.end());
  write_bytes(path, bytes);
}

SpecularTable read_specular_table(const std::filesystem::path& path) {
  const InputFile file(path);
  constexpr std::uint64_t kMost = 64ULL * 64 * 64 * 64 + 65536;  // the largest table, and its description
  if (file.size() > kMost) throw file.error("is larger than any table of specular occlusion");
  std::vector<char> bytes(file.size());
  if (std::fread(bytes.data(), 1, bytes.size(), file.rewound()) != bytes.size())
    throw file.error("cannot be read");
  file.check_unchanged();
  if (bytes.size() < kBeforeKeys || std::memcmp(bytes.data(), kIdentifier.data(), kIdentifier.size()) != 0)
    throw file.error("is no KTX texture, as tables of specular occlusion are");
  KtxHeader header;
  std::memcpy(&header, bytes.data() + kIdentifier.size(), sizeof(header));
  const KtxHeader expected{.width = header.width,
                           .height = header.width,
                           .depth = header.width * header.width,
                           .key_bytes = header.key_bytes};
  if (std::memcmp(&header, &expected, sizeof(header)) != 0 || header.width < 4 || header.width > 64)
    throw file.error(
        fmt::format("is a texture of {} x {} x {}, no table of specular occlusion: side x side x "
                    "side^2 of 8 bits, side 4 to 64",
                    header.width, header.height, header.depth));
  const std::size_t values = std::size_t{header.width} * header.width * header.depth;
  const std::size_t begin = kBeforeKeys + std::size_t{header.key_bytes} + sizeof(std::uint32_t);
  if (bytes.size() != begin + values)
    throw file.error(fmt::format("holds {} bytes, but a table of side {} takes {}", bytes.size(),
                                 header.width, begin + values));
  SpecularTable table{.side = static_cast<int>(header.width), .values = std::vector<std::uint8_t>(values)};
  std::memcpy(table.values.data(), bytes.data() + begin, values);
  return table;
}

}  // namespace heightlight
