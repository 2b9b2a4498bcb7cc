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

const Names kCore = {"base",  "heightmap", "surface",     "visibility", "transport", "curves", "forms",
                     "solve", "skylight",  "screenspace", "shaders",    "gloss",     "window"};

Names with(Names names, const Names& more) {
  names.insert(more.begin(), more.end());
  return names;
}

/// The layers that a layer may include beside itself: first those of src/core, which know nothing of files,
/// then src/files, those of src/studies, and src/cli and src/python, which know nothing of each other.
const std::map<std::string, Names> kMayInclude = {
    {"base", {}},
    {"heightmap", {"base"}},
    {"surface", {"base", "heightmap"}},
    {"visibility", {"base", "heightmap", "surface"}},
    {"transport", {"base", "heightmap", "surface", "visibility"}},
    {"curves", {"base", "heightmap"}},
    {"forms", {"base", "heightmap", "surface", "curves"}},
    {"solve", {"base", "heightmap", "surface", "visibility", "transport", "forms"}},
    {"skylight", {"base", "heightmap", "surface", "visibility"}},
    {"screenspace", {"base", "heightmap", "surface", "skylight"}},
    {"shaders", {"base", "heightmap", "surface", "visibility", "curves", "forms"}},
    {"gloss", {"base", "heightmap", "surface", "visibility", "skylight"}},
    {"window", {"base", "heightmap", "surface", "visibility"}},
    {"files", kCore},
    {"relief", kCore},
    {"report", {"base", "heightmap", "files"}},
    {"expression", with(kCore, {"files"})},
    {"user_form", with(kCore, {"files", "expression"})},
    {"fit", with(kCore, {"files", "expression", "user_form"})},
    {"comparison", with(kCore, {"files", "expression", "user_form", "fit"})},
    {"terrain", with(kCore, {"files", "expression", "user_form", "fit", "comparison"})},
    {"bake", with(kCore, {"files"})},
    {"shading", with(kCore, {"files", "bake"})},
    {"windows", with(kCore, {"files", "bake"})},
    {"plot", with(kCore, {"files", "expression", "user_form", "relief", "fit", "comparison"})},
    {"cli", with(kCore, {"files", "expression", "user_form", "relief", "fit", "comparison", "terrain",
                         "shading", "bake", "windows", "plot", "report"})},
    {"python", with(kCore, {"files", "expression", "user_form", "fit", "comparison", "bake", "windows"})},
};

/// The folders of src/ that hold layers; `cli`, `python` and `files` are layers themselves.
const std::vector<std::string> kGroups = {"core/", "studies/"};

const std::map<std::string, std::string> kLayerOfPublicHeader = {
    {"error.h", "base"},
    {"watch.h", "base"},
    {"image.h", "base"},
    {"version.h", "base"},
    {"heightmap.h", "heightmap"},
    {"synth.h", "heightmap"},
    {"georeference.h", "heightmap"},
    {"surface.h", "surface"},
    {"visibility.h", "visibility"},
    {"transport.h", "transport"},
    {"curves.h", "curves"},
    {"forms.h", "base"},  // formulas alone, for everybody
    {"occlusion_forms.h", "base"},
    {"closed_forms.h", "forms"},
    {"shaders.h", "shaders"},
    {"evidence.h", "solve"},
    {"solve.h", "solve"},
    {"screenspace.h", "screenspace"},
    {"sky_light.h", "skylight"},
    {"sun.h", "skylight"},
    {"gloss.h", "gloss"},
    {"files.h", "files"},
    {"terrain_forms.h", "forms"},
};

const Names kCommands = {"fit",     "comparison", "terrain", "shading", "bake",
                         "windows", "plot",       "report",  "cli"};

/// Libraries, by how their headers' names begin, and the layers that include them. No public header does.
const std::map<std::string, Names> kUsers = {
    {"OpenImageIO/", {"files"}},
    {"stb/", {"files"}},
    {"boost/", {"files"}},
    {"openssl/", {"files"}},
    {"gnuplot-iostream", {"plot"}},
    {"CLI/", {"cli"}},
    {"pybind11/", {"python"}},
    {"nlohmann/", with(kCommands, {"files"})},
    {"fmt/", with(kCommands, {"files"})},
    {"hwy/", {"base", "visibility", "transport", "screenspace"}},
    {"Eigen/", with(kCore, {"fit", "comparison", "shading"})},
    {"unsupported/Eigen/", {"fit"}},
};

constexpr const char* kPublicFolder = "heightlight/";

/// What each folder of src/ says of itself.
constexpr const char* kFolderText = "README.md";

/// A source's name relative to the folder that holds its layer.
std::string strip_group(const std::string& name) {
  for (const std::string& group : kGroups) {
    if (name.starts_with(group)) return name.substr(group.size());
  }
  return name;
}

/// The layer of a header as written after #include, or of a source without its group's folder; empty where it
/// has none.
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

