#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "files/input_file.h"

namespace heightlight {

/// Splits a text file into words at white space, reading it in pieces.
class WordReader {
 public:
  /// Begins at the start of the file and skips a UTF-8 byte-order mark. The file must outlive this object.
  explicit WordReader(const InputFile& file);

  /// The next word, valid until the next call; empty at the end of the file. Throws Error for a word of more
  /// than 65536 characters, and when the file can't be read.
  std::string_view next();

  /// Line number of the last word, from 1.
  std::uint64_t line() const { return line_; }

  /// "PATH: line N: FAULT".
  Error error(const std::string& fault) const;

 private:
  bool refill();

  const InputFile& file_;
  std::FILE* stream_;
  std::vector<char> block_;
  std::size_t begin_ = 0;  ///< start of the unread part of block_
  std::size_t end_ = 0;
  std::uint64_t line_ = 1;
};

}  // namespace heightlight
