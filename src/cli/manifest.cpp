#include "cli/manifest.h"

#include <algorithm>
#include <set>

#include "base/digits.h"
#include "cli/json_place.h"
#include "heightlight/synth.h"

namespace heightlight {
namespace {

constexpr std::size_t kMostRuns = 1'000'000;

/// Names become parts of the names of folders, and cells of tables.
void check_name(const JsonPlace& place, const std::string& name) {
  constexpr std::size_t kLongestName = 100;
  const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return c >= 32 && c != 127 && c != '/' && c != '"' && c != ',' && c != '\\';
  });
  if (name.size() > kLongestName || !plain || name.front() == '.') {
    throw place.error("\"" + name.substr(0, kLongestName) +
                      "\" cannot name a folder: give a \"name\" of at most 100 bytes, without / \\ , or \"");
  }
}

std::filesystem::path beside_manifest(const std::filesystem::path& manifest, const std::string& file) {
  // "./0.5" is a file, "0.5" would be an albedo.
  const auto folder = manifest.has_parent_path() ? manifest.parent_path() : std::filesystem::path(".");
  return folder / file;
}

Boundary read_boundary(const JsonPlace& place) {
  const std::string text = place.text();
  if (text == "tile") return Boundary::tile;
  if (text == "open") return Boundary::open;
  throw place.error("\"" + text + "\" is not a boundary; use \"tile\" or \"open\"");
}

Spacing read_spacing(const JsonPlace& place) {
  if (!place.is_list()) return {place.positive_number(), place.positive_number()};
  const std::vector<JsonPlace> both = place.items();
  if (both.size() != 2) throw place.error("must be one spacing, or two: [x, y]");
  return {both[0].positive_number(), both[1].positive_number()};
}

void read_shape(const JsonPlace& place, const JsonPlace& shape, ManifestMap& map) {
  map.source = shape.text();
  const std::vector<SynthShape>& shapes = synth_shapes();
  const auto found = std::find_if(shapes.begin(), shapes.end(),
                                  [&](const SynthShape& known) { return known.name == map.source; });
  if (found == shapes.end()) throw shape.error("there is no shape \"" + map.source + "\"");
  map.load.boundary = found->tiles ? Boundary::tile : Boundary::open;
  if (const auto size = place.find("size")) map.size = static_cast<int>(size->integer(1, 32768));
  if (const auto seed = place.find("seed"))
    map.seed = static_cast<std::uint64_t>(seed->integer(0, INT64_MAX));
  map.name = map.source + "_" + std::to_string(map.size) + "_" + std::to_string(map.seed);
}

void read_file(const std::filesystem::path& manifest, const JsonPlace& place, const JsonPlace& file,
               ManifestMap& map) {
  map.source = file.text();
  map.file = beside_manifest(manifest, map.source);
  map.name = map.file.stem().string();
  if (map.name.empty()) throw file.error("is not the name of a file");
  LoadOptions& load = map.load;
  if (const auto texel = place.find("texel")) load.texel = read_spacing(*texel);
  if (const auto scale = place.find("scale")) load.scale = scale->positive_number();
  if (const auto offset = place.find("offset")) load.offset = offset->number();
  if (const auto value = place.find("no_data")) load.no_data = value->number();
  if (const auto part = place.find("part")) load.part = part->text();
  if (const auto channel = place.find("channel")) load.channel = channel->text();
  if (const auto shrink = place.find("shrink")) load.shrink = static_cast<int>(shrink->integer(1, 32768));
  if (const auto invert = place.find("invert")) load.invert = invert->flag();
}