/// What is wrong with the includes of one source: its name without its group's folder, and its text.
std::vector<std::string> find_faults(const std::string& name, const std::string& text) {
  const std::string layer = layer_of(name);
  if (layer.empty()) return {name + " is in no known layer"};
  std::vector<std::string> faults;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string quoted = included_by(line);
    if (quoted.empty()) continue;
    const std::string included = quoted.substr(1);
    for (const auto& [library, users] : kUsers) {
      if (included.starts_with(library) && (!users.contains(layer) || name.starts_with(kPublicFolder))) {
        faults.push_back(name + " includes " + included + ", which it may not");
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

/// The layers that a README names after "May be included by:", where it ends.
Names users_told(const std::string& text) {
  const std::string begin = "May be included by:";
  Names users;
  std::size_t at = text.find(begin);
  while (at != std::string::npos && (at = text.find('`', at)) != std::string::npos) {
    const std::size_t end = text.find('`', at + 1);
    if (end == std::string::npos) break;
    users.insert(text.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return users;
}

/// The layers that may include one.
Names users_of(const std::string& layer) {
  Names users;
  for (const auto& [user, lower] : kMayInclude) {
    if (lower.contains(layer)) users.insert(user);
  }
  return users;
}

}  // namespace

TEST_CASE("layers") {
  const std::filesystem::path root(HEIGHTLIGHT_SOURCE_DIR);
  std::size_t sources = 0;
  for (const char* folder : {"src", "include"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || entry.path().filename() == kFolderText) continue;
      ++sources;
      std::string name = strip_group(entry.path().lexically_relative(root / folder).generic_string());
      if (name.ends_with(".in")) name.resize(name.size() - 3);
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
  for (const auto& [library, users] : kUsers) {
    for (const std::string& user : users) CHECK(kMayInclude.contains(user));
  }
}

TEST_CASE("layers: faults are found") {
  using Faults = std::vector<std::string>;
  CHECK(find_faults("surface/a.cpp", "#include <vector>\n#include \"base/parallel.h\"\n").empty());
  CHECK(find_faults("surface/a.cpp", "// about\n  # include \"transport/bounce.h\"\n") ==
        Faults{"surface/a.cpp (surface) includes transport/bounce.h (transport)"});
  CHECK(find_faults("surface/a.cpp", "#include <heightlight/transport.h>") ==
        Faults{"surface/a.cpp (surface) includes heightlight/transport.h (transport)"});
  CHECK(find_faults("solve/a.cpp", "#include \"heightlight/files.h\"").size() == 1);
  CHECK(find_faults("heightlight/image.h", "#include \"heightlight/surface.h\"").size() == 1);
  CHECK(find_faults("base/a.h", "#include \"files/image_file.h\"").size() == 1);
  CHECK(find_faults("heightlight/surface.h", "#include \"base/parallel.h\"").size() == 1);
  CHECK(find_faults("base/a.cpp", "#include <OpenImageIO/imageio.h>\n#include <stb/stb_image.h>").size() ==
        2);
  CHECK(find_faults("files/a.cpp", "#include <OpenImageIO/imageio.h>\n#include <stb/stb_image.h>").empty());
  CHECK(find_faults("heightlight/files.h", "#include <nlohmann/json.hpp>").size() == 1);
  CHECK(find_faults("heightlight/surface.h", "#include <Eigen/Core>").size() == 1);
  CHECK(find_faults("solve/a.cpp", "#include <fmt/core.h>").size() == 1);
  CHECK(find_faults("curves/a.cpp", "#include <gnuplot-iostream.h>").size() == 1);
  CHECK(find_faults("plot/a.cpp", "#include <CLI/CLI.hpp>").size() == 1);
  CHECK(find_faults("base/a.cpp", "#include \"../files/image_file.h\"").size() == 1);
  CHECK(find_faults("extras/a.cpp", "").size() == 1);
  CHECK(find_faults("main.cpp", "").size() == 1);
  CHECK(find_faults("heightlight/unlisted.h", "").size() == 1);
}

TEST_CASE("layers: each folder has a README of 5 to 15 lines that tells its entry and who may include it") {
  const std::filesystem::path sources = std::filesystem::path(HEIGHTLIGHT_SOURCE_DIR) / "src";
  Names told;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(sources)) {
    if (!entry.is_directory()) continue;
    const std::string folder = entry.path().lexically_relative(sources).generic_string();
    INFO(folder);
    const std::string text = read_text(entry.path() / kFolderText);
    const auto lines = std::count(text.begin(), text.end(), '\n');
    CHECK(lines >= 5);
    CHECK(lines <= 15);
    CHECK(text.find("\nEntry: ") != std::string::npos);
    const std::string layer = strip_group(folder);
    if (!kMayInclude.contains(layer)) continue;  // core and studies, which hold layers
    told.insert(layer);
    CHECK(users_told(text) == users_of(layer));
  }
  CHECK(told.size() == kMayInclude.size());
}

TEST_CASE("layers: the constants of closed forms stand in forms.h alone") {
  const std::filesystem::path root(HEIGHTLIGHT_SOURCE_DIR);
  // A digit or two of each published polynomial: the notes' F0 and F1 (Patapom), Jimenez' fit (Jimenez et al.
  // 2016).
  const Names constants = {"27.576937094", "3.336439200", "2.0404", "4.7951", "2.7552"};
  Names places;
  for (const char* folder : {"src", "include", "examples"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string text = read_text(entry.path());
      for (const std::string& constant : constants) {
        if (text.find(constant) != std::string::npos) {
          places.insert(constant + " in " + entry.path().filename().string());
        }
      }
    }
  }
  Names expected;
  for (const std::string& constant : constants) expected.insert(constant + " in forms.h");
  CHECK(places == expected);
}
