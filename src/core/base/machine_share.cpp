#include "base/machine_share.h"

#include <omp.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

#include "base/control_groups.h"

namespace heightlight {
namespace {

/// What the process takes, from /proc/self/statm.
struct ProcessSize {
  std::uint64_t addresses = 0;  ///< bytes, as are the others
  std::uint64_t resident = 0;
  std::uint64_t data = 0;
};

ProcessSize process_size() {
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  std::ifstream stream("/proc/self/statm");
  std::uint64_t addresses = 0;
  std::uint64_t resident = 0;
  std::uint64_t shared = 0;
  std::uint64_t text = 0;
  std::uint64_t libraries = 0;
  std::uint64_t data = 0;
  stream >> addresses >> resident >> shared >> text >> libraries >> data;
  return {addresses * page, resident * page, data * page};
}

/// Bytes available on the whole machine, by the kernel's own estimate.
std::uint64_t available_on_machine() {
  std::ifstream meminfo("/proc/meminfo");
  for (std::string key; meminfo >> key;) {
    std::uint64_t kibibytes = 0;
    if (key == "MemAvailable:" && meminfo >> kibibytes) return kibibytes * 1024;
    meminfo.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// What a limit of the process leaves beside what is in use; nothing where there is no limit.
std::optional<std::uint64_t> left_of(__rlimit_resource resource, std::uint64_t used) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return {};
  return limit.rlim_cur - std::min<std::uint64_t>(limit.rlim_cur, used);
}

std::uint64_t stack_bytes() {
  pthread_attr_t attributes;
  std::size_t bytes = 0;
  if (pthread_getattr_default_np(&attributes) != 0) return 0;
  pthread_attr_getstacksize(&attributes, &bytes);
  pthread_attr_destroy(&attributes);
  return bytes;
}

/// Two stacks per thread: one is for the OpenMP thread, the other for a thread of a library that compresses
/// beside it.
std::uint64_t bytes_of_stacks(int threads) { return 2 * stack_bytes() * static_cast<std::uint64_t>(threads); }

}  // namespace

std::uint64_t resident_memory() { return process_size().resident; }

std::uint64_t default_memory(int threads) {
  const ProcessSize size = process_size();
  std::uint64_t bytes = available_on_machine();
  if (const std::optional<std::uint64_t> left = find_group_limits().memory) bytes = std::min(bytes, *left);
  for (const auto& left : {left_of(RLIMIT_AS, size.addresses), left_of(RLIMIT_DATA, size.data)}) {
    if (left) bytes = std::min(bytes, *left - std::min(*left, bytes_of_stacks(threads)));
  }
  return bytes / 5 * 4;
}

std::optional<int> parse_thread_setting(const char* text) {
  if (!text) return {};
  while (*text == ' ') ++text;
  int threads = 0;
  const auto [stop, fault] = std::from_chars(text, text + std::strlen(text), threads);
  const bool ends = *stop == '\0' || *stop == ',' || *stop == ' ';
  return fault == std::errc() && ends && threads > 0 ? std::optional(threads) : std::nullopt;
}

int default_threads() {
  if (const std::optional<int> asked = parse_thread_setting(std::getenv("OMP_NUM_THREADS")))
    return std::min(*asked, omp_get_thread_limit());
  int threads = std::min(omp_get_num_procs(), omp_get_thread_limit());  // the first respects the affinity
  if (const std::optional<double> quota = find_group_limits().processors)
    threads = static_cast<int>(std::min<double>(threads, std::ceil(*quota)));
  if (const std::optional<std::uint64_t> left = left_of(RLIMIT_AS, process_size().addresses)) {
    const std::uint64_t most = *left / 4 / std::max<std::uint64_t>(bytes_of_stacks(1), 1);
    threads = static_cast<int>(std::min<std::uint64_t>(static_cast<std::uint64_t>(threads), most));
  }
  return std::max(threads, 1);
}

}  // namespace heightlight
