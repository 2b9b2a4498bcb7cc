#include "base/control_groups.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <sstream>

namespace heightlight {
namespace {

std::string read_all(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::string> split(std::string_view text, char between) {
  std::vector<std::string> parts;
  std::istringstream stream{std::string(text)};
  for (std::string part; std::getline(stream, part, between);) parts.push_back(part);
  return parts;
}

/// The whole number with which the text begins; nothing for "max", -1 and anything else.
std::optional<std::uint64_t> parse_amount(std::string_view text) {
  std::uint64_t value = 0;
  const auto [stop, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool ends = stop == text.data() + text.size() || *stop == '\n' || *stop == ' ';
  return fault == std::errc() && ends ? std::optional(value) : std::nullopt;
}

std::optional<std::uint64_t> read_amount(const std::filesystem::path& path) {
  return parse_amount(read_all(path));
}

/// The amount after a key in a file such as memory.stat; 0 where the key is not there.
std::uint64_t amount_of(const std::string& statistics, const std::string& key) {
  for (const std::string& line : split(statistics, '\n')) {
    if (line.starts_with(key + " ")) return parse_amount(line.substr(key.size() + 1)).value_or(0);
  }
  return 0;
}

template <class T>
void tighten(std::optional<T>& least, const std::optional<T>& value) {
  if (value && (!least || *value < *least)) least = value;
}

/// What a limit leaves beside what is in use. Memory that only caches files counts as left: the kernel frees
/// it on demand.
std::uint64_t left_of(std::uint64_t limit, std::uint64_t used, std::uint64_t cached) {
  const std::uint64_t held = used - std::min(used, cached);
  return limit - std::min(limit, held);
}

std::optional<std::uint64_t> memory_left(const std::filesystem::path& group, bool unified) {
  std::optional<std::uint64_t> limit =
      read_amount(group / (unified ? "memory.max" : "memory.limit_in_bytes"));
  if (unified) tighten(limit, read_amount(group / "memory.high"));
  if (!limit) return {};
  const std::uint64_t used =
      read_amount(group / (unified ? "memory.current" : "memory.usage_in_bytes")).value_or(0);
  const std::string statistics = read_all(group / "memory.stat");
  const std::string all = unified ? "" : "total_";
  return left_of(*limit, used,
                 amount_of(statistics, all + "inactive_file") + amount_of(statistics, all + "active_file"));
}

std::optional<double> processors(const std::filesystem::path& group, bool unified) {
  std::optional<std::uint64_t> quota;
  std::optional<std::uint64_t> period;
  if (unified) {
    const std::string both = read_all(group / "cpu.max");
    const std::size_t between = both.find(' ');  // "200000 100000", or "max 100000"
    quota = parse_amount(both);
    if (between != std::string::npos) period = parse_amount(both.substr(between + 1));
  } else {
    quota = read_amount(group / "cpu.cfs_quota_us");
    period = read_amount(group / "cpu.cfs_period_us");
  }
  if (!quota || !period || *quota == 0 || *period == 0) return {};
  return static_cast<double>(*quota) / static_cast<double>(*period);
}

/// Folders in the mount for a group and the groups above it, as far as the mount shows them. A container may
/// see its own group at the mount point; the group's name is then one from outside that leads nowhere.
std::vector<std::filesystem::path> folders_of(const std::filesystem::path& root, const GroupMount& mount,
                                              std::string group) {
  if (mount.root != "/" && group.starts_with(mount.root)) group.erase(0, mount.root.size());
  const std::filesystem::path top = root / mount.point.relative_path();
  std::vector<std::filesystem::path> folders{top};
  std::filesystem::path folder = top;
  for (const std::string& name : split(group, '/')) {
    if (name.empty()) continue;
    if (name == "..") break;  // outside what the group's namespace shows
    folder /= name;
    folders.push_back(folder);
  }
  return folders;
}

bool has_controller(const GroupMount& mount, const std::string& controller) {
  return std::find(mount.controllers.begin(), mount.controllers.end(), controller) != mount.controllers.end();
}

}  // namespace

std::vector<GroupMount> parse_group_mounts(std::string_view mountinfo) {
  // "35 31 0:32 / /sys/fs/cgroup/memory rw,relatime shared:9 - cgroup cgroup rw,memory"
  constexpr std::size_t kRoot = 3;
  constexpr std::size_t kPoint = 4;
  std::vector<GroupMount> mounts;
  for (const std::string& line : split(mountinfo, '\n')) {
    const std::vector<std::string> words = split(line, ' ');
    const auto dash = std::find(words.begin(), words.end(), "-");
    if (words.size() <= kPoint || std::distance(dash, words.end()) < 4) continue;
    const std::string& type = dash[1];
    if (type != "cgroup" && type != "cgroup2") continue;
    GroupMount mount{
        .root = words[kRoot], .point = words[kPoint], .unified = type == "cgroup2", .controllers = {}};
    if (!mount.unified) mount.controllers = split(dash[3], ',');
    mounts.push_back(std::move(mount));
  }
  return mounts;
}

std::optional<std::string> find_group(std::string_view groups, std::string_view controller) {
  for (const std::string& line : split(groups, '\n')) {  // "4:memory:/path", "0::/path"
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::vector<std::string> names = split(controllers, ',');
    const bool fits = controller.empty() ? controllers.empty()
                                         : std::find(names.begin(), names.end(), controller) != names.end();
    if (fits) return line.substr(second + 1);
  }
  return {};
}

GroupLimits find_group_limits(const std::filesystem::path& root) {
  const std::string groups = read_all(root / "proc/self/cgroup");
  GroupLimits limits;
  for (const GroupMount& mount : parse_group_mounts(read_all(root / "proc/self/mountinfo"))) {
    for (const std::string controller : {"memory", "cpu"}) {
      if (!mount.unified && !has_controller(mount, controller)) continue;
      const std::optional<std::string> group = find_group(groups, mount.unified ? "" : controller);
      for (const std::filesystem::path& folder : folders_of(root, mount, group.value_or("/"))) {
        if (controller == "memory") {
          tighten(limits.memory, memory_left(folder, mount.unified));
        } else {
          tighten(limits.processors, processors(folder, mount.unified));
        }
      }
    }
  }
  return limits;
}

}  // namespace heightlight
