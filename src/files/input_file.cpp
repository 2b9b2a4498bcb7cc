#include "files/input_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>

namespace heightlight {

Error file_error(const std::filesystem::path& path, const std::string& fault, const std::string& remedy) {
  return Error(path.string() + ": " + fault, remedy);
}

File open_input(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (status.type() == std::filesystem::file_type::not_found) throw file_error(path, "no such file");
  if (failure) throw file_error(path, "cannot be read: " + failure.message());
  if (std::filesystem::is_directory(status)) throw file_error(path, "is a directory, not a file");
  // The content is read more than once (its format, its samples, its checksum), which a pipe does not allow.
  if (!std::filesystem::is_regular_file(status)) throw file_error(path, "is not a regular file");
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw file_error(path, std::string("cannot be read: ") + std::strerror(errno));
  if (std::filesystem::file_size(path, failure) == 0) throw file_error(path, "is empty");
  return file;
}

}  // namespace heightlight
