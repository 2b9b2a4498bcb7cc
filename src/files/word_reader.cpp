#include "files/word_reader.h"

#include <algorithm>

#include "files/named.h"

namespace heightlight {
namespace {

constexpr std::size_t kLongestWord = 1 << 16;

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

WordReader::WordReader(const InputFile& file) : file_(file), stream_(file.rewound()), block_(1 << 20) {
  refill();
  if (std::string_view(block_.data(), end_).starts_with(kByteOrderMark)) begin_ = kByteOrderMark.size();
}

Error WordReader::error(const std::string& fault) const {
  return file_.error("line " + std::to_string(line_) + ": " + fault);
}

bool WordReader::refill() {
  std::copy(block_.begin() + static_cast<std::ptrdiff_t>(begin_),
            block_.begin() + static_cast<std::ptrdiff_t>(end_), block_.begin());
  end_ -= begin_;
  begin_ = 0;
  const std::size_t got = std::fread(block_.data() + end_, 1, block_.size() - end_, stream_);
  if (std::ferror(stream_)) throw file_.error("cannot be read to its end");
  end_ += got;
  return got > 0;
}

std::string_view WordReader::next() {
  do {
    for (; begin_ < end_ && is_space(block_[begin_]); ++begin_) line_ += block_[begin_] == '\n' ? 1 : 0;
  } while (begin_ == end_ && refill());

  std::size_t length = 0;
  do {
    while (begin_ + length < end_ && !is_space(block_[begin_ + length])) ++length;
    if (length > kLongestWord) throw error("is not text that a grid is made of");
  } while (begin_ + length == end_ && refill());
  const std::string_view word(block_.data() + begin_, length);
  begin_ += length;
  return word;
}

}  // namespace heightlight
