#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace heightlight {

/// How far one step of long work is.
struct Step {
  std::string_view name;   ///< "sky", "links", "bounces" …; valid during the call only
  std::int64_t done = 0;   ///< units of work, 0 when the step begins
  std::int64_t total = 0;  ///< all of them; 0 where nobody knows
  bool ended = false;      ///< the step is over, whether all of it was done or not
};

/// Who watches long work. Both functions may be empty, and both may be called from any thread.
struct Watch {
  std::function<void(const Step&)>
      tell;                       ///< called when a step begins, moves on or ends; never twice at once
  std::function<bool()> stopped;  ///< asked often; once it says true, the work throws Cancelled
};

}  // namespace heightlight
