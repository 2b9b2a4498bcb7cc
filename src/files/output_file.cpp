#include "files/output_file.h"

#include <cerrno>
#include <system_error>

#include "files/input_file.h"
#include "files/staging_folder.h"

namespace heightlight {

OutputError output_error(const std::filesystem::path& path, const std::string& fault) {
  return OutputError(final_path(path).string() + ": cannot be written: " + fault);
}

OutputError output_error(const std::filesystem::path& path, int error_number) {
  return output_error(path, std::generic_category().message(error_number));
}

void write_file(const std::filesystem::path& path, const std::function<void(std::FILE*)>& write) {
  errno = 0;
  const File file(std::fopen(path.c_str(), "w+b"));
  if (!file) throw output_error(path, errno);
  try {
    write(file.get());
  } catch (const std::system_error& fault) {  // from formatted output
    throw output_error(path, fault.code().value());
  }
  // A full disk may show only when the last bytes are flushed.
  if (std::fflush(file.get()) != 0 || std::ferror(file.get()))
    throw output_error(path, errno == 0 ? EIO : errno);
}

void write_bytes(const std::filesystem::path& path, std::string_view bytes) {
  write_file(path, [bytes](std::FILE* stream) { std::fwrite(bytes.data(), 1, bytes.size(), stream); });
}

}  // namespace heightlight
