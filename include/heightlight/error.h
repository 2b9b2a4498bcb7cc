#pragma once

#include <stdexcept>
#include <string>

namespace heightlight {

/// Something could not be done: a bad file, a full disk, too little memory. The message is one line that
/// names what it is about and what is wrong. The command line prints it and exits with 1.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The request itself makes no sense (an albedo of 2, zero rays). The command line exits with 2.
struct UsageError : Error {
  using Error::Error;
};

/// A result could not be written: a full disk, an unwritable folder, something else in its place.
struct OutputError : Error {
  using Error::Error;
};

/// The user asked to stop (SIGINT, SIGTERM). The command line exits with 128 + signal.
struct Interrupted : Error {
  explicit Interrupted(int signal_number) : Error("interrupted"), signal(signal_number) {}
  int signal;
};

}  // namespace heightlight
