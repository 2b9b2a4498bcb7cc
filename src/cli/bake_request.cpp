#include <algorithm>
#include <system_error>

#include "cli/bake_command.h"
#include "cli/request.h"
#include "files/file_record.h"
#include "files/image_file.h"
#include "files/json_file.h"
#include "heightlight/version.h"

namespace heightlight {

std::string request_of(const BakeCommand& command, const BakeInput& input) {
  const BakeOptions& options = command.options;
  std::error_code ignored;
  const bool albedo_file = std::filesystem::is_regular_file(command.albedo, ignored);
  return request_key(
      {{"version", HEIGHTLIGHT_VERSION},
       {"map", sha256_of_file(input.path)},
       {"load", describe_load_options(command.load)},
       {"maps", command.maps},
       {"pack", command.packed},
       {"albedo", albedo_file ? sha256_of_file(std::filesystem::path(command.albedo)) : command.albedo},
       {"max_distance", command.max_distance},
       {"falloff", command.falloff},
       {"uniform_ao", options.uniform_ao},
       {"depth", static_cast<int>(options.depth)},
       {"format", static_cast<int>(options.format)},
       {"y_down", options.y_down},
       {"bent_length", options.bent_length},
       {"dither", options.dither},
       {"horizon_azimuths", options.horizon_azimuths},
       {"error", options.error},
       {"azimuths", options.azimuths},
       {"seed", options.seed}});
}

bool is_baked(const BakeCommand& command, const BakeInput& input) {
  const std::filesystem::path sidecar = command.folder / baked_files(input.name, command.options).back();
  const auto files = read_file_records(sidecar);
  if (!files || read_json(sidecar).value("request", "") != request_of(command, input)) return false;
  return std::all_of(files->begin(), files->end(),
                     [&](const FileRecord& file) { return is_as_recorded(command.folder, file); });
}

}  // namespace heightlight
