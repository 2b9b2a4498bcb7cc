#pragma once

#include <filesystem>
#include <vector>

#include "window/stored_map.h"
#include "windows/window_grid.h"

// Maps in a folder, a file per window: 0000.raw, 0001.raw … Each holds one or several maps of the window one
// after the other, floats in the machine's order, row by row. A file that is there is whole.

namespace heightlight {

struct WindowFolder {
  std::filesystem::path path;
  WindowGrid grid;
  int level = 0;  ///< a block of 2^level × 2^level texels is one float

  std::filesystem::path file(int window) const;
  /// Floats of a window along an axis, as MapRect in the map's blocks.
  MapRect rect(int window) const;
  int width() const;
  int height() const;
};

/// Writes the maps of a window, so that its file appears whole. Throws OutputError.
void write_window(const WindowFolder& folder, int window, const std::vector<const Map*>& maps);

/// The k-th map of a window. Throws Error naming the file.
Map read_window(const WindowFolder& folder, int window, int k);

/// The k-th map of all windows together. Throws Error likewise.
Map read_whole(const WindowFolder& folder, int k);

/// The same where memory does not hold it.
class WindowFiles : public StoredMap {
 public:
  WindowFiles(WindowFolder folder, int k) : folder_(std::move(folder)), k_(k) {}
  int width() const override { return folder_.width(); }
  int height() const override { return folder_.height(); }
  /// Throws Error naming the file.
  void read(const MapRect& rect, float* samples) const override;

 private:
  WindowFolder folder_;
  int k_;
};

/// Rows of a map that come from the top, on their way into the files of its windows.
class WindowRows {
 public:
  explicit WindowRows(WindowFolder folder);
  /// Throws OutputError.
  void take(int first, const Map& rows);
  /// All files appear.
  void finish();

 private:
  WindowFolder folder_;
};

}  // namespace heightlight
