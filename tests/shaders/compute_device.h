#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace heightlight {

/// A Vulkan device that runs compute shaders on the processor: Mesa's lavapipe.
class ComputeDevice {
 public:
  virtual ~ComputeDevice() = default;

  /// Runs the shader's main, of 64 invocations to a group, once per sample. `inputs`, `samples` times as many
  /// floats as it likes, are its binding 0; the floats returned, so many per sample, its binding 1, NaN where
  /// it wrote nothing. `samples`: a multiple of 64. Throws std::runtime_error for what Vulkan refuses.
  virtual std::vector<float> run(std::span<const std::uint32_t> spirv, std::span<const float> inputs,
                                 std::size_t samples, int floats_per_sample) = 0;
};

/// Nothing, and why, where there is none.
std::unique_ptr<ComputeDevice> open_compute_device(std::string& why_not);

}  // namespace heightlight
