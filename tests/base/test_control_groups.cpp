// Control groups as a folder of files tells of them: version 1, version 2, nested, and nonsense.

#include <catch2/catch.hpp>
#include <string>

#include "base/control_groups.h"
#include "scratch_folder.h"

namespace heightlight {
namespace {

/// A machine's files.
struct FakeMachine {
  ScratchFolder folder;

  void write(const std::string& path, const std::string& text) const {
    const std::filesystem::path file = folder / path;
    std::filesystem::create_directories(file.parent_path());
    write_text(file, text);
  }
  GroupLimits limits() const { return find_group_limits(folder.path()); }
};

const std::string kUnified =
    "22 1 8:1 / / rw - ext4 /dev/sda1 rw\n"
    "30 22 0:26 / /sys/fs/cgroup rw,nosuid shared:4 - cgroup2 cgroup2 rw,nsdelegate\n";

void write_unified(const FakeMachine& machine, const std::string& group) {
  machine.write("proc/self/mountinfo", kUnified);
  machine.write("proc/self/cgroup", "0::" + group + "\n");
}

constexpr std::uint64_t kMebi = 1 << 20;

}  // namespace

TEST_CASE("version 2: the tightest of a group and all above it counts, less what is in use", "[base]") {
  const FakeMachine machine;
  write_unified(machine, "/user/job");
  CHECK(!machine.limits().memory);
  CHECK(!machine.limits().processors);
  machine.write("sys/fs/cgroup/user/job/memory.max", "1073741824\n");
  machine.write("sys/fs/cgroup/user/job/memory.high", "max\n");
  machine.write("sys/fs/cgroup/user/job/cpu.max", "350000 100000\n");
  CHECK(machine.limits().memory == 1024 * kMebi);
  CHECK(machine.limits().processors == 3.5);
  machine.write("sys/fs/cgroup/user/job/memory.current", std::to_string(300 * kMebi) + "\n");
  machine.write("sys/fs/cgroup/user/job/memory.stat", "anon 1\nfile 9\ninactive_file " +
                                                          std::to_string(150 * kMebi) + "\nactive_file " +
                                                          std::to_string(50 * kMebi) + "\n");
  CHECK(machine.limits().memory == 924 * kMebi);  // caches are given up
  machine.write("sys/fs/cgroup/user/job/memory.high", std::to_string(500 * kMebi));
  CHECK(machine.limits().memory == 400 * kMebi);
  machine.write("sys/fs/cgroup/user/memory.max", std::to_string(200 * kMebi));
  machine.write("sys/fs/cgroup/user/cpu.max", "150000 100000\n");
  CHECK(machine.limits().memory == 200 * kMebi);
  CHECK(machine.limits().processors == 1.5);
  machine.write("sys/fs/cgroup/user/memory.current", std::to_string(700 * kMebi));
  CHECK(machine.limits().memory == 0u);
}

TEST_CASE("version 1: each controller has its own tree, and its own mount", "[base]") {
  const FakeMachine machine;
  machine.write("proc/self/mountinfo",
                "35 31 0:32 / /cg/memory rw - cgroup cgroup rw,memory\n"
                "36 31 0:33 / /cg/cpu,cpuacct rw shared:9 - cgroup cgroup rw,cpu,cpuacct\n"
                "41 31 0:38 / /cg/unified rw - cgroup2 cgroup2 rw\n");
  machine.write("proc/self/cgroup", "4:memory:/a/b\n2:cpu,cpuacct:/c\n1:name=systemd:/x\n0::/\n");
  machine.write("cg/memory/a/b/memory.limit_in_bytes",
                "9223372036854771712\n");  // none, as version 1 says it
  machine.write("cg/memory/a/memory.limit_in_bytes", std::to_string(600 * kMebi) + "\n");
  machine.write("cg/memory/a/memory.usage_in_bytes", std::to_string(100 * kMebi) + "\n");
  machine.write("cg/memory/a/memory.stat",
                "inactive_file 1\ntotal_inactive_file " + std::to_string(40 * kMebi) + "\n");
  machine.write("cg/cpu,cpuacct/c/cpu.cfs_quota_us", "-1\n");
  machine.write("cg/cpu,cpuacct/c/cpu.cfs_period_us", "100000\n");
  CHECK(machine.limits().memory == 540 * kMebi);
  CHECK(!machine.limits().processors);
  machine.write("cg/cpu,cpuacct/c/cpu.cfs_quota_us", "50000\n");
  CHECK(machine.limits().processors == 0.5);
}

TEST_CASE("a container sees its group at the mount's point", "[base]") {
  const FakeMachine machine;
  machine.write("proc/self/mountinfo", "35 31 0:32 /docker/f00 /cg rw - cgroup cgroup rw,memory\n");
  machine.write("proc/self/cgroup", "4:memory:/docker/f00/inner\n");
  machine.write("cg/memory.limit_in_bytes", std::to_string(300 * kMebi));
  CHECK(machine.limits().memory == 300 * kMebi);
  machine.write("cg/inner/memory.limit_in_bytes", std::to_string(100 * kMebi));
  CHECK(machine.limits().memory == 100 * kMebi);
  machine.write("proc/self/cgroup", "4:memory:/../elsewhere\n");  // outside of the namespace
  CHECK(machine.limits().memory == 300 * kMebi);
}

TEST_CASE("what makes no sense limits nothing", "[base]") {
  CHECK(!FakeMachine().limits().memory);
  const FakeMachine machine;
  write_unified(machine, "/job");
  for (const char* text : {"", "max", "-5", "12x", "lots", "99999999999999999999999999"}) {
    machine.write("sys/fs/cgroup/job/memory.max", text);
    INFO(text);
    CHECK(!machine.limits().memory);
  }
  for (const char* text : {"", "max 100000", "100000", "x y", "100000 0", "0 100000"}) {
    machine.write("sys/fs/cgroup/job/cpu.max", text);
    INFO(text);
    CHECK(!machine.limits().processors);
  }
  machine.write("proc/self/mountinfo", "\n- - -\n1 2 3 - cgroup\n1 2 3 4 5 6 - cgroup2\n");
  machine.write("proc/self/cgroup", "0:\n:::\nmemory\n");
  CHECK(!machine.limits().memory);
  CHECK(parse_group_mounts(kUnified).size() == 1);
  CHECK(!find_group("4:memory:/a\n", ""));
  CHECK(find_group("4:cpu,memory:/a:b\n", "memory") == "/a:b");
}

}  // namespace heightlight