ManifestMap read_map(const std::filesystem::path& manifest, const JsonPlace& place) {
  place.check_keys({"file", "name", "relief", "width", "texel", "boundary", "no_data", "part", "channel",
                    "scale", "offset", "shrink", "invert", "shape", "size", "seed"});
  const auto file = place.find("file");
  const auto shape = place.find("shape");
  if (file.has_value() == shape.has_value()) throw place.error("must have either a \"file\" or a \"shape\"");
  ManifestMap map;
  if (shape) {
    place.check_keys({"shape", "size", "seed", "name", "relief", "width", "boundary"});
    read_shape(place, *shape, map);
  } else {
    place.check_keys({"file", "name", "relief", "width", "texel", "boundary", "no_data", "part", "channel",
                      "scale", "offset", "shrink", "invert"});
    read_file(manifest, place, *file, map);
  }
  LoadOptions& load = map.load;
  if (const auto relief = place.find("relief")) load.relief = relief->positive_number();
  if (const auto width = place.find("width")) load.width = width->positive_number();
  if (load.width && load.texel) throw place.error("\"width\" and \"texel\" both give the spacing");
  if (const auto boundary = place.find("boundary")) load.boundary = read_boundary(*boundary);
  try {
    check_load_options(load);
  } catch (const UsageError& error) {
    throw place.error(error.what());
  }
  // The heights of a shape run from 0 to 1; like an image's, they are stretched to a tenth of the width.
  if (shape && !load.relief) load.relief_share = 0.1;
  if (const auto name = place.find("name")) map.name = name->text();
  check_name(place, map.name);
  return map;
}

void read_albedo_option(const std::filesystem::path& manifest, const JsonPlace& place,
                        ManifestOptions& options) {
  if (place.is_text()) {
    options.albedo_file = place.text();
    options.simulate.albedo = beside_manifest(manifest, options.albedo_file).string();
    return;
  }
  std::vector<JsonPlace> channels{place};
  if (place.is_list()) channels = place.items();
  if (channels.size() != 1 && channels.size() != 3)
    throw place.error("must be one number, three numbers, or the name of a file");
  options.simulate.albedo.clear();
  for (const JsonPlace& channel : channels) {
    const double value = channel.number();
    if (!(value >= 0 && value <= 1)) throw channel.error("must be from 0 to 1");
    options.simulate.albedo += (options.simulate.albedo.empty() ? "" : ",") + in_digits(value);
  }
}

ManifestOptions read_options(const std::filesystem::path& manifest, const JsonPlace& place) {
  place.check_keys({"name", "visibility", "error", "azimuths", "rays", "bounces", "bins", "albedo",
                    "save_bounces", "seed"});
  constexpr std::int64_t kMost = 1'000'000;  // the ranges proper are checked below
  ManifestOptions options;
  SimulateOptions& simulate = options.simulate;
  VisibilityOptions& visibility = simulate.visibility;
  if (const auto name = place.find("name")) check_name(*name, options.name = name->text());
  if (const auto method = place.find("visibility")) {
    visibility.method = method->text();
    if (visibility.method != "horizon" && visibility.method != "rays")
      throw method->error("must be \"horizon\" or \"rays\"");
  }
  if (const auto error = place.find("error")) visibility.error = error->number();
  if (const auto azimuths = place.find("azimuths"))
    visibility.azimuths = static_cast<int>(azimuths->integer(2, kMost));
  if (const auto rays = place.find("rays")) visibility.rays = static_cast<int>(rays->integer(1, kMost));
  if (const auto bounces = place.find("bounces"))
    simulate.bounces = static_cast<int>(bounces->integer(1, kMost));
  if (const auto bins = place.find("bins")) simulate.bins = static_cast<int>(bins->integer(1, kMost));
  if (const auto albedo = place.find("albedo")) read_albedo_option(manifest, *albedo, options);
  if (const auto save = place.find("save_bounces")) simulate.save_bounces = save->flag();
  if (const auto seed = place.find("seed"))
    simulate.run.seed = static_cast<std::uint64_t>(seed->integer(0, INT64_MAX));
  try {
    check_simulate_options(simulate);
  } catch (const UsageError& error) {
    throw place.error(error.what());
  }
  return options;
}

/// Nothing may stand twice: it would be simulated twice, under one name.
template <class T>
void check_once(const JsonPlace& place, std::set<T>& seen, const T& value, const std::string& text) {
  if (!seen.insert(value).second) throw place.error(text + " is given twice");
}

void read_maps(const JsonPlace& place, Manifest& manifest) {
  std::set<std::string> names;
  for (const JsonPlace& item : place.items()) {
    manifest.maps.push_back(read_map(manifest.path, item));
    const std::string& name = manifest.maps.back().name;
    check_once(item, names, name, "the name \"" + name + "\"");
  }
}

