#include "files/terrain_file.h"

#include "files/file_format.h"
#include "files/input_file.h"
#include "files/sample_grid.h"
#include "files/tiff_facts.h"
#include "heightlight/error.h"

namespace heightlight {

bool is_terrain_file(const std::filesystem::path& path) {
  try {
    const InputFile file(path);
    switch (recognise_format(file)) {
      case FileFormat::esri_grid:
        return true;
      case FileFormat::srtm:
        return srtm_place(file).has_value();
      case FileFormat::tiff:
        return read_tiff_facts(file).place.place.has_value();
      default:
        return false;
    }
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    return false;
  }
}

bool is_loaded_as_terrain(const LoadOptions& load, const std::filesystem::path& path) {
  if (load.texel && load.boundary == Boundary::open) return true;
  return load.boundary != Boundary::tile && is_terrain_file(path);
}

}  // namespace heightlight
