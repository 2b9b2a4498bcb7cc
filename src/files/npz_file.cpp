#include "files/npz_file.h"

#include <bit>
#include <cassert>

namespace heightlight {
namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

constexpr std::uint16_t kVersion = 45;  // version of zip: the first with 64-bit sizes
constexpr std::uint32_t kSeeExtra = 0xffffffff;

/// A record of consecutive little-endian fields.
class Record {
 public:
  template <class T>
  Record& add(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
    return *this;
  }
  Record& add(const std::string& text) {
    bytes_ += text;
    return *this;
  }
  void write(std::FILE* stream) const { std::fwrite(bytes_.data(), 1, bytes_.size(), stream); }

 private:
  std::string bytes_;
};

std::uint64_t position(std::FILE* stream) { return static_cast<std::uint64_t>(ftello(stream)); }

/// Adds the fields from the version to the lengths of name and extra field, which both headers of a member
/// share.
void add_facts(Record& record, std::uint32_t crc, const std::string& name, std::uint16_t extra) {
  constexpr std::uint16_t kMidnight = 0;
  constexpr std::uint16_t kFirstDay = (1 << 5) + 1;  // 1 January 1980, so that equal arrays make equal bytes
  record.add(kVersion).add<std::uint16_t>(0).add<std::uint16_t>(0).add(kMidnight).add(kFirstDay);
  record.add(crc).add(kSeeExtra).add(kSeeExtra);
  record.add(static_cast<std::uint16_t>(name.size())).add(extra);
}

/// The header of a `.npy` file, padded so that the values are aligned to 64 bytes.
std::string array_header(const std::string& type, const std::vector<std::uint64_t>& shape) {
  std::string facts = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  for (const std::uint64_t count : shape) facts += std::to_string(count) + ",";
  facts += "), }";
  constexpr std::size_t kBefore = 10;
  constexpr std::size_t kAligned = 64;
  const std::size_t length = (kBefore + facts.size() + 1 + kAligned - 1) / kAligned * kAligned - kBefore;
  facts.resize(length - 1, ' ');
  const std::string magic("\x93NUMPY\x01\x00", 8);
  return magic + static_cast<char>(length % 256) + static_cast<char>(length / 256) + facts + '\n';
}

}  // namespace

void NpzFile::begin_array(const std::string& name, const std::string& type,
                          const std::vector<std::uint64_t>& shape) {
  if (open_) end_array();
  open_ = true;
  crc_.reset();
  members_.push_back({.name = name + ".npy", .begin = position(stream_)});
  write_header(members_.back());
  const std::string header = array_header(type, shape);
  append(header.data(), header.size());
}

void NpzFile::append(const void* data, std::size_t bytes) {
  assert(open_);
  crc_.process_bytes(data, bytes);
  members_.back().size += bytes;
  std::fwrite(data, 1, bytes, stream_);
}

/// Writes the member's header again, now that the sizes are known.
void NpzFile::end_array() {
  Member& member = members_.back();
  member.crc = crc_.checksum();
  const std::uint64_t end = position(stream_);
  fseeko(stream_, static_cast<off_t>(member.begin), SEEK_SET);
  write_header(member);
  fseeko(stream_, static_cast<off_t>(end), SEEK_SET);
  open_ = false;
}

void NpzFile::write_header(const Member& member) {
  constexpr std::uint16_t kExtra = 20;
  Record record;
  record.add<std::uint32_t>(0x04034b50);
  add_facts(record, member.crc, member.name, kExtra);
  record.add(member.name);
  record.add<std::uint16_t>(1).add<std::uint16_t>(kExtra - 4).add(member.size).add(member.size);
  record.write(stream_);
}

void NpzFile::finish() {
  if (open_) end_array();
  const std::uint64_t begin = position(stream_);
  for (const Member& member : members_) {
    constexpr std::uint16_t kExtra = 28;
    Record record;
    record.add<std::uint32_t>(0x02014b50).add(kVersion);
    add_facts(record, member.crc, member.name, kExtra);
    record.add<std::uint16_t>(0).add<std::uint16_t>(0).add<std::uint16_t>(0).add<std::uint32_t>(0);
    record.add(kSeeExtra).add(member.name);
    record.add<std::uint16_t>(1).add<std::uint16_t>(kExtra - 4);
    record.add(member.size).add(member.size).add(member.begin);
    record.write(stream_);
  }
  const std::uint64_t end = position(stream_);
  const std::uint64_t count = members_.size();
  Record last;
  last.add<std::uint32_t>(0x06064b50).add<std::uint64_t>(44).add(kVersion).add(kVersion);
  last.add<std::uint32_t>(0).add<std::uint32_t>(0).add(count).add(count).add(end - begin).add(begin);
  last.add<std::uint32_t>(0x07064b50).add<std::uint32_t>(0).add(end).add<std::uint32_t>(1);
  last.add<std::uint32_t>(0x06054b50).add<std::uint16_t>(0).add<std::uint16_t>(0);
  last.add<std::uint16_t>(0xffff).add<std::uint16_t>(0xffff).add(kSeeExtra).add(kSeeExtra);
  last.add<std::uint16_t>(0);
  last.write(stream_);
}

}  // namespace heightlight
