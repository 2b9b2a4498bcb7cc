#include "files/file_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>

#include "files/input_file.h"

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
    Magic{"#?R"sv, FileFormat::hdr},  // #?RADIANCE or #?RGBE
};

int byte_at(std::string_view head, std::size_t place) { return static_cast<unsigned char>(head[place]); }

/// Targa has no magic: its 18-byte header counts as one when every field holds one of its few legal values.
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
  }
  return "";
}

FileFormat recognise_format(const std::filesystem::path& path) {
  const File file = open_input(path);
  std::array<char, 64> buffer{};
  const std::string_view head(buffer.data(), std::fread(buffer.data(), 1, buffer.size(), file.get()));
  for (const Magic& magic : kMagics) {
    if (head.starts_with(magic.bytes)) return magic.format;
  }
  if (looks_like_esri_grid(path, head)) return FileFormat::esri_grid;
  if (looks_like_targa(head)) return FileFormat::targa;
  throw file_error(path, std::string(is_text(head) ? "holds text, not an image" : "is no image") +
                             " (known: PNG, EXR, TIFF, JPEG, TGA, HDR, Esri ASCII grid)");
}

}  // namespace heightlight
