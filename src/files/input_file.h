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

/// "PATH: FAULT", the form of every message about a file, with the quantity that would help if there is one.
Error file_error(const std::filesystem::path& path, const std::string& fault, const std::string& remedy = "");

/// Opens a file that holds something. Throws Error when it is missing, a directory or a device, empty or
/// unreadable.
File open_input(const std::filesystem::path& path);

/// A file that several readers read one after the other: its format, its samples, its checksum. It is opened
/// once, so that all see the same bytes, whatever takes its name meanwhile (libraries that want a name need
/// /proc for that).
class InputFile {
 public:
  /// A path stands for the file at it. Throws Error as open_input does.
  InputFile(std::filesystem::path path);  // NOLINT(google-explicit-constructor)

  const std::filesystem::path& path() const { return path_; }

  /// At the file's beginning.
  std::FILE* rewound() const;

  /// Bytes, when it was opened.
  std::uint64_t size() const { return size_; }

  /// What a library that opens files by their names is to be given: a name of the file that is open.
  std::string name_for_libraries() const;

  /// A library's message in one line, with the path where it has that name.
  std::string explain(const std::string& message) const;

  Error error(const std::string& fault, const std::string& remedy = "") const {
    return file_error(path_, fault, remedy);
  }

  /// Throws Error when something wrote into it since it was opened.
  void check_unchanged() const;

 private:
  std::filesystem::path path_;
  File file_;
  std::uint64_t size_ = 0;
  std::timespec modified_{};
};

}  // namespace heightlight
