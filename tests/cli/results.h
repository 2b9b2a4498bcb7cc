#pragma once

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scratch_folder.h"

namespace heightlight {

/// An image file as the command wrote it.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::vector<float> values;
};

inline Picture read_picture(const std::filesystem::path& path) {
  const auto file = OIIO::ImageInput::open(path.string());
  REQUIRE(file);
  const OIIO::ImageSpec& spec = file->spec();
  Picture picture{spec.width, spec.height, spec.channelnames, {}};
  picture.values.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) *
                        static_cast<std::size_t>(spec.nchannels));
  REQUIRE(file->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, picture.values.data()));
  return picture;
}

inline nlohmann::json read_summary(const std::filesystem::path& folder) {
  return nlohmann::json::parse(read_text(folder / "summary.json"));
}

/// What must hold of any map, as the command itself reports it.
inline void check_energy(const nlohmann::json& summary) {
  // Links add up to 1; walks are scaled to do so, and say what they would leave.
  const bool links = summary["links"]["count"].get<std::uint64_t>() > 0;
  CHECK(summary["energy"]["row_sum_max_error"].get<double>() <= (links ? 1e-6 : 0.5));
  CHECK(summary["energy"]["row_sum_rmse"].get<double>() <= (links ? 1e-6 : 0.08));
  CHECK(summary["energy"]["sum_max_error"].get<double>() <= 1e-5);
}

}  // namespace heightlight
