#include "cli/map_list.h"

#include <sstream>

namespace heightlight {

std::vector<std::string> split_at_commas(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  if (text.ends_with(',')) parts.emplace_back();
  return parts;
}

std::optional<MaterialMap> find_material_map(const std::string& name) {
  for (const MaterialMapName& entry : material_maps()) {
    if (name == entry.name) return entry.map;
  }
  return std::nullopt;
}

std::string known_material_maps() {
  std::string known;
  for (const MaterialMapName& entry : material_maps())
    known += std::string(known.empty() ? "" : ", ") + entry.name;
  return known;
}

}  // namespace heightlight
