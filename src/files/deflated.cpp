#include "files/deflated.h"

#include <zlib.h>

#include <new>

namespace heightlight {

std::string deflate_bytes(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string stream(size, '\0');
  const int fault =
      compress2(reinterpret_cast<Bytef*>(stream.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                bytes.size(), Z_DEFAULT_COMPRESSION);
  if (fault != Z_OK) throw std::bad_alloc();  // no other fault is possible
  stream.resize(size);
  return stream;
}

}  // namespace heightlight
