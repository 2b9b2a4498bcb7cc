#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/parallel.h"
#include "files/json_file.h"
#include "transport/gather_field.h"
#include "transport/progressive_gather.h"
#include "transport/seen_places.h"
#include "window/read_around.h"
#include "windows/steps.h"
#include "windows/work_json.h"

namespace heightlight {
namespace {

/// Rows of A and normals that tell of the whole map: those of for_seen_places, below each other.
struct SeenStrip {
  Map sky;
  Surface surface;
};

Image<Vector3> normals_of_row(const Work& work, const StoredMap& heights, int row) {
  const WorkFacts& facts = work.state.facts;
  const int width = facts.grid.map_width;
  const Surface three =
      build_surface({.height = read_around(heights, facts.boundary, {row - 1, -1, 3, width + 2}),
                     .spacing = facts.spacing,
                     .boundary = Boundary::open});
  Image<Vector3> normals(width, 1);
  std::copy_n(&three.normal(1, 1), width, normals.values.data());
  return normals;
}

SeenStrip read_strip(const Work& work) {
  const WindowGrid& grid = work.state.facts.grid;
  const WindowFiles sky(lighting_folder(work), 0);
  const WindowFiles heights(heights_folder(work), 0);
  const std::vector<int> rows = seen_rows(grid.map_height);
  const auto count = static_cast<int>(rows.size());
  SeenStrip strip{.sky = Map(grid.map_width, count), .surface = {}};
  strip.surface.normal = Image<Vector3>(grid.map_width, count);
  for (int i = 0; i < count; ++i) {
    const int row = rows[static_cast<std::size_t>(i)];
    sky.read({row, 0, 1, grid.map_width}, &strip.sky(i, 0));
    std::copy_n(normals_of_row(work, heights, row).values.data(), grid.map_width,
                &strip.surface.normal(i, 0));
  }
  return strip;
}

std::vector<double> sample_sky(const Work& work) {
  const WindowGrid& grid = work.state.facts.grid;
  const WindowFiles sky(lighting_folder(work), 0);
  std::vector<double> sample;
  const std::int64_t texels = std::int64_t{grid.map_width} * grid.map_height;
  for (const std::size_t texel : SkyClasses::sample_texels(texels, kSkyClassesSeed)) {
    const auto width = static_cast<std::size_t>(grid.map_width);
    float value = 0;
    sky.read({static_cast<int>(texel / width), static_cast<int>(texel % width), 1, 1}, &value);
    if (!std::isnan(value)) sample.push_back(double{value});
  }
  return sample;
}

/// Of the channels that are gathered, the one of that number.
IrradianceSystem system_of(const Work& work, std::size_t number) {
  return {.albedo = work.task.options.albedo.constant[channels_at_hand(work)[number]]};
}

/// What the gather at hand looks at of a channel: made of what the last one left, or of A before the first.
class Radiosity : public StoredMap {
 public:
  Radiosity(const Work& work, std::size_t channel)
      : albedo_(system_of(work, channel).albedo),
        kept_(work.state.courses[channel].kept),
        first_(work.state.gather == 0),
        irradiance_(first_ ? lighting_folder(work) : field_folder(work, work.state.gather),
                    first_ ? 0 : kFieldMaps * static_cast<int>(channel)),
        before_(field_folder(work, work.state.gather), kFieldMaps * static_cast<int>(channel) + 1) {}

  int width() const override { return irradiance_.width(); }
  int height() const override { return irradiance_.height(); }

  void read(const MapRect& rect, float* samples) const override {
    Map irradiance(rect.columns, rect.rows);
    irradiance_.read(rect, irradiance.values.data());
    if (first_) {
      parallel_for(rect.rows, [&](std::int64_t row) {
        for (std::size_t i = irradiance.index(static_cast<int>(row), 0);
             i < irradiance.index(static_cast<int>(row) + 1, 0); ++i) {
          const float share = irradiance.values[i];
          const float guess =
              std::isnan(share) ? share : static_cast<float>(guess_total(double{share}, albedo_));
          samples[i] = new_radiosity(albedo_, guess, guess, kept_);
        }
      });
      return;
    }
    Map before(rect.columns, rect.rows);
    before_.read(rect, before.values.data());
    for (std::size_t i = 0; i < before.size(); ++i)
      samples[i] = new_radiosity(albedo_, irradiance.values[i], before.values[i], kept_);
  }

