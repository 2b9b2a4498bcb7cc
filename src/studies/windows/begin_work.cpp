#include "windows/begin_work.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <system_error>

#include "bake/baked_map.h"
#include "bake/material.h"
#include "base/byte_size.h"
#include "files/file_format.h"
#include "files/load_by_rows.h"
#include "files/output_file.h"
#include "heightlight/error.h"
#include "heightlight/solve.h"
#include "transport/gather_walk.h"
#include "visibility/horizon_scene.h"
#include "windows/sky_maps.h"
#include "windows/step_plan.h"
#include "windows/steps.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;

/// Levels that are made window by window: halos grow with them, and what is held as a whole shrinks.
constexpr int kFewestFine = 3;
constexpr int kMostFine = 6;

/// Of the memory, what the coarse levels may take.
constexpr std::uint64_t kCoarsePart = 8;

/// What a process holds before it bakes: its code, its libraries, its threads' stacks.
constexpr std::uint64_t kProcessBytes = 160ULL << 20;

std::size_t fields_of(const BakeOptions& options) {
  return is_wanted(options, MaterialMap::multibounce) ? options.albedo.channels() : 0;
}

/// Of the map: mean and highest heights, what is gathered, and what the check bounds lines of sight by.
std::uint64_t coarse_bytes(const WindowGrid& grid, int first_coarse, const BakeOptions& options) {
  const auto texels =
      static_cast<std::uint64_t>(grid.map_width) * static_cast<std::uint64_t>(grid.map_height);
  const std::uint64_t maps =
      2 + std::max<std::uint64_t>(1, std::min<std::size_t>(fields_of(options), kMostFields));
  return (texels >> (2 * first_coarse)) * sizeof(float) * maps * 4 / 3;
}

int choose_first_coarse(const WindowGrid& grid, const BakeOptions& options) {
  int level = kFewestFine;
  while (level < kMostFine && coarse_bytes(grid, level, options) > options.memory / kCoarsePart) ++level;
  return level;
}

/// Blocks of a map that tiles must be whole ones.
void check_tiling(const fs::path& map, const WorkFacts& facts) {
  const int block = 1 << facts.first_coarse;
  if (facts.boundary == Boundary::open) return;
  if (facts.grid.map_width % block == 0 && facts.grid.map_height % block == 0) return;
  throw file_error(
      map,
      "is " + std::to_string(facts.grid.map_width) + " × " + std::to_string(facts.grid.map_height) +
          " texels; of a map that tiles, windows want sides that " + std::to_string(block) + " divides",
      "boundary");
}

/// Of planning on a crop.
std::uint64_t plan_bytes(const WindowGrid& grid, const BakeOptions& options) {
  return estimate_memory(std::min(kCropSide, grid.map_width), std::min(kCropSide, grid.map_height),
                         material_request(options, AzimuthConvention::math));
}

std::uint64_t needed_bytes(const WindowGrid& grid, int first_coarse, const BakeOptions& options) {
  return coarse_bytes(grid, first_coarse, options) + kPagedBytes +
         std::max(window_bytes(grid, first_coarse, options), plan_bytes(grid, options));
}

[[noreturn]] void refuse_windows(const WindowGrid& grid, std::uint64_t needed, const BakeOptions& options) {
  throw MemoryError("windows of " + std::to_string(grid.side) + " × " + std::to_string(grid.side) + " of " +
                        std::to_string(grid.map_width) + " × " + std::to_string(grid.map_height) +
                        " texels need " + format_byte_size(needed) + ", more than the " +
                        format_byte_size(options.memory) + " of memory allowed; a smaller window needs less",
                    needed - options.memory);
}

/// The largest side whose windows memory holds.
int choose_side(WindowGrid grid, int first_coarse, const BakeOptions& options) {
  constexpr std::array kSides{8192, 6144, 4096, 3072, 2048, 1536, 1024, 768, 512, 256};
  std::uint64_t needed = 0;
  for (const int side : kSides) {
    grid.side = side;
    needed = needed_bytes(grid, first_coarse, options);
    if (needed <= options.memory) return side;
  }
  refuse_windows(grid, needed, options);
}

/// Of a map whose size and boundary are known.
void choose_windows(Work& work, int side) {
  WorkFacts& facts = work.state.facts;
  facts.first_coarse = choose_first_coarse(facts.grid, work.task.options);
  check_tiling(work.task.map, facts);
  facts.grid.side = side > 0 ? side : choose_side(facts.grid, facts.first_coarse, work.task.options);
  check_window_memory(work, facts.grid.side);
}

/// Takes a map's rows, from which its size is first known.
class HeightsInParts {
 public:
  HeightsInParts(Work& work, int side) : work_(work), side_(side) {
    work.state.facts.lowest = std::numeric_limits<float>::infinity();
    work.state.facts.highest = -work.state.facts.lowest;
  }

  void take(const Heightmap& map, int first, const Map& rows) {
    if (!rows_) begin(map);
    WorkFacts& facts = work_.state.facts;
    for (const float height : rows.values) {  // comparisons with NaN are false
      if (height < facts.lowest) facts.lowest = height;
      if (height > facts.highest) facts.highest = height;
      if (std::isnan(height)) ++facts.missing;
    }
    rows_->take(first, rows);
  }

