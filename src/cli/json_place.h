#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "files/json_file.h"
#include "heightlight/error.h"

namespace heightlight {

/// A value somewhere in a file of JSON. Whatever is wrong with it is told in one line, which names the file
/// and the place as a JSON pointer: "study.json: /maps/2/size: …".
class JsonPlace {
 public:
  /// The whole of a file. Both must outlive all places in it.
  JsonPlace(const nlohmann::json& value, const std::filesystem::path& file);

  Error error(const std::string& fault) const;

  /// The value must be an object with no other keys than these.
  void check_keys(const std::set<std::string>& known) const;
  /// What an object holds under a key, if anything.
  std::optional<JsonPlace> find(const std::string& key) const;
  /// The keys of an object.
  std::vector<std::string> keys() const;
  /// The members of a list, which must not be empty.
  std::vector<JsonPlace> items() const;

  bool is_text() const { return value_.is_string(); }
  bool is_list() const { return value_.is_array(); }
  std::string text() const;
  bool flag() const;
  double number() const;           ///< finite
  double positive_number() const;  ///< and > 0
  std::int64_t integer(std::int64_t least, std::int64_t most) const;

 private:
  JsonPlace(const nlohmann::json& value, const std::filesystem::path& file, std::string pointer);

  const nlohmann::json& value_;
  const std::filesystem::path& file_;
  std::string pointer_;
};

}  // namespace heightlight
