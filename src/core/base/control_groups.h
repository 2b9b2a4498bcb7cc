#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What Linux's control groups (cgroups) leave to this process, in version 1, version 2 or both, wherever they
// are mounted: cgroups(7), and the kernel's admin-guide/cgroup-v1/memory and admin-guide/cgroup-v2.

namespace heightlight {

/// A mounted tree of groups, by its line of /proc/self/mountinfo.
struct GroupMount {
  std::string root;                      ///< the group that stands at the mount's point
  std::filesystem::path point;           ///< folder
  bool unified = false;                  ///< version 2, all controllers in one tree
  std::vector<std::string> controllers;  ///< version 1: those of this tree
};

/// The trees of groups among the mounts; lines that make no sense are left out.
std::vector<GroupMount> parse_group_mounts(std::string_view mountinfo);

/// The group that the process belongs to, by /proc/self/cgroup: in the tree of that controller of version 1,
/// or, where `controller` is empty, in that of version 2. Nothing where there is none.
std::optional<std::string> find_group(std::string_view groups, std::string_view controller);

/// What is left by the tightest of a process's own groups and all those above them.
struct GroupLimits {
  std::optional<std::uint64_t>
      memory;                        ///< bytes: the limit less what is in use and no cache; absent: no limit
  std::optional<double> processors;  ///< by quota of time; absent: no quota
};

/// Reads `proc/self/mountinfo`, `proc/self/cgroup` and the mounts' files, all below `root`. What cannot be
/// read or makes no sense limits nothing.
GroupLimits find_group_limits(const std::filesystem::path& root = "/");

}  // namespace heightlight
