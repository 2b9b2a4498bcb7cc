#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace heightlight {

/// Something could not be done: a bad file, a full disk, too little memory. The message is one line that
/// names the object and the fault. The command line prints it and exits with 1.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;

  /// `help` names a quantity that would help, perhaps with a value for it: "memory 8M", "channel".
  Error(const std::string& message, std::string help)
      : std::runtime_error(message), remedy(std::move(help)) {}

  /// A quantity that would help, as the constructor says; empty where none is known. The command line prints
  /// the option of that name.
  std::string remedy;
};

/// The request itself makes no sense (an albedo of 2, zero rays). The command line exits with 2.
struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(message) {}

  /// Makes the message "azimuths 7: must be even": the name of the quantity (letters and _), its value, and
  /// the fault. The command line, whose options have such names, puts dashes before it.
  UsageError(const std::string& name, const std::string& value, const std::string& fault)
      : Error(name + (value.empty() ? "" : " " + value) + ": " + fault), quantity(name) {}

  std::string quantity;  ///< name of the quantity; empty where the message does not begin with one
};

/// The request needs more memory than is allowed. None of that memory has been allocated.
struct MemoryError : Error {
  /// `more`: bytes beyond the limit that would have to be allowed. `enough`: the whole limit that would do,
  /// such as "412M", where the thrower knows it.
  MemoryError(const std::string& message, std::uint64_t more, const std::string& enough = "")
      : Error(message, enough.empty() ? "memory" : "memory " + enough), missing(more) {}

  std::uint64_t missing;
};

/// A result could not be written: a full disk, an unwritable folder, something else in its place.
struct OutputError : Error {
  using Error::Error;
};

/// The work was stopped because Watch::stopped returned true. The command line, where signals cause this,
/// exits with 128 + signal.
struct Cancelled : Error {
  Cancelled() : Error("interrupted") {}
};

}  // namespace heightlight
