#include "cli/json_place.h"

#include <cmath>

#include "files/input_file.h"
#include "files/printable.h"

namespace heightlight {

JsonPlace::JsonPlace(const nlohmann::json& value, const std::filesystem::path& file)
    : JsonPlace(value, file, "") {}

JsonPlace::JsonPlace(const nlohmann::json& value, const std::filesystem::path& file, std::string pointer)
    : value_(value), file_(file), pointer_(std::move(pointer)) {}

Error JsonPlace::error(const std::string& fault) const {
  return file_error(file_, printable((pointer_.empty() ? "/" : pointer_) + ": " + fault));
}

void JsonPlace::check_keys(const std::set<std::string>& known) const {
  for (const std::string& key : keys()) {
    if (known.contains(key)) continue;
    std::string fault = "there is no key \"";
    fault.append(key).append("\" here; known keys are ");
    for (const std::string& name : known) fault.append(name == *known.begin() ? "" : ", ").append(name);
    throw error(fault);
  }
}

std::optional<JsonPlace> JsonPlace::find(const std::string& key) const {
  const auto found = value_.find(key);
  if (found == value_.end()) return std::nullopt;
  return JsonPlace(*found, file_, pointer_ + "/" + key);
}

std::vector<std::string> JsonPlace::keys() const {
  if (!value_.is_object()) throw error("must be an object, { … }");
  std::vector<std::string> keys;
  for (const auto& [key, ignored] : value_.items()) keys.push_back(key);
  return keys;
}

std::vector<JsonPlace> JsonPlace::items() const {
  if (!value_.is_array() || value_.empty()) throw error("must be a list that is not empty, [ … ]");
  std::vector<JsonPlace> places;
  for (std::size_t i = 0; i < value_.size(); ++i) {
    places.push_back(JsonPlace(value_[i], file_, pointer_ + "/" + std::to_string(i)));
  }
  return places;
}

std::string JsonPlace::text() const {
  if (!value_.is_string()) throw error("must be a text, \"…\"");
  const auto& text = value_.get_ref<const std::string&>();
  if (text.empty() || text.find('\0') != std::string::npos) throw error("must be a text that is not empty");
  return text;
}

bool JsonPlace::flag() const {
  if (!value_.is_boolean()) throw error("must be true or false");
  return value_.get<bool>();
}

double JsonPlace::number() const {
  if (!value_.is_number() || !std::isfinite(value_.get<double>())) throw error("must be a number");
  return value_.get<double>();
}

double JsonPlace::positive_number() const {
  const double value = value_.is_number() ? number() : 0;
  if (!(value > 0)) throw error("must be a positive number");
  return value;
}

std::int64_t JsonPlace::integer(std::int64_t least, std::int64_t most) const {
  const bool fits = value_.is_number_integer() &&
                    (!value_.is_number_unsigned() || value_.get<std::uint64_t>() <= std::uint64_t{INT64_MAX});
  if (!fits || value_.get<std::int64_t>() < least || value_.get<std::int64_t>() > most) {
    throw error("must be an integer from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return value_.get<std::int64_t>();
}

}  // namespace heightlight
