#pragma once

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

namespace heightlight {

/// Writes samples (channels interleaved) as they are, through OpenImageIO, in the format that the extension
/// names. `stored` is the sample type of the file where it differs from T.
template <class T>
std::filesystem::path write_samples(const std::filesystem::path& path, int width, int height,
                                    const std::vector<std::string>& channels, const std::vector<T>& samples,
                                    OIIO::TypeDesc stored = OIIO::BaseTypeFromC<T>::value) {
  OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), stored);
  spec.channelnames = channels;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i] == "A") spec.alpha_channel = static_cast<int>(i);
  }
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const auto output = OIIO::ImageOutput::create(path.string());
  REQUIRE(output);
  REQUIRE(samples.size() == spec.image_pixels() * channels.size());
  REQUIRE(output->open(path.string(), spec));
  REQUIRE(output->write_image(OIIO::BaseTypeFromC<T>::value, samples.data()));
  REQUIRE(output->close());
  return path;
}

}  // namespace heightlight
