#include "files/file_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>

#include "files/named.h"
#include "files/sample_grid.h"

namespace heightlight {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  FileFormat format;
};

constexpr std::array kMagics{
    Magic{"\x89PNG\r\n\x1a\n"sv, FileFormat::png},
    Magic{"\x76\x2f\x31\x01"sv, FileFormat::openexr},
    Magic{"II*\0"sv, FileFormat::tiff},
    Magic{"MM\0*"sv, FileFormat::tiff},
    Magic{"II+\0"sv, FileFormat::tiff},  // BigTIFF
    Magic{"MM\0+"sv, FileFormat::tiff},
    Magic{"\xff\xd8\xff"sv, FileFormat::jpeg},
    Magic{"\x93NUMPY"sv, FileFormat::numpy},
    Magic{"#?R"sv, FileFormat::hdr},  // #?RADIANCE or #?RGBE
};

/// A format that people use for heightmaps and this program does not read, and advice on what to do.
struct Unread {
  std::string_view bytes;
  const char* what;
  const char* remedy;
};

constexpr const char* kConvert = "convert it to PNG (16 bits), TIFF or EXR";
constexpr const char* kUnpack = "unpack it";
constexpr std::array kUnread{
    Unread{"BM"sv, "a BMP image, of 8 bits at most", kConvert},
    Unread{"GIF8"sv, "a GIF image, of 8 bits at most", kConvert},
    Unread{"8BPS"sv, "a Photoshop document", kConvert},
    Unread{"DDS "sv, "a DDS texture", kConvert},
    Unread{"\xabKTX"sv, "a KTX texture", kConvert},
    Unread{"\0\0\0\x0cjP  "sv, "a JPEG 2000 image", kConvert},
    Unread{"\x89HDF"sv, "an HDF5 or NetCDF file", kConvert},
    Unread{"CDF"sv, "a NetCDF file", kConvert},
    Unread{"PK\x03\x04"sv, "a zip archive", kUnpack},
    Unread{"\x1f\x8b"sv, "a gzip archive", kUnpack},
};

int byte_at(std::string_view head, std::size_t place) { return static_cast<unsigned char>(head[place]); }

/// Targa has no magic number: an 18-byte header is accepted if every field holds one of its few legal values.
bool looks_like_targa(std::string_view head) {
  if (head.size() < 18) return false;
  const int has_palette = byte_at(head, 1);
  const int kind = byte_at(head, 2);
  const int palette_size = byte_at(head, 5) + 256 * byte_at(head, 6);
  const int depth = byte_at(head, 16);
  const bool known_kind = (kind >= 1 && kind <= 3) || (kind >= 9 && kind <= 11);
  const bool known_depth = depth == 8 || depth == 15 || depth == 16 || depth == 24 || depth == 32;
  const bool interleaved = (byte_at(head, 17) & 0xc0) != 0;
  return has_palette <= 1 && (has_palette == 1) == (palette_size > 0) && known_kind && known_depth &&
         !interleaved;
}

std::string to_lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool looks_like_esri_grid(const std::filesystem::path& path, std::string_view head) {
  if (to_lower(path.extension().string()) == ".asc") return true;
  const std::size_t start = std::min(head.find_first_not_of(" \t\r\n"), head.size());
  const std::string keyword = to_lower(std::string(head.substr(start, 6)));
  return keyword.starts_with("ncols") || keyword.starts_with("nrows");
}

/// Whether the name is that of a file of raw heights, as terrain tools and game engines write it.
bool is_named_raw(const std::filesystem::path& path) {
  constexpr std::array kRaw{".raw", ".r8", ".r16", ".r32", ".bin", ".bil", ".flt", ".hgt", ".ter"};
  const std::string extension = to_lower(path.extension().string());
  return std::find(kRaw.begin(), kRaw.end(), extension) != kRaw.end();
}

std::string explain_unread(std::string_view head) {
  for (const Unread& kind : kUnread) {
    if (!head.starts_with(kind.bytes)) continue;
    // requires a whole header
    if (kind.bytes.size() == 2 && kind.bytes == "BM" && head.size() < 54) continue;
    return std::string("is ") + kind.what + "; " + kind.remedy;
  }
  if (head.size() >= 12 && head.starts_with("RIFF") && head.substr(8, 4) == "WEBP")
    return std::string("is a WebP image, of 8 bits at most; ") + kConvert;
  return "";
}

bool is_text(std::string_view head) {
  return std::all_of(head.begin(), head.end(),
                     [](unsigned char c) { return c >= 32 || (c >= 9 && c <= 13); });
}

}  // namespace

const char* to_string(FileFormat format) {
  switch (format) {
    case FileFormat::png:
      return "png";
    case FileFormat::openexr:
      return "openexr";
    case FileFormat::tiff:
      return "tiff";
    case FileFormat::jpeg:
      return "jpeg";
    case FileFormat::hdr:
      return "hdr";
    case FileFormat::targa:
      return "targa";
    case FileFormat::esri_grid:
      return "esri ascii grid";
    case FileFormat::numpy:
      return "numpy array";
    case FileFormat::srtm:
      return "srtm tile";
    case FileFormat::raw:
      return "raw samples";
  }
  return "";
}

bool is_picture(FileFormat format) {
  switch (format) {
    case FileFormat::esri_grid:
    case FileFormat::numpy:
    case FileFormat::srtm:
    case FileFormat::raw:
      return false;
    default:
      return true;
  }
}

FileFormat recognise_format(const InputFile& file) {
  std::array<char, 64> buffer{};
  std::string_view head(buffer.data(), std::fread(buffer.data(), 1, buffer.size(), file.rewound()));
  for (const Magic& magic : kMagics) {
    if (head.starts_with(magic.bytes)) return magic.format;
  }
  refuse_utf16(file.path(), head);
  if (head.starts_with(kByteOrderMark)) head.remove_prefix(kByteOrderMark.size());
  const std::string unread = explain_unread(head);
  if (!unread.empty()) throw file.error(unread);
  if (is_srtm(file)) return FileFormat::srtm;
  if (is_named_raw(file.path())) return FileFormat::raw;
  if (looks_like_esri_grid(file.path(), head)) return FileFormat::esri_grid;
  if (looks_like_targa(head)) return FileFormat::targa;
  throw file.error(
      std::string(is_text(head) ? "holds text, not an image" : "is no image") +
      " (known: PNG, EXR, TIFF, JPEG, TGA, HDR, Esri ASCII grid, NumPy array, SRTM tile, raw samples)");
}

}  // namespace heightlight
