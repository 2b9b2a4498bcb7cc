#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "heightmap/synth_noise.h"
#include "heightmap/synth_shapes.h"

// A wall of ten courses of four bricks. Lengths are in map widths, heights are shares of the relief. At the
// usual relief of a tenth of the width, a height of 0.1 is as long as 0.01 map widths.

namespace heightlight::synth {
namespace {

constexpr int kCourses = 10;
constexpr int kBricksPerCourse = 4;
constexpr double kJoint = 0.014;
constexpr double kWallSlope = 260;         // relief per width: 2° off upright where the relief is a tenth
constexpr double kReach = 1 / kWallSlope;  // how far a brick's side wall extends beyond its outline, at most
constexpr double kArris = 0.009;           // breadth of the worn edge
constexpr double kRaggedness = 0.011;      // how far ragged edges move the outline, at most
constexpr double kMortarEdge = 0.02;       // how far mortar extends onto a brick, at most
constexpr double kSound = 2;               // a level that no noise reaches
static_assert(kMortarEdge >= kArris + kRaggedness, "ragged edges start where they do not show yet");

struct Brick {
  double u, v;  // centre
  double half_width, half_height;
  double cosine, sine;                  // rotation of the brick in the wall
  std::array<double, 4> corner_radius;  // upper left, upper right, lower left, lower right
  double top;                           // height of the face's centre
  double tilt_u, tilt_v;                // slope of the face
  double shift_u, shift_v;              // shift of the noise fields, so that no two bricks share a face
  double roughness;
  double creases;
  double wear;   // height lost at the edge
  double spall;  // noise level above which the face has broken off
  double crack;  // depth of its cracks
};

Brick lay_brick(int course, int place, double course_shift, std::uint64_t seed) {
  RandomSequence random(hash_cell(place, course, seed));
  Brick brick{};
  const double bond = course % 2 == 0 ? 0.25 : 0.75;
  brick.u = (place + bond + course_shift) / kBricksPerCourse + random.between(-0.003, 0.003);
  brick.v = (course + 0.5) / kCourses + random.between(-0.002, 0.002);
  brick.half_width = 0.5 / kBricksPerCourse - kJoint / 2 + random.between(-0.006, 0.002);
  brick.half_height = 0.5 / kCourses - kJoint / 2 + random.between(-0.004, 0.002);
  const double half_turn = random.between(-0.008, 0.008);  // tangent of half the angle: needs no sine
  brick.cosine = (1 - half_turn * half_turn) / (1 + half_turn * half_turn);
  brick.sine = 2 * half_turn / (1 + half_turn * half_turn);
  for (double& radius : brick.corner_radius) {
    const double share = random.unit();
    radius = 0.004 + 0.016 * share * share * share;
  }
  brick.top = random.between(0.76, 0.92);
  brick.tilt_u = random.between(-0.35, 0.35);
  brick.tilt_v = random.between(-0.8, 0.8);
  brick.shift_u = random.unit();
  brick.shift_v = random.unit();
  brick.roughness = random.between(0.6, 1.7);
  brick.creases = random.between(-0.6, 1);
  brick.wear = random.between(0.06, 0.2);
  brick.spall = random.unit() < 0.3 ? random.between(0, 0.4) : kSound;
  brick.crack = random.unit() < 0.4 ? random.between(0.1, 0.35) : 0;
  return brick;
}

std::vector<Brick> lay_wall(std::uint64_t seed) {
  std::vector<Brick> wall;
  for (int course = 0; course < kCourses; ++course) {
    const double course_shift = RandomSequence(hash_cell(course, 0, scramble(seed))).between(-0.06, 0.06);
    for (int place = 0; place < kBricksPerCourse; ++place) {
      wall.push_back(lay_brick(course, place, course_shift, seed));
    }
  }
  return wall;
}

/// The position of a point on a brick.
struct Place {
  double along, down;  // from the centre, on the face
  double outside;      // signed distance to the outline, negative on the brick
};

// Position on a brick, with the signed distance to a box whose corners are rounded, each by its own radius.
Place place_on(const Brick& brick, double u, double v) {
  const double du = shorter_way(u - brick.u);
  const double dv = shorter_way(v - brick.v);
  Place place{brick.cosine * du + brick.sine * dv, brick.cosine * dv - brick.sine * du, 0};
  const double radius = brick.corner_radius[(place.along > 0 ? 1 : 0) + (place.down > 0 ? 2 : 0)];
  const double x = std::abs(place.along) - brick.half_width + radius;
  const double y = std::abs(place.down) - brick.half_height + radius;
  const double beyond_corner = x > 0 && y > 0 ? std::sqrt(x * x + y * y) : (x > y ? x : y);
  place.outside = beyond_corner - radius;
  return place;
}

/// The wall's materials, each as a height over the map.
class Wall {
 public:
  Wall(int size, std::uint64_t seed);
  double height(double u, double v) const;

 private:
  /// The bricks that a position may lie on.
  struct Neighbourhood {
    std::array<const Brick*, 4> bricks{};
    std::array<Place, 4> places{};
    std::size_t count = 0;
    double outside = 1;  ///< smallest signed distance to a brick's outline
  };

  Neighbourhood bricks_near(double u, double v) const;
  double face(const Brick& brick, const Place& place, double u, double v) const;
  double mortar(double u, double v, double outside) const;
  double holes(double u, double v) const;

