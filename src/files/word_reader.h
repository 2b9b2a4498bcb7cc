#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "files/input_file.h"

namespace heightlight {

/// Takes a text file apart at white space, a block at a time.
class WordReader {
 public:
  /// From the file's beginning; a UTF-8 byte-order mark there is left out. The file must outlive this object.
  explicit WordReader(const InputFile& file);

  /// The next word, valid until the next call; empty at the end of the file. Throws Error for a word of more
  /// than 65536 characters, and when the file can't be read.
  std::string_view next();

  /// The line of the last word, from 1.
  std::uint64_t line() const { return line_; }

  /// "PATH: line N: FAULT".
  Error error(const std::string& fault) const;

 private:
  bool refill();

  const InputFile& file_;
  std::FILE* stream_;
  std::vector<char> block_;
  std::size_t begin_ = 0;  ///< of what is not taken yet, in block_
  std::size_t end_ = 0;
  std::uint64_t line_ = 1;
};

}  // namespace heightlight
