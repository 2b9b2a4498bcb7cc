#pragma once

#include <boost/crc.hpp>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace heightlight {

/// Arrays for numpy.load, one after the other into one file: a zip archive of `.npy` files, uncompressed,
/// with 64-bit sizes (APPNOTE.TXT 6.3.10, 4.3.7 and 4.5.3; numpy's format 1.0). What has been said of an
/// array must be written before the next begins. Faults of the stream are its owner's to find.
class NpzFile {
 public:
  explicit NpzFile(std::FILE* stream) : stream_(stream) {}

  /// `name` without ".npy"; `type` as numpy has it, "<f8", "<i8", "|S3"; `shape`: of none, a scalar.
  void begin_array(const std::string& name, const std::string& type, const std::vector<std::uint64_t>& shape);

  /// The next bytes of the array.
  void append(const void* data, std::size_t bytes);

  template <class T>
  void append(const std::vector<T>& values) {
    append(values.data(), values.size() * sizeof(T));
  }

  /// The archive's directory. Nothing may follow.
  void finish();

 private:
  struct Member {
    std::string name;
    std::uint64_t begin = 0;  ///< of its header
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
