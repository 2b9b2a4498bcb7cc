#include "files/input_file.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "files/printable.h"

namespace heightlight {

Error file_error(const std::filesystem::path& path, const std::string& fault, const std::string& remedy) {
  return Error(path.string() + ": " + printable(fault), remedy);  // the fault may quote content of the file
}

File open_input(const std::filesystem::path& path) {
  std::error_code failure;
  const std::filesystem::file_status status = std::filesystem::status(path, failure);
  if (status.type() == std::filesystem::file_type::not_found) throw file_error(path, "no such file");
  if (failure) throw file_error(path, "cannot be read: " + failure.message());
  if (std::filesystem::is_directory(status)) throw file_error(path, "is a directory, not a file");
  // The content is read several times (format, samples, checksum), which a pipe does not allow.
  if (!std::filesystem::is_regular_file(status)) throw file_error(path, "is not a regular file");
  File file(std::fopen(path.c_str(), "rbe"));
  if (!file) throw file_error(path, std::string("cannot be read: ") + std::strerror(errno));
  if (std::filesystem::file_size(path, failure) == 0) throw file_error(path, "is empty");
  return file;
}

InputFile::InputFile(std::filesystem::path path) : path_(std::move(path)), file_(open_input(path_)) {
  struct stat status {};
  if (fstat(fileno(file_.get()), &status) != 0)
    throw error(std::string("cannot be read: ") + std::strerror(errno));
  size_ = static_cast<std::uint64_t>(status.st_size);
  modified_ = status.st_mtim;
}

std::FILE* InputFile::rewound() const {
  std::rewind(file_.get());
  return file_.get();
}

std::string InputFile::name_for_libraries() const {
  std::string name = "/proc/self/fd/" + std::to_string(fileno(file_.get()));
  std::error_code ignored;
  return std::filesystem::exists(name, ignored) ? name : path_.string();
}

std::string InputFile::explain(const std::string& message) const {
  if (message.empty()) return "damaged or truncated";
  std::string line = message.substr(0, message.find('\n'));
  const std::string name = name_for_libraries();
  for (std::size_t at = line.find(name); at != std::string::npos; at = line.find(name, at + 1))
    line.replace(at, name.size(), path_.filename().string());
  return line;
}

void InputFile::check_unchanged() const {
  struct stat status {};
  const bool same = fstat(fileno(file_.get()), &status) == 0 &&
                    static_cast<std::uint64_t>(status.st_size) == size_ &&
                    status.st_mtim.tv_sec == modified_.tv_sec && status.st_mtim.tv_nsec == modified_.tv_nsec;
  if (!same) throw error("was written to while it was read");
}

}  // namespace heightlight
