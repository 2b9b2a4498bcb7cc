#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace heightlight {

/// What the sidecar of an earlier bake tells that holds for the next one, too: entries of its `files` that
/// are still there as they were recorded, of the same heights read in the same way (`surface`), and not among
/// the `files` that are made anew. Each says that it is `earlier`: the sidecar's options and errors are not
/// its own. Empty where the heights are others, or `surface` is empty.
nlohmann::ordered_json find_former_maps(const std::filesystem::path& sidecar, const std::string& surface,
                                        const std::vector<std::string>& files);

}  // namespace heightlight
