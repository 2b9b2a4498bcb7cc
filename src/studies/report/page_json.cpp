#include "report/page_json.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>

#include "report/packed_levels.h"

namespace heightlight {
namespace {

using Json = nlohmann::ordered_json;

const char* to_string(PictureKind kind) {
  switch (kind) {
    case PictureKind::light:
      return "light";
    case PictureKind::plain:
      return "plain";
    case PictureKind::error:
      return "error";
    case PictureKind::direction:
      break;
  }
  return "direction";
}

/// Five digits are more than a chart shows.
Json shown_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return std::strtod(fmt::format("{:.5g}", value).c_str(), nullptr);
}

Json describe_picture(const PagePicture& picture) {
  const Preview& preview = picture.preview;
  const int decimals = choose_decimals(preview.channels);
  Json channels = Json::array();
  for (std::size_t c = 0; c < preview.channels.size(); ++c) {
    const PackedLevels packed = pack_levels(preview.channels[c], decimals);
    channels.push_back({{"name", picture.channels.at(c)}, {"base", packed.base}, {"data", packed.data}});
  }
  return {{"name", picture.name},
          {"about", picture.about},
          {"file", picture.file},
          {"unit", picture.unit},
          {"kind", to_string(picture.kind)},
          {"width", preview.width},
          {"height", preview.height},
          {"side", preview.side},
          {"picked", preview.picked},
          {"columns", preview.channels.front().width},
          {"rows", preview.channels.front().height},
          {"decimals", decimals},
          {"channels", std::move(channels)}};
}

std::size_t packed_size(const Json& picture) {
  std::size_t size = 0;
  for (const Json& channel : picture.at("channels"))
    size += channel.at("data").get_ref<const std::string&>().size();
  return size;
}

}  // namespace

std::optional<Json> describe_group(const PictureGroup& group, std::size_t limit) {
  std::size_t size = 0;
  Json pictures = Json::array();
  for (const PagePicture& picture : group.pictures) {
    pictures.push_back(describe_picture(picture));
    size += packed_size(pictures.back());
    if (size > limit) return std::nullopt;
  }
  return Json{{"title", group.title},
              {"about", group.about},
              {"reference", group.reference ? Json(*group.reference) : Json(nullptr)},
              {"pictures", std::move(pictures)}};
}

Json describe_chart(const PageChart& chart) {
  Json curves = Json::array();
  for (const PageCurve& curve : chart.curves) {
    Json x = Json::array();
    Json y = Json::array();
    for (const auto& point : curve.points) {
      x.push_back(shown_number(point[0]));
      y.push_back(shown_number(point[1]));
    }
    curves.push_back({{"name", curve.name},
                      {"shown", curve.shown},
                      {"dashed", curve.dashed},
                      {"colour", curve.colour ? Json(*curve.colour) : Json(nullptr)},
                      {"labels", curve.labels},
                      {"x", x},
                      {"y", y}});
  }
  return {{"title", chart.title}, {"about", chart.about},     {"x", chart.x},
          {"y", chart.y},         {"log_x", chart.log_x},     {"log_y", chart.log_y},
          {"dots", chart.dots},   {"ordered", chart.ordered}, {"curves", std::move(curves)}};
}

}  // namespace heightlight
