#include "cli/request.h"

#include "files/image_file.h"

namespace heightlight {

nlohmann::ordered_json describe_load_options(const LoadOptions& load) {
  nlohmann::ordered_json texel = nullptr;
  if (load.texel) texel = {load.texel->x, load.texel->y};
  nlohmann::ordered_json described = {
      {"relief", or_null(load.relief)},
      {"relief_share", or_null(load.relief_share)},
      {"width", or_null(load.width)},
      {"texel", texel},
      {"boundary", load.boundary ? nlohmann::ordered_json(to_string(*load.boundary)) : nullptr},
      {"no_data", or_null(load.no_data)},
      {"part", or_null(load.part)},
      {"channel", or_null(load.channel)},
      {"shrink", load.shrink},
      {"invert", load.invert}};
  // Only where they are given: what was made before there were such options keeps its name.
  if (load.size) described["size"] = *load.size;
  if (load.big_endian) described["big_endian"] = true;
  if (load.scale) described["scale"] = *load.scale;
  if (load.offset) described["offset"] = *load.offset;
  if (load.degrees_in_metres) described["texel"] = "auto";
  if (load.curvature) described["curvature"] = *load.curvature;
  return described;
}

std::string request_key(const nlohmann::ordered_json& request) {
  return sha256_of(request.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace heightlight
