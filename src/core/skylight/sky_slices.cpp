#include "skylight/sky_slices.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "visibility/slice_integrals.h"

namespace heightlight {
namespace {

using std::numbers::pi;

/// Sums over the columns of a row up to a place, in columns, which may be fractional; the row repeats.
class RowSums {
 public:
  RowSums(const Image<Vector3>& image, int row) : sums_(static_cast<std::size_t>(image.width) + 1) {
    sums_[0].setZero();
    for (int column = 0; column < image.width; ++column) {
      const Vector3& value = image(row, column);
      const auto i = static_cast<std::size_t>(column);
      sums_[i + 1] = sums_[i] + Eigen::Vector3f(value.x, value.y, value.z).cast<double>();
    }
  }

  Eigen::Vector3d mean(double from, double to) const { return (up_to(to) - up_to(from)) / (to - from); }

 private:
  Eigen::Vector3d up_to(double place) const {
    const auto columns = static_cast<double>(sums_.size() - 1);
    const double turns = std::floor(place / columns);
    const double within = place - turns * columns;
    const auto whole = std::min(static_cast<std::size_t>(within), sums_.size() - 2);
    const double part = within - static_cast<double>(whole);
    return turns * sums_.back() + sums_[whole] + part * (sums_[whole + 1] - sums_[whole]);
  }

  std::vector<Eigen::Vector3d> sums_;
};

/// ∫ cos²θ dθ and ∫ sinθ cosθ dθ from 0 to `elevation_rad`.
Eigen::Vector2d antiderivatives(double elevation_rad) {
  const double sine = std::sin(elevation_rad);
  return {(elevation_rad + sine * std::cos(elevation_rad)) / 2, sine * sine / 2};
}

}  // namespace

std::uint64_t SkySlices::bytes(const SkyLight& sky, int azimuths) {
  const auto rows = static_cast<std::uint64_t>(sky.radiance.height) + 1;
  return static_cast<std::uint64_t>(azimuths) * rows * (sizeof(Eigen::Vector3d) + sizeof(Sums));
}

SkySlices::SkySlices(const SkyLight& sky, int azimuths) : azimuths_(azimuths), rows_(sky.radiance.height) {
  const auto rows = static_cast<std::size_t>(rows_);
  radiance_.resize(static_cast<std::size_t>(azimuths) * rows);
  sums_.resize(static_cast<std::size_t>(azimuths) * (rows + 1));
  const double columns = sky.radiance.width;
  for (std::size_t row = 0; row < rows; ++row) {
    const RowSums row_sums(sky.radiance, static_cast<int>(row));
    for (std::size_t k = 0; k < static_cast<std::size_t>(azimuths); ++k) {
      // Columns go clockwise from −y, seen from above; azimuths go counterclockwise from x.
      const double turn = (static_cast<double>(k) + 0.25) / azimuths;
      const double middle = (0.75 - turn) * columns;
      const double half = 0.5 / azimuths * columns;
      radiance_[k * rows + row] = row_sums.mean(middle - half, middle + half);
    }
  }
  for (std::size_t k = 0; k < static_cast<std::size_t>(azimuths); ++k) {
    for (std::size_t row = 0; row < rows; ++row) {
      const double upper = pi / 2 - pi * static_cast<double>(row) / rows_;
      const double lower = pi / 2 - pi * static_cast<double>(row + 1) / rows_;
      const Eigen::Vector2d integral = antiderivatives(upper) - antiderivatives(lower);
      const Eigen::Vector3d& radiance = radiance_[k * rows + row];
      const Sums& before = sums_[k * (rows + 1) + row];
      sums_[k * (rows + 1) + row + 1] = {before.cosine_squared + integral.x() * radiance,
                                         before.sine_cosine + integral.y() * radiance};
    }
  }
}

SkySlices::Sums SkySlices::above(std::size_t azimuth, double elevation_rad) const {
  const auto rows = static_cast<std::size_t>(rows_);
  const double place = (0.5 - elevation_rad / pi) * rows_;
  const auto row = static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(rows_ - 1)));
  const double upper = pi / 2 - pi * static_cast<double>(row) / rows_;
  const Eigen::Vector2d part = antiderivatives(upper) - antiderivatives(std::min(elevation_rad, upper));
  const Eigen::Vector3d& radiance = radiance_[azimuth * rows + row];
  const Sums& whole = sums_[azimuth * (rows + 1) + row];
  return {whole.cosine_squared + part.x() * radiance, whole.sine_cosine + part.y() * radiance};
}

Eigen::Vector3d SkySlices::irradiance(const Eigen::Vector3d& normal,
                                      const std::vector<double>& horizon_rad) const {
  Eigen::Vector3d received = Eigen::Vector3d::Zero();
  double hemisphere = 0;
  for (std::size_t k = 0; k < horizon_rad.size(); ++k) {
    const double azimuth = 2 * pi * (static_cast<double>(k) + 0.25) / azimuths_;
    const SliceNormal in_slice{normal.x() * std::cos(azimuth) + normal.y() * std::sin(azimuth), normal.z()};
    const double tangent = tangent_slope(in_slice);
    hemisphere += cosine_mass(in_slice, elevation_of_slope(tangent), Elevation{});
    received += from_slice(k, in_slice, std::max(std::atan(tangent), horizon_rad[k]));
  }
  return received / hemisphere;
}

}  // namespace heightlight
