#pragma once

#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>

#include "heightlight/error.h"

namespace heightlight {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

using File = std::unique_ptr<std::FILE, CloseFile>;

/// "PATH: FAULT", the form of every message about a file; `remedy` is the quantity that would help, if any.
Error file_error(const std::filesystem::path& path, const std::string& fault, const std::string& remedy = "");

/// Opens a file that must not be empty. Throws Error when it is missing, a directory or a device, empty or
/// unreadable.
File open_input(const std::filesystem::path& path);

/// A file that several readers read one after the other: for its format, its samples, its checksum. It is
/// opened once, so that all readers see the same bytes even if another file takes its name meanwhile
/// (libraries that need a name require /proc for that).
class InputFile {
 public:
  /// Converts implicitly from the path of the file. Throws Error as open_input does.
  InputFile(std::filesystem::path path);  // NOLINT(google-explicit-constructor)

  const std::filesystem::path& path() const { return path_; }

  /// The stream, positioned at the file's beginning.
  std::FILE* rewound() const;

  /// Size in bytes at the time of opening.
  std::uint64_t size() const { return size_; }

  /// A name of the open file, for libraries that open files by name.
  std::string name_for_libraries() const;

  /// A library's message on one line, with the file's own name in place of name_for_libraries().
  std::string explain(const std::string& message) const;

  Error error(const std::string& fault, const std::string& remedy = "") const {
    return file_error(path_, fault, remedy);
  }

  /// Throws Error when the file was written to since it was opened.
  void check_unchanged() const;

 private:
  std::filesystem::path path_;
  File file_;
  std::uint64_t size_ = 0;
  std::timespec modified_{};
};

}  // namespace heightlight
