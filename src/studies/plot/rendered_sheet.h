#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "comparison/rendered_forms.h"

namespace heightlight {

/// What a sheet of renderings says of itself.
struct RenderedSheet {
  std::string title;
  std::string quantity = "E/π";  ///< that RMSEs are of
  std::size_t columns = 1;
};

/// The notes' "Showtime" (Patapom): renderings side by side, with their errors, as PNG (sRGB). Throws Error
/// naming gnuplot or the file.
void plot_rendered(const std::filesystem::path& png, const std::vector<RenderedForm>& rendered,
                   const RenderedSheet& sheet);

}  // namespace heightlight