  void finish() { rows_->finish(); }

 private:
  void begin(const Heightmap& map) {
    WorkFacts& facts = work_.state.facts;
    facts.grid = {.map_width = map.height.width, .map_height = map.height.height};
    facts.boundary = map.boundary;
    choose_windows(work_, side_);
    rows_.emplace(heights_folder(work_));
  }

  Work& work_;
  int side_;
  std::optional<WindowRows> rows_;
};

LoadedHeightmap load_in_parts(const WindowedTask& task, HeightsInParts& heights) {
  const InputFile file(task.map);
  if (recognise_format(file) == FileFormat::tiff) {
    return load_heightmap_by_rows(task.map, task.load, [&](const Heightmap& map, int first, const Map& rows) {
      heights.take(map, first, rows);
    });
  }
  LoadedHeightmap loaded = load_heightmap(task.map, task.load, task.options.memory);
  heights.take(loaded.map, 0, loaded.map.height);
  return loaded;
}

/// Whether all that a folder holds is of such work, which may go. One that is not there holds nothing else.
bool is_work_folder(const fs::path& folder) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder, ignored)) {
    const std::string kind = entry.path().extension();
    const bool is_known = kind == ".raw" || kind == ".json" || kind == ".part";
    if (!entry.is_directory(ignored) && !is_known) return false;
  }
  return true;
}

void make_folders(const Work& work) {
  if (!is_work_folder(work.task.folder))
    throw output_error(work.task.folder, "it holds files that are of no bake by windows");
  std::error_code failure;
  fs::remove_all(work.task.folder, failure);
  for (const char* name : {"heights", "coarse", "plan", "sky", "check", "textures"}) {
    if (!failure) fs::create_directories(work.task.folder / name, failure);
  }
  if (failure) throw output_error(work.task.folder, failure.message());
}

}  // namespace

void check_side(int side) {
  if (side % kTileSide != 0 || side < 0)
    throw UsageError("out_of_core", std::to_string(side),
                     "must be a multiple of " + std::to_string(kTileSide));
}

std::uint64_t window_bytes(const WindowGrid& grid, int first_coarse, const BakeOptions& options) {
  constexpr std::uint64_t kFloat = sizeof(float);
  const auto margin =
      static_cast<std::uint64_t>(walk_margin({.samples_per_octave = 32}));  // few maps want more
  const auto squared = [](std::uint64_t side) { return side * side; };
  const auto side =
      static_cast<std::uint64_t>(std::min(grid.side, std::max(grid.map_width, grid.map_height)));
  const std::uint64_t texels = squared(side);
  const std::uint64_t around = squared(side + 2 * margin);
  const std::uint64_t region = squared(side + (margin << first_coarse));
  const std::uint64_t surface = texels * (kFloat + sizeof(Vector3)) + around * kFloat * 5 / 3;
  const std::uint64_t reading = region * kFloat * 8 / 3;
  const auto kept = static_cast<std::uint64_t>(kept_sky_count(sky_wanted(options)));
  const std::uint64_t sky = texels * kFloat * 2 * kept;
  const std::uint64_t fields = fields_of(options);
  const std::uint64_t together = std::min<std::uint64_t>(fields, kMostFields);
  const std::uint64_t gather = texels * kFloat * (1 + 4 * fields) + around * kFloat * (7 + 4 * together) / 3;
  const std::uint64_t textures = texels * kFloat * (kept + fields + 2 * texture_channels(options));
  return surface + std::max({sky, fields > 0 ? gather + reading : 0, textures, reading});
}

void check_window_memory(const Work& work, int side) {
  WindowGrid grid = work.state.facts.grid;
  grid.side = side;
  const std::uint64_t needed = needed_bytes(grid, work.state.facts.first_coarse, work.task.options);
  if (needed > work.task.options.memory) refuse_windows(grid, needed, work.task.options);
}

Work begin_work(WindowedTask task, int side) {
  check_side(side);
  Work work{.task = std::move(task), .state = {}};
  make_folders(work);
  HeightsInParts heights(work, side);
  const LoadedHeightmap loaded = load_in_parts(work.task, heights);
  heights.finish();
  WorkFacts& facts = work.state.facts;
  facts.request = work.task.options.request;
  facts.base = loaded.map.base;
  facts.spacing = loaded.map.spacing;
  facts.curvature = loaded.map.curvature;
  facts.sha256 = loaded.facts.sha256;
  facts.place = loaded.place;
  facts.warnings = loaded.warnings;
  write_state(work.task.folder, work.state);
  return work;
}

Work begin_work_of(WindowedTask task, int side, const WorkFacts& facts) {
  check_side(side);
  Work work{.task = std::move(task), .state = {.facts = facts, .step = WorkStep::heights}};
  work.state.facts.request = work.task.options.request;
  choose_windows(work, side);
  make_folders(work);
  write_state(work.task.folder, work.state);
  return work;
}

std::uint64_t process_bytes(const Work& work) {
  const WorkFacts& facts = work.state.facts;
  return kProcessBytes + needed_bytes(facts.grid, facts.first_coarse, work.task.options);
}

}  // namespace heightlight
