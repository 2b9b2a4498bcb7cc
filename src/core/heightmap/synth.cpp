#include "heightlight/synth.h"

#include <algorithm>
#include <limits>

#include "heightlight/error.h"
#include "heightmap/synth_shapes.h"

namespace heightlight {
namespace {

using MakeShape = Image<float> (*)(int size, std::uint64_t seed);

struct Recipe {
  SynthShape shape;
  MakeShape make;
};

// Maps `lowest` to 0 and `lowest + range` to 1.
Image<float> stretched(Image<float> image, float lowest, float range) {
  for (float& height : image.values) height = range > 0 ? (height - lowest) / range : 0;
  return image;
}

Image<float> stretched(Image<float> image) {
  const auto [lowest, highest] = std::minmax_element(image.values.begin(), image.values.end());
  const float low = *lowest;
  return stretched(std::move(image), low, *highest - low);
}

template <Image<float> (*Make)(int)>
Image<float> analytic(int size, std::uint64_t /*seed*/) {
  return Make(size);
}

template <Image<float> (*Make)(int, std::uint64_t)>
Image<float> natural(int size, std::uint64_t seed) {
  return stretched(Make(size, seed));
}

const std::vector<Recipe>& recipes() {
  static const std::vector<Recipe> kRecipes{
      {{"flat", "level ground", true}, analytic<synth::flat>},
      {{"plane", "tilted plane, rising to the right", false}, analytic<synth::plane>},
      {{"bowl", "pit in a plain, rim radius 0.35; a true spherical cap at relief 0.25 of the width", true},
       analytic<synth::bowl>},
      {{"trench", "endless trench with upright walls, a quarter of the map wide", true},
       analytic<synth::trench>},
      {{"groove", "endless V-groove, half of the map wide", true}, analytic<synth::groove>},
      {{"cliff", "one upright wall in the middle", false}, analytic<synth::cliff>},
      {{"steps", "staircase of eight treads", false}, analytic<synth::steps>},
      {{"sines", "four crossed sine waves, smooth", true}, analytic<synth::sines>},
      {{"shapes", "nine solids on a floor: box, hemisphere, cylinder, cone, well …; round at relief 0.45",
        true},
       analytic<synth::solids>},
      {{"fbm", "hills: fractal noise from a quarter of the map down to the texel", true},
       natural<synth::fbm>},
      {{"cobbles", "worn cobblestones set in rough sand", true}, natural<synth::cobbles>},
      {{"brick", "weathered brick wall in running bond, with chips, pits, cracks and raked joints", true},
       natural<synth::brick>},
      {{"concrete", "rough concrete off four boards, with bubbles and worn places; meant for relief 0.05",
        true},
       natural<synth::concrete>},
  };
  return kRecipes;
}

}  // namespace

const std::vector<SynthShape>& synth_shapes() {
  static const std::vector<SynthShape> kShapes = [] {
    std::vector<SynthShape> shapes;
    for (const Recipe& recipe : recipes()) shapes.push_back(recipe.shape);
    return shapes;
  }();
  return kShapes;
}

Image<float> synthesize(const std::string& shape, int size, std::uint64_t seed) {
  constexpr int kLargestSize = 32768;
  if (size < 1 || size > kLargestSize) {
    throw UsageError("size", std::to_string(size),
                     "a heightmap has 1 to " + std::to_string(kLargestSize) + " texels on a side");
  }
  std::string known;
  for (const Recipe& recipe : recipes()) {
    if (recipe.shape.name == shape) return recipe.make(size, seed);
    known += (known.empty() ? "" : ", ") + recipe.shape.name;
  }
  throw UsageError("there is no shape '" + shape + "'; known are " + known);
}

FbmRows::FbmRows(int size, std::uint64_t seed) : size_(size), seed_(seed) {
  constexpr int kLargestSize = 65536;
  constexpr int kAtOnce = 64;
  if (size < 1 || size > kLargestSize) {
    throw UsageError(
        "size", std::to_string(size),
        "a heightmap made by rows has 1 to " + std::to_string(kLargestSize) + " texels on a side");
  }
  lowest_ = std::numeric_limits<float>::infinity();
  float highest = -lowest_;
  for (int first = 0; first < size; first += kAtOnce) {
    const Image<float> part =
        synth::fbm_rows({.size = size, .first = first, .count = std::min(kAtOnce, size - first)}, seed);
    const auto [low, high] = std::minmax_element(part.values.begin(), part.values.end());
    lowest_ = std::min(lowest_, *low);
    highest = std::max(highest, *high);
  }
  range_ = highest - lowest_;
}

Image<float> FbmRows::rows(int first, int count) const {
  return stretched(synth::fbm_rows({.size = size_, .first = first, .count = count}, seed_), lowest_, range_);
}

}  // namespace heightlight
