#include "bake/former_bake.h"

#include <algorithm>
#include <system_error>

#include "files/file_record.h"
#include "files/json_file.h"
#include "heightlight/error.h"

namespace heightlight {

nlohmann::ordered_json find_former_maps(const std::filesystem::path& sidecar, const std::string& surface,
                                        const std::vector<std::string>& files) {
  nlohmann::ordered_json kept = nlohmann::ordered_json::array();
  std::error_code ignored;
  if (surface.empty() || !std::filesystem::is_regular_file(sidecar, ignored)) return kept;
  try {
    const nlohmann::json json = read_json(sidecar);
    const auto records = parse_file_records(json);
    if (!records || records->size() != json["files"].size() || json.value("surface", "") != surface)
      return kept;
    for (std::size_t i = 0; i < records->size(); ++i) {
      const FileRecord& record = (*records)[i];
      if (std::find(files.begin(), files.end(), record.name) != files.end()) continue;
      if (!is_as_recorded(sidecar.parent_path(), record)) continue;
      kept.push_back(nlohmann::ordered_json(json["files"][i]));
      kept.back()["earlier"] = true;
    }
  } catch (const Cancelled&) {
    throw;
  } catch (const std::exception&) {
    kept.clear();  // damaged from outside: nothing is known
  }
  return kept;
}

}  // namespace heightlight
