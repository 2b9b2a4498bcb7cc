#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// What Linux's control groups (cgroups) leave to this process. Both version 1 and version 2 are read,
// wherever they are mounted: see cgroups(7), and the kernel's admin-guide/cgroup-v1/memory and
// admin-guide/cgroup-v2.

namespace heightlight {

/// A mounted tree of groups, as described by its line of /proc/self/mountinfo.
struct GroupMount {
  std::string root;                      ///< the group that stands at the mount point
  std::filesystem::path point;           ///< folder of the mount point
  bool unified = false;                  ///< version 2, all controllers in one tree
  std::vector<std::string> controllers;  ///< version 1: the controllers of this tree
};

/// The trees of groups among the mounts. Lines that make no sense are left out.
std::vector<GroupMount> parse_group_mounts(std::string_view mountinfo);

/// The group that the process belongs to, from the text of /proc/self/cgroup. `controller` names the tree of
/// version 1; an empty `controller` means the tree of version 2. Nothing where there is no such group.
std::optional<std::string> find_group(std::string_view groups, std::string_view controller);

/// What the tightest limits leave, among a process's own groups and all groups above them.
struct GroupLimits {
  std::optional<std::uint64_t>
      memory;  ///< bytes: the limit less what is in use, caches not counted; absent: no limit
  std::optional<double> processors;  ///< number of processors by the quota of time; absent: no quota
};

/// Reads `proc/self/mountinfo`, `proc/self/cgroup` and the mounts' files, all below `root`. A file that
/// cannot be read or makes no sense sets no limit.
GroupLimits find_group_limits(const std::filesystem::path& root = "/");

}  // namespace heightlight
