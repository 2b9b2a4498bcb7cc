#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>

namespace heightlight {

/// Something could not be done: a bad file, a full disk, too little memory. The message is one line that
/// names what it is about and what is wrong. The command line prints it and exits with 1.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;

  /// With a quantity that would help, and perhaps a value for it: "memory 8M", "channel".
  Error(const std::string& message, std::string help)
      : std::runtime_error(message), remedy(std::move(help)) {}

  std::string remedy;  ///< empty where none is known; the command line names its option
};

/// The request itself makes no sense (an albedo of 2, zero rays). The command line exits with 2.
struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(message) {}

  /// "azimuths 7: must be even": what is wrong with the quantity of that name (letters and _). The command
  /// line, whose options have such names, puts dashes before it.
  UsageError(const std::string& name, const std::string& value, const std::string& fault)
      : Error(name + (value.empty() ? "" : " " + value) + ": " + fault), quantity(name) {}

  std::string quantity;  ///< empty where the message names none at its beginning
};

/// The memory allowed does not hold what was asked for. Nothing of it has been taken.
struct MemoryError : Error {
  /// `more`: bytes that would have to be allowed beside those that are; `enough`: what that is in all, such
  /// as "412M", where whoever throws knows it.
  MemoryError(const std::string& message, std::uint64_t more, const std::string& enough = "")
      : Error(message, enough.empty() ? "memory" : "memory " + enough), missing(more) {}

  std::uint64_t missing;
};

/// A result could not be written: a full disk, an unwritable folder, something else in its place.
struct OutputError : Error {
  using Error::Error;
};

/// Whoever watches the work wanted it to end (Watch::stopped). The command line, to which signals say so,
/// exits with 128 + signal.
struct Cancelled : Error {
  Cancelled() : Error("interrupted") {}
};

}  // namespace heightlight
