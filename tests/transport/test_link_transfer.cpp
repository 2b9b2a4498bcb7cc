#include <catch2/catch.hpp>
#include <cmath>

#include "heightlight/forms.h"
#include "heightlight/transport.h"
#include "root_mean_square.h"
#include "test_maps.h"
#include "visibility/exact_sky.h"
#include "visibility/exact_walk.h"

namespace heightlight {
namespace {

constexpr int kAzimuths = 32;

/// A with a maximum distance, by exact walks, which share no code with links.
Map sky_within(const Surface& surface, const MaximumDistance& maximum_distance) {
  const ExactWalker walker(surface, kAzimuths);
  Map sky(surface.width(), surface.height());
  for (int row = 0; row < surface.height(); ++row) {
    for (int column = 0; column < surface.width(); ++column)
      sky(row, column) =
          static_cast<float>(find_exact_sky(walker, row, column, maximum_distance).sky_view_factor);
  }
  return sky;
}

double rms_apart(const Map& a, const Map& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double{a.values[i]} - double{b.values[i]}, 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

TEST_CASE("obscurance from links is the sky within a reach, and W is equation 12 of it at one albedo",
          "[transport][transfer]") {
  const Boundary boundary = GENERATE(Boundary::tile, Boundary::open);
  const Falloff falloff = GENERATE(Falloff::linear, Falloff::root, Falloff::exponential);
  const Surface surface = build_surface(make_synth_map("fbm", 40, boundary, 0.3));
  const FormFactors links = build_exact_form_factors(surface, kAzimuths, {});
  const MaximumDistance maximum_distance{.distance = 0.3, .falloff = falloff};
  const AmbientTransfer found =
      find_ambient_transfer(surface, links, maximum_distance, {.constant = {0.7, 0.2}});
  // discretisation: a link stands for all of a stretch, and the receiver's own facet, which walks take to be
  // hit at once, is seen half a texel away
  CHECK(rms_apart(found.obscurance, sky_within(surface, maximum_distance)) < 0.03);
  REQUIRE(found.transfer.size() == 2);
  double darkest = 1;
  for (std::size_t i = 0; i < found.obscurance.size(); ++i) {
    const double open = double{found.obscurance.values[i]};
    darkest = std::min(darkest, open);
    REQUIRE(open >= double{links.sky_view_factor.values[i]} - 1e-6);
    REQUIRE(double{found.transfer[0].values[i]} ==
            Approx(uniform_neighbourhood(SkyViewFactor(open), 0.7)).margin(2e-6));
    REQUIRE(double{found.transfer[1].values[i]} ==
            Approx(uniform_neighbourhood(SkyViewFactor(open), 0.2)).margin(2e-6));
  }
  CHECK(darkest < 0.8);
}

TEST_CASE("obscurance from links converges to that of exact profiles", "[transport][transfer]") {
  const MaximumDistance maximum_distance{.distance = 0.3, .falloff = Falloff::root};
  const auto error_at = [&](int side) {
    const Surface surface = build_surface(make_map(side, side, Boundary::tile, [side](int row, int column) {
      const double turn = 4 * std::acos(-1) / side;
      return 0.1 * std::sin(turn * column) * std::cos(turn * row);
    }));
    const FormFactors links = build_exact_form_factors(surface, kAzimuths, {});
    return rms_apart(find_ambient_transfer(surface, links, maximum_distance, {.constant = {0.5}}).obscurance,
                     sky_within(surface, maximum_distance));
  };
  const double coarse = error_at(24);
  const double fine = error_at(48);
  INFO(coarse << ", " << fine);
  CHECK(fine < 0.7 * coarse);
  CHECK(fine < 0.01);
}

TEST_CASE("an albedo given as a map is read where it is seen", "[transport][transfer]") {
  const Surface surface = build_surface(make_synth_map("fbm", 32, Boundary::tile, 0.3));
  const FormFactors links = build_exact_form_factors(surface, kAzimuths, {});
  const MaximumDistance maximum_distance{.distance = 0.4, .falloff = Falloff::root};
  const AmbientTransfer constant =
      find_ambient_transfer(surface, links, maximum_distance, {.constant = {0.5}});
  TexelVector same(surface.map.height.size(), 0.5);
  const AmbientTransfer mapped = find_ambient_transfer(surface, links, maximum_distance, {.varying = {same}});
  CHECK(rms_apart(constant.transfer[0], mapped.transfer[0]) < 1e-6);
  // White on the left, black on the right: between, what is seen of either.
  TexelVector halves(same.size());
  for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = i % 32 < 16 ? 1 : 0;
  const AmbientTransfer split =
      find_ambient_transfer(surface, links, maximum_distance, {.varying = {halves}});
  const AmbientTransfer black = find_ambient_transfer(surface, links, maximum_distance, {.constant = {0}});
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) {
      REQUIRE(split.transfer[0](row, column) >= black.transfer[0](row, column) - 1e-6F);
      REQUIRE(split.transfer[0](row, column) <= 1 + 1e-6F);
    }
  }
  double left = 0;
  double right = 0;
  for (int row = 0; row < 32; ++row) {
    for (int k = 0; k < 8; ++k) {
      left += double{split.transfer[0](row, 4 + k) - black.transfer[0](row, 4 + k)};
      right += double{split.transfer[0](row, 20 + k) - black.transfer[0](row, 20 + k)};
    }
  }
  CHECK(left > 3 * right);
}

TEST_CASE("a reach that ends at once leaves all open, one without falloff and end is A",
          "[transport][transfer]") {
  const Surface surface = build_surface(make_synth_map("brick", 32, Boundary::open, 0.2));
  const FormFactors links = build_exact_form_factors(surface, kAzimuths, {});
  const AmbientTransfer near = find_ambient_transfer(
      surface, links, {.distance = 1e-6, .falloff = Falloff::none}, {.constant = {0.5}});
  const AmbientTransfer whole =
      find_ambient_transfer(surface, links, {.distance = 1e6, .falloff = Falloff::none}, {.constant = {0.5}});
  for (std::size_t i = 0; i < surface.map.height.size(); ++i) {
    REQUIRE(near.obscurance.values[i] > 0.9F);  // the receiver's own facet is hit at once
    REQUIRE(whole.obscurance.values[i] == Approx(links.sky_view_factor.values[i]).margin(1e-6));
  }
}

}  // namespace heightlight
