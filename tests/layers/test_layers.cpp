// Includes point downward only: what each layer of src/ may include, and which layer alone may use a library.

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Names = std::set<std::string>;

/// The layers that a layer may include beside itself.
const std::map<std::string, Names> kMayInclude = {
    {"core", {}},
    {"io", {"core"}},
    {"heightmap", {"core", "io"}},
    {"surface", {"core", "heightmap"}},
    {"visibility", {"core", "heightmap", "surface"}},
    {"transport", {"core", "heightmap", "surface", "visibility"}},
    {"curves", {"core", "io", "heightmap", "surface", "visibility", "transport"}},
    {"models", {"core", "heightmap", "surface", "transport", "curves"}},
    {"screenspace", {"core", "heightmap", "surface"}},
    {"comparison",
     {"core", "io", "heightmap", "surface", "visibility", "transport", "curves", "models", "screenspace"}},
    {"bake", {"core", "io", "heightmap", "surface", "visibility", "transport", "models"}},
    {"plot",
     {"core", "io", "heightmap", "surface", "visibility", "transport", "curves", "models", "comparison"}},
    {"cli",
     {"core", "io", "heightmap", "surface", "visibility", "transport", "curves", "models", "screenspace",
      "comparison", "bake", "plot"}},
};

const std::map<std::string, std::string> kLayerOfPublicHeader = {
    {"error.h", "core"},          {"image.h", "core"},
    {"heightmap.h", "heightmap"}, {"synth.h", "heightmap"},
    {"surface.h", "surface"},     {"visibility.h", "visibility"},
    {"transport.h", "transport"}, {"curves.h", "curves"},
    {"models.h", "models"},       {"screenspace.h", "screenspace"},
    {"bake.h", "bake"},
};

/// Libraries, by how their headers' names begin, and the one layer that includes them.
const std::map<std::string, std::string> kOnlyUser = {
    {"OpenImageIO/", "io"}, {"stb/", "io"}, {"gnuplot-iostream", "plot"}, {"CLI/", "cli"}};

constexpr const char* kPublicFolder = "heightlight/";

/// The layer of a header as written after #include, or of a source relative to src/ or include/; empty where
/// it has none.
std::string layer_of(const std::string& name) {
  if (name.starts_with(kPublicFolder)) {
    const auto found = kLayerOfPublicHeader.find(name.substr(std::string(kPublicFolder).size()));
    return found == kLayerOfPublicHeader.end() ? "" : found->second;
  }
  const std::string folder = name.substr(0, name.find('/'));
  return kMayInclude.contains(folder) ? folder : "";
}

/// What a line includes, with its opening quote or angle: `"core/hash.h`, `<vector`; empty where it includes
/// nothing.
std::string included_by(const std::string& line) {
  const auto skip_blanks = [&line](std::size_t at) {
    return std::min(line.find_first_not_of(" \t", at), line.size());
  };
  const std::size_t hash = skip_blanks(0);
  if (hash == line.size() || line[hash] != '#') return "";
  const std::size_t word = skip_blanks(hash + 1);
  const std::string include = "include";
  if (line.compare(word, include.size(), include) != 0) return "";
  const std::size_t open = skip_blanks(word + include.size());
  return line.substr(open, line.find_first_of(">\"", open + 1) - open);
}

/// What is wrong with the includes of one source: `name` relative to src/ or include/, and its text.
std::vector<std::string> find_faults(const std::string& name, const std::string& text) {
  const std::string layer = layer_of(name);
  if (layer.empty()) return {name + " is in no known layer"};
  std::vector<std::string> faults;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string quoted = included_by(line);
    if (quoted.empty()) continue;
    const std::string included = quoted.substr(1);
    for (const auto& [library, user] : kOnlyUser) {
      if (included.starts_with(library) && layer != user) {
        faults.push_back(name + " includes " + included + ", which only " + user + "/ may");
      }
    }
    const std::string lower = layer_of(included);
    if (lower.empty()) {
      if (quoted[0] == '"') faults.push_back(name + " includes " + included + ", which is in no known layer");
    } else if (lower != layer && !kMayInclude.at(layer).contains(lower)) {
      faults.push_back(name + " (" + layer + ") includes " + included + " (" + lower + ")");
    } else if (name.starts_with(kPublicFolder) && !included.starts_with(kPublicFolder)) {
      faults.push_back(name + " is public and includes " + included + ", which is not");
    }
  }
  return faults;
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("layers") {
  const std::filesystem::path root(HEIGHTLIGHT_SOURCE_DIR);
  std::size_t sources = 0;
  for (const char* folder : {"src", "include"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file()) continue;
      ++sources;
      const std::string name = entry.path().lexically_relative(root / folder).generic_string();
      for (const std::string& fault : find_faults(name, read_text(entry.path()))) FAIL_CHECK(fault);
    }
  }
  CHECK(sources > kLayerOfPublicHeader.size());
}

TEST_CASE("layers: the table itself points downward") {
  for (const auto& [layer, lower_layers] : kMayInclude) {
    for (const std::string& lower : lower_layers) {
      INFO(layer << " may include " << lower);
      REQUIRE(kMayInclude.contains(lower));
      CHECK_FALSE(kMayInclude.at(lower).contains(layer));
    }
  }
  for (const auto& [header, layer] : kLayerOfPublicHeader) CHECK(kMayInclude.contains(layer));
  for (const auto& [library, layer] : kOnlyUser) CHECK(kMayInclude.contains(layer));
}

TEST_CASE("layers: faults are found") {
  using Faults = std::vector<std::string>;
  CHECK(find_faults("surface/a.cpp", "#include <vector>\n#include \"core/parallel.h\"\n").empty());
  CHECK(find_faults("surface/a.cpp", "// about\n  # include \"transport/bounce.h\"\n") ==
        Faults{"surface/a.cpp (surface) includes transport/bounce.h (transport)"});
  CHECK(find_faults("surface/a.cpp", "#include <heightlight/transport.h>") ==
        Faults{"surface/a.cpp (surface) includes heightlight/transport.h (transport)"});
  CHECK(find_faults("heightlight/image.h", "#include \"heightlight/surface.h\"").size() == 1);
  CHECK(find_faults("core/a.h", "#include \"io/image_file.h\"").size() == 1);
  CHECK(find_faults("heightlight/surface.h", "#include \"core/parallel.h\"").size() == 1);
  CHECK(find_faults("core/a.cpp", "#include <OpenImageIO/imageio.h>\n#include <stb/stb_image.h>").size() ==
        2);
  CHECK(find_faults("io/a.cpp", "#include <OpenImageIO/imageio.h>\n#include <stb/stb_image.h>").empty());
  CHECK(find_faults("curves/a.cpp", "#include <gnuplot-iostream.h>").size() == 1);
  CHECK(find_faults("plot/a.cpp", "#include <CLI/CLI.hpp>").size() == 1);
  CHECK(find_faults("core/a.cpp", "#include \"../io/image_file.h\"").size() == 1);
  CHECK(find_faults("extras/a.cpp", "").size() == 1);
  CHECK(find_faults("main.cpp", "").size() == 1);
  CHECK(find_faults("heightlight/unlisted.h", "").size() == 1);
}
