#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "files/image_read.h"
#include "files/input_file.h"
#include "files/map_size.h"
#include "files/tiff_facts.h"
#include "heightlight/files.h"

namespace heightlight {

/// A file's samples before they are converted to heights.
struct StoredHeights {
  Image<double> values;  ///< NaN where missing
  SourceFacts facts;
  double scale = 1;                   ///< height per stored value, as the file states it
  double offset = 0;                  ///< height of a stored 0
  std::optional<Georeference> place;  ///< where it lies on earth, as far as the file says it
  std::string place_fault;            ///< why the georeference cannot be used; empty if it can
  std::optional<TiffFacts> tiff;      ///< of a TIFF only
  std::vector<Warning> warnings = {};
};

/// Reads the samples and makes NaN of missing ones: those equal to the no-data value of `options.no_data` or
/// of the file, as the sample type stores it, and transparent and infinite samples. Throws Error as
/// load_heightmap does, and UsageError for a part or channel that the file does not have.
StoredHeights read_stored_heights(const InputFile& file, const LoadOptions& options, const ReadLimit& limit);

/// As read_stored_heights, for a TIFF that need not be in memory as a whole: reads a few rows at a time.
class StoredHeightRows {
 public:
  /// Reads all rows once, to find their range. Throws Error as read_stored_heights does, and for an image of
  /// several channels if none is chosen. Both arguments must outlive this object.
  StoredHeightRows(const InputFile& file, const LoadOptions& options);

  /// Everything but the samples (only their size is set) and the levels, which are not counted.
  const StoredHeights& stored() const { return stored_; }
  StoredHeights& stored() { return stored_; }

  /// Calls visit(first row, rows) for one group of rows after the other, from the top.
  void for_rows(const std::function<void(int, Image<double>&)>& visit);

 private:
  const InputFile& file_;
  const LoadOptions& options_;
  TiffRows rows_;
  StoredHeights stored_;
};

}  // namespace heightlight
