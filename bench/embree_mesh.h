#pragma once

#include <embree3/rtcore.h>

#include <limits>

#include "heightlight/surface.h"
#include "visibility/ray_traversal.h"

namespace heightlight {

/// The primitives of Embree's tree. A quad is cut into the same two triangles as the surface's cell.
enum class EmbreePrimitive { triangle, quad };

/// The surface as an Embree mesh in grid coordinates: x = column, y = row, z = height × `vertical_scale`,
/// which converts heights to texels. Tracing is single-threaded.
class EmbreeMesh {
 public:
  explicit EmbreeMesh(const Surface& surface, EmbreePrimitive primitive = EmbreePrimitive::triangle,
                      RTCBuildQuality quality = RTC_BUILD_QUALITY_HIGH)
      : vertical_scale_(static_cast<float>(1 / surface.map.spacing.x)) {
    device_ = rtcNewDevice(nullptr);
    scene_ = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene_, quality);
    const bool quads = primitive == EmbreePrimitive::quad;
    RTCGeometry geometry =
        rtcNewGeometry(device_, quads ? RTC_GEOMETRY_TYPE_QUAD : RTC_GEOMETRY_TYPE_TRIANGLE);
    fill_vertices(surface, geometry);
    quads ? fill_quads(surface, geometry) : fill_triangles(surface, geometry);
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

  /// Rays `first` to `first + 7` of a bundle as a packet.
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
      packet.ray.tnear[lane] = 1e-4F;  // Embree has no other means to leave the surface on which a ray starts
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
  float vertical_scale() const { return vertical_scale_; }

 private:
  void fill_vertices(const Surface& surface, RTCGeometry geometry) const {
    const auto columns = static_cast<std::size_t>(surface.width());
    const std::size_t vertices = surface.map.height.size();
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
    for (std::size_t i = 0; i < vertices; ++i) {
      *vertex++ = static_cast<float>(i % columns);
      *vertex++ = static_cast<float>(i / columns);
      *vertex++ = surface.map.height.values[i] * vertical_scale_;
    }
  }

  static unsigned* new_indices(RTCGeometry geometry, RTCFormat format, std::size_t corners,
                               std::size_t count) {
    return static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, format,
                                                          corners * sizeof(unsigned), count));
  }

  static void fill_triangles(const Surface& surface, RTCGeometry geometry) {
    const auto columns = static_cast<unsigned>(surface.width());
    unsigned* index = new_indices(geometry, RTC_FORMAT_UINT3, 3, 2 * cell_count(surface));
    for (unsigned row = 0; row + 1 < static_cast<unsigned>(surface.height()); ++row) {
      for (unsigned column = 0; column + 1 < columns; ++column) {
        const unsigned here = row * columns + column;
        const unsigned below = here + columns;
        for (const unsigned corner : {here, here + 1, below + 1, here, below + 1, below}) *index++ = corner;
      }
    }
  }

  /// Embree cuts a quad along the diagonal from its second corner to its fourth.
  static void fill_quads(const Surface& surface, RTCGeometry geometry) {
    const auto columns = static_cast<unsigned>(surface.width());
    unsigned* index = new_indices(geometry, RTC_FORMAT_UINT4, 4, cell_count(surface));
    for (unsigned row = 0; row + 1 < static_cast<unsigned>(surface.height()); ++row) {
      for (unsigned column = 0; column + 1 < columns; ++column) {
        const unsigned here = row * columns + column;
        const unsigned below = here + columns;
        for (const unsigned corner : {here + 1, here, below, below + 1}) *index++ = corner;
      }
    }
  }

  static std::size_t cell_count(const Surface& surface) {
    return static_cast<std::size_t>(surface.cell_rows()) * static_cast<std::size_t>(surface.cell_columns());
  }

  float vertical_scale_;
  RTCDevice device_ = nullptr;
  RTCScene scene_ = nullptr;
};

}  // namespace heightlight