 private:
  double albedo_;
  double kept_;
  bool first_;
  WindowFiles irradiance_;
  WindowFiles before_;
};

GatherField read_field(const Work& work, int window, std::size_t channel, const IrradianceSystem& system,
                       const Map& sky) {
  GatherField field = start_field(system, sky);
  field.course = work.state.courses[channel];
  if (work.state.gather == 0) return field;
  const WindowFolder folder = field_folder(work, work.state.gather);
  const int first = kFieldMaps * static_cast<int>(channel);
  field.irradiance = read_window(folder, window, first);
  field.before = read_window(folder, window, first + 1);
  field.weighted = read_window(folder, window, first + 2);
  field.weights = read_window(folder, window, first + 3);
  return field;
}

std::filesystem::path change_file(const Work& work, int window) {
  return field_folder(work, work.state.gather + 1).path / fmt::format("{:04}.json", window);
}

/// Channels that walk so many azimuths together, at most kMostFields in a group.
std::vector<std::vector<std::size_t>> groups_of(const Work& work) {
  std::map<int, std::vector<std::size_t>> by_azimuths;
  for (std::size_t c = 0; c < work.state.courses.size(); ++c) {
    const int azimuths = azimuths_of_gather(work.state.courses[c], work.state.gather);
    if (azimuths > 0) by_azimuths[azimuths].push_back(c);
  }
  std::vector<std::vector<std::size_t>> groups;
  for (const auto& [azimuths, channels] : by_azimuths) {
    for (std::size_t first = 0; first < channels.size(); first += kMostFields) {
      const std::size_t end = std::min(first + kMostFields, channels.size());
      groups.emplace_back(channels.begin() + static_cast<std::ptrdiff_t>(first),
                          channels.begin() + static_cast<std::ptrdiff_t>(end));
    }
  }
  return groups;
}

/// Gathers what the window's surface sees of the light of these channels, and steps their fields.
std::vector<ChangeSum> gather_channels(const Work& work, const Surface& surface, const StepGround& ground,
                                       const std::vector<std::size_t>& channels,
                                       std::vector<GatherField>& fields) {
  const int k = work.state.gather;
  std::vector<FieldPyramid> pyramids;
  std::vector<const FieldPyramid*> read;
  std::vector<GatherField*> stepped;
  for (const std::size_t c : channels) {
    const CoarseField coarse =
        complete_field(work.state.facts.first_coarse, read_whole(light_folder(work), static_cast<int>(c)));
    fill_window_field(surface, Radiosity(work, c), coarse,
                      pyramids.emplace_back(ground.gather.make_pyramid()));
    stepped.push_back(&fields[c]);
  }
  for (const FieldPyramid& pyramid : pyramids) read.push_back(&pyramid);
  const GatherTurn turn{.azimuths = azimuths_of_gather(fields[channels[0]].course, k),
                        .turn = spread_turn(k + 1)};
  return take_step(ground, turn, read, stepped, k < kTellingGathers);
}

void write_fields(const Work& work, int window, const std::vector<GatherField>& fields,
                  const std::vector<ChangeSum>& changes) {
  nlohmann::ordered_json told = nlohmann::ordered_json::array();
  for (const ChangeSum& change : changes) told.push_back(to_json(change));
  replace_json(change_file(work, window), told);
  std::vector<const Map*> written;
  for (const GatherField& field : fields)
    written.insert(written.end(), {&field.irradiance, &field.before, &field.weighted, &field.weights});
  write_window(field_folder(work, work.state.gather + 1), window, written);
}

}  // namespace

void begin_courses(Work& work) {
  const SeenStrip strip = read_strip(work);
  const double deep_share = deep_surface_share(strip.sky, strip.surface);
  const GatherPlan& plan = plan_at_hand(work).gather;
  const ProgressiveGoal goal{.error = error_at_hand(work),
                             .last_azimuths = plan.walk.azimuths,
                             .planned_unevenness = plan.unevenness};
  work.state.courses.clear();
  for (std::size_t c = 0; c < channels_at_hand(work).size(); ++c) {
    const IrradianceSystem system = system_of(work, c);
    const double found = unevenness(system, strip.sky, strip.surface);
    work.state.courses.push_back(
        begin_course(system.albedo, deep_share, azimuths_for_unevenness(found, goal)));
  }
  work.state.class_sample = sample_sky(work);
}

void find_window_light(Work& work, int window) {
  const WindowPlace place = work.state.facts.grid.place(window);
  std::vector<Map> blocks;
  std::vector<const Map*> written;
  for (std::size_t c = 0; c < work.state.courses.size(); ++c) {
    Map field(place.width, place.height);
    Radiosity(work, c).read({place.first_row, place.first_column, place.height, place.width},
                            field.values.data());
    blocks.push_back(coarse_field_of(std::move(field), work.state.facts.first_coarse));
  }
  for (const Map& map : blocks) written.push_back(&map);
  write_window(light_folder(work), window, written);
}

void gather_window(Work& work, int window) {
  const WalkOptions& walk = plan_at_hand(work).gather.walk;
  const Surface surface = surface_of_window(work, window, {walk});
  const Map sky = read_window(lighting_folder(work), window, 0);
  const MapGather gather(surface, {}, walk);
  const SkyClasses classes(work.state.class_sample);
  const Watch silent{.tell = {}, .stopped = work.task.options.watch.stopped};
  const StepGround ground{gather, sky, classes, silent};
  std::vector<IrradianceSystem> systems;
  std::vector<GatherField> fields;
  for (std::size_t c = 0; c < work.state.courses.size(); ++c) systems.push_back(system_of(work, c));
  for (std::size_t c = 0; c < systems.size(); ++c)
    fields.push_back(read_field(work, window, c, systems[c], sky));
  std::vector<ChangeSum> changes(fields.size());
  for (const std::vector<std::size_t>& channels : groups_of(work)) {
    const std::vector<ChangeSum> found = gather_channels(work, surface, ground, channels, fields);
    for (std::size_t i = 0; i < found.size(); ++i) changes[channels[i]] = found[i];
  }
  write_fields(work, window, fields, changes);
}

ChangeSum change_of_gather(const Work& work, std::size_t channel) {
  ChangeSum sum;
  for (int window = 0; window < work.state.facts.grid.count(); ++window)
    sum.add(change_of(read_json(change_file(work, window)).at(channel)));
  return sum;
}

}  // namespace heightlight
