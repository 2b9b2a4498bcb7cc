#include "io/output_file.h"

#include <cerrno>
#include <system_error>

#include "io/input_file.h"

namespace heightlight {

void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  errno = 0;
  const File file(std::fopen(path.c_str(), "wb"));
  const bool written = file && std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                       std::fflush(file.get()) == 0;  // a full disk may show only now
  if (written) return;
  const int error_number = errno == 0 ? EIO : errno;
  throw file_error(path, "cannot be written: " + std::generic_category().message(error_number));
}

}  // namespace heightlight
