#include "io/output_file.h"

#include <cerrno>
#include <system_error>

#include "io/input_file.h"

namespace heightlight {

void write_file(const std::filesystem::path& path, const std::function<void(std::FILE*)>& write) {
  const auto fail = [&path](int error_number) {
    throw file_error(path, "cannot be written: " + std::generic_category().message(error_number));
  };
  errno = 0;
  const File file(std::fopen(path.c_str(), "wb"));
  if (!file) fail(errno);
  write(file.get());
  // A full disk may show only when the last bytes leave the buffer.
  if (std::fflush(file.get()) != 0 || std::ferror(file.get())) fail(errno == 0 ? EIO : errno);
}

void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  write_file(path, [bytes](std::FILE* stream) { std::fwrite(bytes.data(), 1, bytes.size(), stream); });
}

}  // namespace heightlight
