#pragma once

#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

#include "files/input_file.h"
#include "files/named.h"

namespace heightlight {

/// Reads the lines of a text file one after the other. Long lines are an error, so that a file that is not
/// text is rejected early.
class LineReader {
 public:
  explicit LineReader(const InputFile& file) : file_(file), stream_(file.rewound()) {}

  /// The next line without its end; a byte-order mark before the first line is dropped. Empty at the end of
  /// the file. Throws Error naming the file and the line.
  std::optional<std::string_view> next() {
    if (!std::fgets(buffer_.data(), static_cast<int>(buffer_.size()), stream_)) {
      if (std::ferror(stream_)) throw file_.error("cannot be read to its end");
      return std::nullopt;
    }
    ++line_;
    std::string_view line = buffer_.data();
    if (!line.ends_with('\n') && line.size() + 1 == buffer_.size())
      throw error("longer than any line should be");
    if (line_ == 1) refuse_utf16(file_.path(), line);
    if (line_ == 1 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
    while (line.ends_with('\n') || line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  Error error(const std::string& fault) const {
    return file_.error("line " + std::to_string(line_) + ": " + fault);
  }

 private:
  const InputFile& file_;
  std::FILE* stream_;
  std::array<char, 65536> buffer_{};
  std::size_t line_ = 0;
};

}  // namespace heightlight
