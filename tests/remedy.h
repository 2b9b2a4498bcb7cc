#pragma once

#include <string>

#include "heightlight/error.h"

namespace heightlight {

/// What the error that some work throws says would help; "nothing thrown" where there is none.
template <class Work>
std::string remedy_of(const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    return error.remedy;
  }
  return "nothing thrown";
}

}  // namespace heightlight
