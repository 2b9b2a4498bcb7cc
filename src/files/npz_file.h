#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace heightlight {

/// Writes arrays for numpy.load, one after the other, into one file: a zip archive of uncompressed `.npy`
/// files with 64-bit sizes (APPNOTE.TXT 6.3.10, 4.3.7 and 4.5.3; numpy's format 1.0). All bytes that an
/// array's shape and type announce must be written before the next array begins. Write errors are not
/// reported here; the owner of the stream must check it.
class NpzFile {
 public:
  explicit NpzFile(std::FILE* stream) : stream_(stream) {}

  /// Begins an array. `name` is without ".npy"; `type` is in numpy's notation: "<f8", "<i8", "|S3"; an empty
  /// `shape` means a scalar.
  void begin_array(const std::string& name, const std::string& type, const std::vector<std::uint64_t>& shape);

  /// Appends the next bytes of the current array.
  void append(const void* data, std::size_t bytes);

  template <class T>
  void append(const std::vector<T>& values) {
    append(values.data(), values.size() * sizeof(T));
  }

  /// Writes the archive's directory. Nothing may follow.
  void finish();

 private:
  struct Member {
    std::string name;
    std::uint64_t begin = 0;  ///< offset of the member's header in the file, in bytes
    std::uint64_t size = 0;
    std::uint32_t crc = 0;
  };

  void end_array();
  void write_header(const Member& member);

  std::FILE* stream_;
  std::vector<Member> members_;
  bool open_ = false;
  boost::crc_32_type crc_;
};

}  // namespace heightlight
