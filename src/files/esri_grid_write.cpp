#include "files/esri_grid_write.h"

#include <fmt/core.h>

#include <cassert>
#include <cmath>

#include "files/interrupt.h"
#include "files/missing_mark.h"
#include "files/output_file.h"

namespace heightlight {
namespace {

void write_header(std::FILE* stream, const TextureLayout& layout, const Spacing& cell,
                  const std::string& no_data) {
  std::array<double, 2> corner{0, cell.y * layout.height};
  if (layout.place && layout.place->corner) corner = *layout.place->corner;
  fmt::print(stream, "ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\n", layout.width, layout.height,
             corner[0], corner[1] - cell.y * layout.height);
  if (cell.x == cell.y) {
    fmt::print(stream, "cellsize {}\n", cell.x);
  } else {
    fmt::print(stream, "dx {}\ndy {}\n", cell.x, cell.y);
  }
  fmt::print(stream, "NODATA_value {}\n", no_data);
}

}  // namespace

void write_esri_grid(const std::filesystem::path& path, const TextureLayout& layout, const Spacing& spacing,
                     const FillRows& fill) {
  assert(layout.channels.size() == 1);
  const MissingMark mark = missing_mark_of(layout).value_or(MissingMark{-9999, "-9999"});
  write_file(path, [&](std::FILE* stream) {
    write_header(stream, layout, layout.place ? layout.place->cell : spacing, mark.text);
    std::vector<float> row(static_cast<std::size_t>(layout.width));
    for (int i = 0; i < layout.height; ++i) {
      throw_if_interrupted();
      fill(i, 1, row.data());
      std::string line;
      for (const float value : row) {
        line += std::isnan(value) ? mark.text : fmt::format("{}", mark_missing(mark, value));
        line += ' ';
      }
      line.back() = '\n';
      fmt::print(stream, "{}", line);
    }
  });
}

}  // namespace heightlight
