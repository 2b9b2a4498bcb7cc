// Manifests of datasets, and the runs that they ask for.

#include <algorithm>
#include <set>

#include "cli/dataset_runs.h"
#include "cli/manifest.h"
#include "fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace heightlight;
  static MemoryFile file;
  const auto& path = file.hold(data, size);
  expect_line_or_result(path, [&] {
    const Manifest manifest = read_manifest(path);
    const std::size_t runs = manifest.maps.size() * manifest.relief_shares.size() *
                             manifest.boundaries.size() * manifest.options.size();
    require(runs > 0, "a manifest asks for a run");
    constexpr std::size_t kMostRuns = 100;
    const bool reads_files =
        std::any_of(manifest.maps.begin(), manifest.maps.end(),
                    [](const ManifestMap& map) { return !map.is_shape(); }) ||
        std::any_of(manifest.options.begin(), manifest.options.end(),
                    [](const ManifestOptions& options) { return !options.albedo_file.empty(); });
    if (reads_files || runs > kMostRuns) return;
    std::set<std::string> names;
    for (const DatasetRun& run : list_runs(manifest, "dataset", {})) {
      require(names.insert(run.name).second, "no two runs share a name");
      require(run.name.size() <= 255 && run.name.find('/') == std::string::npos,
              "a run's name fits a folder");
      require(run.simulate.folder.parent_path() == runs_folder("dataset"), "a run stays in its dataset");
    }
    require(names.size() == runs, "every run is listed");
  });
  return 0;
}
