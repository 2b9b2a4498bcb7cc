#include "windows/window_files.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "files/input_file.h"
#include "files/output_file.h"
#include "windows/whole_file.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

class Descriptor {
 public:
  Descriptor(const fs::path& file, int flags) : number_(open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  explicit operator bool() const { return number_ >= 0; }
  int number() const { return number_; }

 private:
  int number_;
};

/// Samples from or to a place in a file, by pread or pwrite. False at the file's end, or where it fails.
template <class Transfer, class Bytes>
bool transfer_all(Transfer&& transfer, int descriptor, Bytes* bytes, std::size_t left, std::uint64_t offset) {
  while (left > 0) {
    const ssize_t done = transfer(descriptor, bytes, left, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes += done;
    offset += static_cast<std::uint64_t>(done);
    left -= static_cast<std::size_t>(done);
  }
  return true;
}

bool read_all(int descriptor, float* samples, std::size_t count, std::uint64_t offset) {
  return transfer_all(pread, descriptor, reinterpret_cast<char*>(samples), count * sizeof(float), offset);
}

bool write_all(int descriptor, const float* samples, std::size_t count, std::uint64_t offset) {
  return transfer_all(pwrite, descriptor, reinterpret_cast<const char*>(samples), count * sizeof(float),
                      offset);
}

/// What two rectangles have in common.
MapRect common(const MapRect& a, const MapRect& b) {
  MapRect both{std::max(a.first_row, b.first_row), std::max(a.first_column, b.first_column), 0, 0};
  both.rows = std::min(a.first_row + a.rows, b.first_row + b.rows) - both.first_row;
  both.columns = std::min(a.first_column + a.columns, b.first_column + b.columns) - both.first_column;
  return both;
}

/// Of a sample in the k-th map of a window's file.
std::uint64_t offset_of(const MapRect& window, int k, int row, int column) {
  const std::int64_t at = k * window.count() + std::int64_t{row - window.first_row} * window.columns +
                          (column - window.first_column);
  return static_cast<std::uint64_t>(at) * sizeof(float);
}

Error lost(const fs::path& file) {
  return file_error(file, "is missing or cut short; begin anew without its folder");
}

}  // namespace

fs::path WindowFolder::file(int window) const { return path / fmt::format("{:04}.raw", window); }

MapRect WindowFolder::rect(int window) const {
  const WindowBlocks blocks = window_blocks(grid.place(window), level, 0);
  return {blocks.first_row, blocks.first_column, blocks.height, blocks.width};
}

int WindowFolder::width() const { return ((grid.map_width - 1) >> level) + 1; }
int WindowFolder::height() const { return ((grid.map_height - 1) >> level) + 1; }

void write_window(const WindowFolder& folder, int window, const std::vector<const Map*>& maps) {
  const fs::path file = folder.file(window);
  write_file(unfinished(file), [&](std::FILE* stream) {
    for (const Map* map : maps) std::fwrite(map->values.data(), sizeof(float), map->size(), stream);
  });
  appear(file);
}

Map read_window(const WindowFolder& folder, int window, int k) {
  const MapRect rect = folder.rect(window);
  Map map(rect.columns, rect.rows);
  const Descriptor file(folder.file(window), O_RDONLY);
  if (!file || !read_all(file.number(), map.values.data(), map.size(),
                         offset_of(rect, k, rect.first_row, rect.first_column)))
    throw lost(folder.file(window));
  return map;
}

Map read_whole(const WindowFolder& folder, int k) {
  Map whole(folder.width(), folder.height());
  for (int window = 0; window < folder.grid.count(); ++window) {
    const MapRect rect = folder.rect(window);
    const Map part = read_window(folder, window, k);
    for (int i = 0; i < rect.rows; ++i)
      std::copy_n(&part(i, 0), rect.columns, &whole(rect.first_row + i, rect.first_column));
  }
  return whole;
}

void WindowFiles::read(const MapRect& rect, float* samples) const {
  const WindowGrid& grid = folder_.grid;
  const int side = grid.side >> folder_.level;
  for (int i = rect.first_row / side; i * side < rect.first_row + rect.rows; ++i) {
    for (int j = rect.first_column / side; j * side < rect.first_column + rect.columns; ++j) {
      const int window = i * grid.across() + j;
      const MapRect held = folder_.rect(window);
      const MapRect part = common(rect, held);
      const Descriptor file(folder_.file(window), O_RDONLY);
      bool is_read = static_cast<bool>(file);
      for (int row = part.first_row; is_read && row < part.first_row + part.rows; ++row) {
        float* out = samples + std::ptrdiff_t{row - rect.first_row} * rect.columns +
                     (part.first_column - rect.first_column);
        is_read = read_all(file.number(), out, static_cast<std::size_t>(part.columns),
                           offset_of(held, k_, row, part.first_column));
      }
      if (!is_read) throw lost(folder_.file(window));
    }
  }
}

WindowRows::WindowRows(WindowFolder folder) : folder_(std::move(folder)) {}

void WindowRows::take(int first, const Map& rows) {
  const WindowGrid& grid = folder_.grid;
  for (int i = first / grid.side; i * grid.side < first + rows.height; ++i) {
    for (int j = 0; j < grid.across(); ++j) {
      const int window = i * grid.across() + j;
      const MapRect held = folder_.rect(window);
      const MapRect part = common({first, 0, rows.height, rows.width}, held);
      const fs::path path = unfinished(folder_.file(window));
      const Descriptor file(path, O_WRONLY | O_CREAT);
      bool is_written = static_cast<bool>(file);
      for (int row = part.first_row; is_written && row < part.first_row + part.rows; ++row) {
        is_written =
            write_all(file.number(), &rows(row - first, part.first_column),
                      static_cast<std::size_t>(part.columns), offset_of(held, 0, row, part.first_column));
      }
      if (!is_written) throw output_error(path, errno);
    }
  }
}

void WindowRows::finish() {
  for (int window = 0; window < folder_.grid.count(); ++window) appear(folder_.file(window));
}

}  // namespace heightlight