  std::vector<Brick> bricks_;
  TiledNoise sag_u_, sag_v_;
  Octaves ragged_;
  TiledNoise chips_;
  Octaves undulation_;
  TiledNoise creases_;
  Octaves grain_;
  TiledNoise spall_;
  Octaves broken_;
  TiledNoise crack_, jag_;
  Spots pits_, blowholes_;
  Octaves filling_;
  Octaves trowel_;
  Octaves sand_;
};

Wall::Wall(int size, std::uint64_t seed)
    : bricks_(lay_wall(hash_combine(seed, 10))),
      sag_u_(3, 5, hash_combine(seed, 11)),
      sag_v_(2, 5, hash_combine(seed, 12)),
      ragged_(36, std::min(size / 2, 300), 0.62, hash_combine(seed, 13)),
      chips_(19, 23, hash_combine(seed, 14)),
      undulation_(7, 28, 0.55, hash_combine(seed, 15)),
      creases_(14, 110, hash_combine(seed, 16)),
      grain_(48, size / 2, 0.62, hash_combine(seed, 17)),
      spall_(9, 11, hash_combine(seed, 18)),
      broken_(22, 90, 0.6, hash_combine(seed, 19)),
      crack_(5, 6, hash_combine(seed, 20)),
      jag_(47, 47, hash_combine(seed, 21)),
      pits_(61, 0.1, 0.1, 0.33, hash_combine(seed, 22)),
      blowholes_(19, 0.3, 0.1, 0.24, hash_combine(seed, 23)),
      filling_(5, 24, 0.7, hash_combine(seed, 24)),
      trowel_(26, 60, 0.5, hash_combine(seed, 25)),
      sand_(90, size / 2, 0.75, hash_combine(seed, 26)) {}

// Small pits wherever the surface is porous, and a few deep blowholes.
double Wall::holes(double u, double v) const {
  double depth = 0;
  const double bent = 0.0035 * jag_(u, v);  // makes the holes less round
  const Spot pit = pits_(u + bent, v - bent);
  if (pit.distance < 1) depth = (0.06 + 0.14 * pit.chance) * (1 - pit.distance * pit.distance);
  const Spot blowhole = blowholes_(u + bent, v - bent);
  if (blowhole.distance < 1) {
    depth += (0.2 + 0.36 * blowhole.chance) * (1 - smoothstep(0.45, 1, blowhole.distance));
  }
  return depth;
}

double Wall::face(const Brick& brick, const Place& place, double u, double v) const {
  const double own_u = u + brick.shift_u;
  const double own_v = v + brick.shift_v;
  double h = brick.top + brick.tilt_u * place.along + brick.tilt_v * place.down;
  h += 0.06 * brick.roughness * undulation_(own_u, own_v);
  h += 0.03 * brick.roughness * grain_(own_u, own_v);
  if (brick.creases > 0) h += 0.03 * brick.creases * creases_(own_u, own_v);
  if (brick.spall < kSound) {
    const double loose = spall_(own_u, own_v) - brick.spall;
    if (loose > 0) h -= (0.12 + 0.08 * broken_(own_u, own_v)) * smoothstep(0, 0.06, loose) + 0.15 * loose;
  }
  if (brick.crack > 0) {
    const double aside = std::abs(crack_(own_u, own_v) + 0.09 * jag_(own_u, own_v));
    const double opened = brick.crack * smoothstep(-0.15, 0.25, creases_(own_v, own_u));
    h -= opened * (1 - smoothstep(0, 0.02, aside));
  }
  h -= holes(own_u, own_v);
  const double inside = -place.outside / kArris;
  if (inside < 1) {
    const double over = inside > 0 ? 1 - inside : 1;
    h -= brick.wear * (1 - std::sqrt(1 - over * over));
  }
  return place.outside > 0 ? h - kWallSlope * place.outside : h;
}

// The mortar is raked out in some places, nearly flush in others, and hollowed between the bricks. On a brick
// it thins out to nothing at kMortarEdge.
double Wall::mortar(double u, double v, double outside) const {
  const double level = 0.04 + 0.7 * smoothstep(-0.5, 0.75, filling_(u, v));
  const double hollow = outside > 0 ? (0.3 + level) * 12 * outside : -outside / kMortarEdge;
  const double texture = 0.05 * trowel_(u, v) + 0.035 * sand_(u, v);
  return level - hollow + texture - 0.5 * holes(u, v);
}

Wall::Neighbourhood Wall::bricks_near(double u, double v) const {
  Neighbourhood near;
  const int course = floor_to_int(v * kCourses);
  for (int row = course - 1; row <= course + 1; ++row) {
    const int first = (row + kCourses) % kCourses * kBricksPerCourse;
    for (int i = first; i < first + kBricksPerCourse; ++i) {
      const Brick& brick = bricks_[static_cast<std::size_t>(i)];
      const Place place = place_on(brick, u, v);
      near.outside = std::min(near.outside, place.outside);
      if (place.outside < kReach + kRaggedness && near.count < near.bricks.size()) {
        near.bricks[near.count] = &brick;
        near.places[near.count++] = place;
      }
    }
  }
  return near;
}

double Wall::height(double u, double v) const {
  Neighbourhood near = bricks_near(u + 0.004 * sag_u_(u, v), v + 0.006 * sag_v_(u, v));
  const double chip = chips_(u, v) - 0.22;
  double erosion = chip > 0 ? 0.035 * chip : 0;
  if (near.outside + erosion > -kMortarEdge) erosion += 0.003 * ragged_(u, v);
  const double outside = near.outside + erosion;
  double h = outside > -kMortarEdge ? mortar(u, v, outside) : -1;
  for (std::size_t i = 0; i < near.count; ++i) {
    near.places[i].outside += erosion;
    if (near.places[i].outside < kReach) h = smooth_max(h, face(*near.bricks[i], near.places[i], u, v), 0.03);
  }
  return h;
}

}  // namespace

Image<float> brick(int size, std::uint64_t seed) {
  const Wall wall(size, seed);
  return sample(size, [&](double u, double v) { return wall.height(u, v); });
}

}  // namespace heightlight::synth
