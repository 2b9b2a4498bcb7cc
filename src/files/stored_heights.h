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

/// A file's samples on their way to heights.
struct StoredHeights {
  Image<double> values;  ///< NaN where missing
  SourceFacts facts;
  double scale = 1;                   ///< height per stored value, as the file says it
  double offset = 0;                  ///< height of a stored 0
  std::optional<Georeference> place;  ///< where it lies on earth, as far as the file says it
  std::string place_fault;            ///< why what it says of that cannot be used; empty: it can
  std::optional<TiffFacts> tiff;      ///< of a TIFF
  std::vector<Warning> warnings = {};
};

/// Reads them, and makes NaN of what is missing: what `options.no_data` or the file names, as the stored type
/// sees it, transparent and infinite samples. Throws Error as load_heightmap does, UsageError for a part or
/// channel that the file does not have.
StoredHeights read_stored_heights(const InputFile& file, const LoadOptions& options, const ReadLimit& limit);

/// The same of a TIFF, some rows at a time: what memory need not hold as a whole.
class StoredHeightRows {
 public:
  /// Reads all rows once, for their range. Throws Error likewise, and for an image of several channels where
  /// none is chosen. Both arguments must outlive it.
  StoredHeightRows(const InputFile& file, const LoadOptions& options);

  /// All but the values, which have their size alone, and their levels, which nobody counts.
  const StoredHeights& stored() const { return stored_; }
  StoredHeights& stored() { return stored_; }

  /// Calls visit(first row, rows), one part after the other, from the top.
  void for_rows(const std::function<void(int, Image<double>&)>& visit);

 private:
  const InputFile& file_;
  const LoadOptions& options_;
  TiffRows rows_;
  StoredHeights stored_;
};

}  // namespace heightlight
