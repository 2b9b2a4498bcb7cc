#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace heightlight {

/// A small classic TIFF, little-endian, in one uncompressed strip, built tag by tag (TIFF 6.0, section 2).
class TiffBytes {
 public:
  /// `format` 1 unsigned, 2 signed, 3 float; `photometric` 0 white is zero, 1 black is zero.
  template <class Sample>
  TiffBytes(std::uint16_t width, std::uint16_t height, const std::vector<Sample>& samples,
            std::uint16_t format, std::uint16_t photometric = 1)
      : samples_(reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(Sample)) {
    add_shorts(256, {width});
    add_shorts(257, {height});
    add_shorts(258, {static_cast<std::uint16_t>(8 * sizeof(Sample))});
    add_shorts(259, {1});
    add_shorts(262, {photometric});
    add(273, 4, 1, number<std::uint32_t>(8));
    add_shorts(277, {1});
    add_shorts(278, {height});
    add(279, 4, 1, number<std::uint32_t>(static_cast<std::uint32_t>(samples_.size())));
    add_shorts(339, {format});
  }

  /// Tags come in rising order.
  TiffBytes& add_shorts(std::uint16_t tag, const std::vector<std::uint16_t>& values) {
    std::string data;
    for (const std::uint16_t value : values) data += number(value);
    return add(tag, 3, static_cast<std::uint32_t>(values.size()), data);
  }
  TiffBytes& add_doubles(std::uint16_t tag, const std::vector<double>& values) {
    std::string data;
    for (const double value : values) data += number(value);
    return add(tag, 12, static_cast<std::uint32_t>(values.size()), data);
  }
  TiffBytes& add_text(std::uint16_t tag, const std::string& text) {
    return add(tag, 2, static_cast<std::uint32_t>(text.size() + 1), text + '\0');
  }

  std::string bytes() const {
    const std::string padded = samples_ + std::string(samples_.size() % 2, '\0');
    const auto directory = static_cast<std::uint32_t>(8 + padded.size());
    std::uint32_t beyond = directory + 2 + 12 * static_cast<std::uint32_t>(tags_.size()) + 4;
    std::string entries;
    std::string apart;
    for (const Tag& tag : tags_) {
      entries += number(tag.tag) + number(tag.type) + number(tag.count);
      if (tag.data.size() <= 4) {
        entries += tag.data + std::string(4 - tag.data.size(), '\0');
      } else {
        entries += number(static_cast<std::uint32_t>(beyond + apart.size()));
        apart += tag.data + std::string(tag.data.size() % 2, '\0');
      }
    }
    return "II" + number<std::uint16_t>(42) + number(directory) + padded +
           number(static_cast<std::uint16_t>(tags_.size())) + entries + std::string(4, '\0') + apart;
  }

 private:
  struct Tag {
    std::uint16_t tag;
    std::uint16_t type;
    std::uint32_t count;
    std::string data;
  };

  template <class T>
  static std::string number(T value) {
    std::string data(sizeof(T), '\0');
    std::memcpy(data.data(), &value, sizeof(T));
    return data;
  }

  TiffBytes& add(std::uint16_t tag, std::uint16_t type, std::uint32_t count, std::string data) {
    tags_.push_back({tag, type, count, std::move(data)});
    return *this;
  }

  std::string samples_;
  std::vector<Tag> tags_;
};

}  // namespace heightlight
