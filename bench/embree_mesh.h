#pragma once

#include <embree3/rtcore.h>

#include "heightlight/surface.h"
#include "visibility/ray_traversal.h"

namespace heightlight {

/// The surface as a triangle mesh in Embree, in grid coordinates: x = column, y = row, z = height ×
/// `vertical_scale`, which makes heights comparable with texels. Single-threaded at tracing; built as well as
/// Embree can.
class EmbreeMesh {
 public:
  explicit EmbreeMesh(const Surface& surface)
      : vertical_scale_(static_cast<float>(1 / surface.map.spacing.x)) {
    device_ = rtcNewDevice(nullptr);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto columns = static_cast<std::size_t>(surface.width());
    const auto rows = static_cast<std::size_t>(surface.height());
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), rows * columns));
    auto* index =
        static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                       3 * sizeof(unsigned), 2 * (rows - 1) * (columns - 1)));
    for (std::size_t i = 0; i < rows * columns; ++i) {
      *vertex++ = static_cast<float>(i % columns);
      *vertex++ = static_cast<float>(i / columns);
      *vertex++ = surface.map.height.values[i] * vertical_scale_;
    }
    for (std::size_t row = 0; row + 1 < rows; ++row) {
      for (std::size_t column = 0; column + 1 < columns; ++column) {
        const auto here = static_cast<unsigned>(row * columns + column);
        const auto below = here + static_cast<unsigned>(columns);
        for (const unsigned corner : {here, here + 1, below + 1, here, below + 1, below}) *index++ = corner;
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeMesh() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeMesh(const EmbreeMesh&) = delete;
  EmbreeMesh& operator=(const EmbreeMesh&) = delete;

  /// Eight rays of a bundle as a packet.
  RTCRayHit8 packet(const RayBundle& bundle, int first) const {
    RTCRayHit8 packet;
    for (int lane = 0; lane < 8; ++lane) {
      const int ray = first + lane;
      packet.ray.org_x[lane] = static_cast<float>(bundle.column);
      packet.ray.org_y[lane] = static_cast<float>(bundle.row);
      packet.ray.org_z[lane] = bundle.height * vertical_scale_;
      packet.ray.dir_x[lane] = bundle.step_u[ray];
      packet.ray.dir_y[lane] = bundle.step_v[ray];
      packet.ray.dir_z[lane] = bundle.slope[ray] * vertical_scale_;
      packet.ray.tnear[lane] = 1e-4F;  // Embree has no other way to leave the surface that a ray starts on
      packet.ray.tfar[lane] = std::numeric_limits<float>::infinity();
      packet.ray.mask[lane] = ~0U;
      packet.ray.time[lane] = 0;
      packet.ray.flags[lane] = 0;
      packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    return packet;
  }

  RTCScene scene() const { return scene_; }

 private:
  float vertical_scale_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace heightlight
