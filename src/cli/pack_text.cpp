#include "cli/pack_text.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "bake/file_name.h"
#include "cli/map_list.h"
#include "heightlight/error.h"

namespace heightlight {
namespace {

const std::string kLetters = "RGBA";

bool take_end(std::string& text, const std::string& end) {
  if (!text.ends_with(end)) return false;
  text.resize(text.size() - end.size());
  return true;
}

/// "normal.z", "sh.8" as a map and a component; nothing where the text is none.
std::optional<PackedChannel> parse_map_component(const std::string& text) {
  const std::size_t point = text.find('.');
  const std::optional<MaterialMap> map = find_material_map(text.substr(0, point));
  if (!map || point == std::string::npos)
    return map ? std::optional(PackedChannel{.map = map}) : std::nullopt;
  const std::string component = text.substr(point + 1);
  const std::size_t letter = std::string("xyzwrgba").find(component);
  if (component.size() == 1 && letter != std::string::npos)
    return PackedChannel{.map = map, .component = static_cast<int>(letter % 4)};
  const bool is_number = !component.empty() && component.size() <= 3 &&
                         component.find_first_not_of("0123456789") == std::string::npos;
  if (is_number) return PackedChannel{.map = map, .component = std::stoi(component)};
  return std::nullopt;
}

std::optional<double> parse_constant(const std::string& text) {
  char* end = nullptr;
  const double constant = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') return std::nullopt;
  if (!(constant >= 0 && constant <= 1)) throw UsageError("pack", "", text + " is not in [0, 1]");
  return constant;
}

std::size_t index_of(const FileText& file, const std::string& channel, std::vector<OwnChannel>& own) {
  const auto found = std::find_if(own.begin(), own.end(), [&](const OwnChannel& known) {
    return known.path == file.path && known.channel == channel && known.is_srgb == file.is_srgb;
  });
  if (found != own.end()) return static_cast<std::size_t>(found - own.begin());
  own.push_back({.path = file.path, .channel = channel, .is_srgb = file.is_srgb});
  return own.size() - 1;
}

/// So many channels of a file: the one chosen, the only one or grey, or the first of them.
std::vector<PackedChannel> channels_of(const FileText& file, std::size_t count,
                                       std::vector<OwnChannel>& own) {
  if (count > 1 && !file.channel.empty())
    throw UsageError("pack", "",
                     file.path + ":" + file.channel + " is one channel and can only go to one letter");
  std::vector<PackedChannel> channels;
  for (std::size_t i = 0; i < count; ++i)
    channels.push_back({.own = index_of(file, count > 1 ? std::to_string(i) : file.channel, own)});
  return channels;
}

std::vector<PackedChannel> parse_source(const std::string& text, std::size_t count, PackSources& sources) {
  if (const auto constant = parse_constant(text))
    return std::vector<PackedChannel>(count, {.constant = *constant});
  for (PackInput& input : sources.inputs) {
    if (input.name != text) continue;
    input.is_taken = true;
    if (input.file) return channels_of(*input.file, count, sources.own);
    return std::vector<PackedChannel>(count, {.constant = input.stand_in});
  }
  if (const auto first = parse_map_component(text)) {
    std::vector<PackedChannel> channels(count, *first);
    for (std::size_t i = 0; i < count; ++i) channels[i].component += static_cast<int>(i);
    return channels;
  }
  if (text.find_first_of("./") == std::string::npos)
    throw UsageError("pack", "",
                     "'" + text + "' is not a map, a file or an input (maps: " + known_material_maps() + ")");
  return channels_of(parse_file_text("pack", text), count, sources.own);
}

/// "NAME:" before the first channel, taken off the text.
std::string take_name(std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos || colon > text.find('=')) return "packed";
  std::string name = text.substr(0, colon);
  if (name.empty() || name.find('/') != std::string::npos)
    throw UsageError("pack", text, "the name before the colon must not be empty nor contain /");
  text.erase(0, colon + 1);
  return name;
}

}  // namespace

FileText parse_file_text(const std::string& quantity, const std::string& text) {
  FileText file{.path = text};
  file.is_srgb = take_end(file.path, ":srgb");
  if (!file.is_srgb) take_end(file.path, ":linear");
  const std::size_t colon = file.path.rfind(':');
  const std::size_t folder = file.path.rfind('/');  // whose name may have colons
  if (colon != std::string::npos && (folder == std::string::npos || folder < colon)) {
    file.channel = file.path.substr(colon + 1);
    file.path.resize(colon);
    if (file.channel.empty()) throw UsageError(quantity, text, "names no channel after the colon");
  }
  if (file.path.empty()) throw UsageError(quantity, text, "names no file");
  fill_placeholders(quantity, file.path, {{"stem", ""}, {"material", ""}, {"folder", ""}});
  return file;
}

std::filesystem::path path_for_map(const std::string& path, const std::filesystem::path& map) {
  const std::string stem = map.stem().string();
  const std::string folder = map.has_parent_path() ? map.parent_path().string() : ".";
  return fill_placeholders("pack", path,
                           {{"stem", stem}, {"material", material_name(stem)}, {"folder", folder}});
}

PackedTexture parse_pack(const std::string& text, PackSources& sources) {
  std::string rest = text;
  PackedTexture pack{.name = take_name(rest), .channels = {}};
  std::array<std::optional<PackedChannel>, 4> given;
  std::size_t count = 0;
  for (const std::string& part : split_at_commas(rest)) {
    const std::string letters = part.substr(0, part.find('='));
    std::string source = part.substr(std::min(letters.size() + 1, part.size()));
    const bool inverted = source.starts_with("1-");
    if (inverted) source.erase(0, 2);
    if (letters.empty() || letters.find_first_not_of(kLetters) != std::string::npos || source.empty())
      throw UsageError("pack", text,
                       "must be like R=ao,G=rough.png,B=normal.z, with each of R, G, B, A at most once");
    const std::vector<PackedChannel> channels = parse_source(source, letters.size(), sources);
    for (std::size_t i = 0; i < letters.size(); ++i) {
      const std::size_t at = kLetters.find(letters[i]);
      if (given[at])
        throw UsageError("pack", text,
                         "must be like R=ao,G=rough.png,B=normal.z, with each of R, G, B, A at most once");
      given[at] = channels[i];
      given[at]->is_inverted = inverted;
      count = std::max(count, at + 1);
    }
  }
  if (count == 2) count = 3;  // image viewers know no two channels
  for (std::size_t i = 0; i < count; ++i) pack.channels.push_back(given[i].value_or(PackedChannel{}));
  return pack;
}

}  // namespace heightlight