void read_relief_shares(const JsonPlace& place, Manifest& manifest) {
  std::set<std::optional<double>> seen;
  for (const JsonPlace& item : place.items()) {
    std::optional<double> share;
    if (!item.is_text()) {
      share = item.positive_number();
      if (*share < 1e-12 || *share > 1e12) throw item.error("must be from 1e-12 to 1e12");
    } else if (item.text() != "own") {
      throw item.error("must be a positive number, or \"own\"");
    }
    check_once(item, seen, share, share ? in_digits(*share) : "\"own\"");
    manifest.relief_shares.push_back(share);
  }
}

void read_boundaries(const JsonPlace& place, Manifest& manifest) {
  std::set<std::optional<Boundary>> seen;
  for (const JsonPlace& item : place.items()) {
    std::optional<Boundary> boundary;
    if (item.text() != "own") boundary = read_boundary(item);
    check_once(item, seen, boundary, "\"" + item.text() + "\"");
    manifest.boundaries.push_back(boundary);
  }
}

void read_option_sets(const JsonPlace& place, Manifest& manifest) {
  const std::vector<JsonPlace> items = place.items();
  std::set<std::string> names;
  for (const JsonPlace& item : items) {
    manifest.options.push_back(read_options(manifest.path, item));
    const std::string& name = manifest.options.back().name;
    if (name.empty() && items.size() > 1)
      throw item.error("needs a \"name\", since there are several sets of options");
    check_once(item, names, name, "the name \"" + name + "\"");
  }
}

}  // namespace

Manifest read_manifest(const std::filesystem::path& path) {
  const nlohmann::json json = read_json(path);
  const JsonPlace place(json, path);
  place.check_keys({"maps", "relief_shares", "boundaries", "options"});
  const auto maps = place.find("maps");
  if (!maps) throw place.error("needs \"maps\", a list of heightmaps");
  Manifest manifest{path, {}, {}, {}, {}};
  read_maps(*maps, manifest);
  if (const auto shares = place.find("relief_shares")) read_relief_shares(*shares, manifest);
  if (const auto boundaries = place.find("boundaries")) read_boundaries(*boundaries, manifest);
  if (const auto options = place.find("options")) read_option_sets(*options, manifest);
  if (manifest.relief_shares.empty()) manifest.relief_shares.emplace_back();
  if (manifest.boundaries.empty()) manifest.boundaries.emplace_back();
  if (manifest.options.empty()) manifest.options.emplace_back();
  std::size_t runs = 1;
  for (const std::size_t count : {manifest.maps.size(), manifest.relief_shares.size(),
                                  manifest.boundaries.size(), manifest.options.size()}) {
    runs = count > kMostRuns / runs ? kMostRuns + 1 : runs * count;
  }
  if (runs > kMostRuns) throw place.error("asks for more than " + std::to_string(kMostRuns) + " runs");
  return manifest;
}

std::string describe_manifest() {
  return R"(A manifest is JSON. Every map is simulated with every relief, boundary and set of options:
  {
    "maps": [                            heightmaps: shapes, or files with paths relative to the manifest
      {"file": "bricks.png"},
      {"file": "dem.tif", "name": "sierra", "texel": [50, 50], "boundary": "open", "no_data": -9999},
      {"shape": "cobbles", "size": 512, "seed": 7}
    ],
    "relief_shares": [0.03, 0.1, "own"], reliefs as fractions of the width; "own" (default): that of the map
    "boundaries": ["tile", "open"],      boundaries; "own" (default): that of the map
    "options": [                         options of simulate, with _ for -; several sets need names
      {"name": "walked", "error": 0.001, "bounces": 20, "bins": 100, "albedo": [0.6, 0.4, 0.3]},
      {"name": "cast", "visibility": "rays", "rays": 1000, "seed": 3, "save_bounces": true}
    ]
  }
Only "maps" is required. Maps also take "relief", "width", "part", "channel", "scale", "offset", "shrink" and
"invert", as simulate does.
)";
}

}  // namespace heightlight
