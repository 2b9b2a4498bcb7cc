// --memory is a promise about the process's peak: it is kept, or refused with an amount that would do. What
// is taken by default stays within the limits that others set.

#ifndef HEIGHTLIGHT_SANITIZED  // which multiplies memory

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "base/byte_size.h"
#include "command.h"
#include "huge_map.h"
#include "results.h"
#include "running_command.h"

namespace heightlight {
namespace {

using Words = std::vector<std::string>;

/// How a command ended, and what it said.
struct Told {
  ProcessEnd end;
  std::string error;
};

/// Its peak counts this process's own memory, which fork copies, too: it has the same libraries, and less
/// work.
Told run_words(
    const Words& words, const ScratchFolder& folder, const std::function<void()>& prepare = [] {}) {
  RunningCommand command(words, folder.path(), prepare);
  const ProcessEnd end = command.wait();
  return {end, command.error_output()};
}

double mebibytes(const std::string& amount) {
  return static_cast<double>(parse_byte_size(amount)) / (1 << 20);
}

/// The amount that a refusal names.
std::optional<std::string> named_amount(const std::string& error) {
  std::smatch found;
  return std::regex_search(error, found, std::regex(R"(\(--memory (\d+M)\))")) ? std::optional(found[1].str())
                                                                               : std::nullopt;
}

Told run_within(Words words, const std::string& amount, const ScratchFolder& folder) {
  words.insert(words.end(), {"--memory", amount, "--threads", "2", "--quiet"});
  return run_words(words, folder);
}

/// Kept, or refused with an amount by which it is kept. Whether it was refused at first. Links are counted
/// only once their receivers are sampled: they may be refused a second time.
bool check_promise(const Words& words, const std::string& amount, const ScratchFolder& folder,
                   int most_refusals = 1) {
  std::string allowed = amount;
  Told told = run_within(words, allowed, folder);
  int refusals = 0;
  for (; told.end.exit_code != 0 && refusals < most_refusals; ++refusals) {
    INFO(allowed << ": " << told.error);
    const std::optional<std::string> named = named_amount(told.error);
    REQUIRE(named);
    CHECK(mebibytes(*named) > mebibytes(allowed));
    allowed = *named;
    told = run_within(words, allowed, folder);
  }
  INFO(allowed << ": " << told.error);
  CHECK(told.end.exit_code == 0);
  CHECK(told.end.peak_mebibytes <= mebibytes(allowed));
  return refusals > 0;
}

void make_map(const std::string& shape, int side, const ScratchFolder& folder) {
  const std::string name = shape + std::to_string(side) + ".png";
  REQUIRE(
      run_command("synth " + shape + " -o " + name + " --size " + std::to_string(side), folder).exit_code ==
      0);
}

}  // namespace

TEST_CASE("a promise of memory is kept, or refused with what would do", "[cli][memory]") {
  const ScratchFolder folder;
  make_map("brick", 512, folder);
  check_promise({"bake", "brick512.png", "-o", "out"}, "200M", folder);
  check_promise({"simulate", "brick512.png", "-o", "out", "--bounces", "4"}, "200M", folder);
  CHECK(check_promise(
      {"simulate", "brick512.png", "-o", "out", "--bounces", "4", "--visibility", "rays", "--rays", "60"},
      "200M", folder, 2));
  CHECK(check_promise({"bake", "brick512.png", "-o", "out", "--maps", "ao,ao-n,sh,horizon"}, "20M", folder));
  CHECK(check_promise({"info", "brick512.png"}, "1M", folder));
}

TEST_CASE("a promise of memory is kept on larger maps, whatever is made of them", "[cli][memory][deep]") {
  const ScratchFolder folder;
  const std::string shape = GENERATE("brick", "fbm");
  const int side = GENERATE(512, 1024);
  make_map(shape, side, folder);
  const std::string map = shape + std::to_string(side) + ".png";
  for (const char* amount : {"200M", "300M"}) {
    check_promise({"bake", map, "-o", "out"}, amount, folder);
    check_promise({"bake", map, "-o", "out", "--maps", "ao,multibounce,bent-cone,sh", "--format", "exr"},
                  amount, folder);
    check_promise({"bake", map, "-o", "out", "--maps", "ao-n,multibounce", "--albedo", "0.9,0.5,0.2"}, amount,
                  folder);
    check_promise({"simulate", map, "-o", "out", "--error", "0.005"}, amount, folder);
    check_promise({"simulate", map, "-o", "out", "--error", "0.005", "--sun", "120,40"}, amount, folder);
  }
}

TEST_CASE("a map that memory does not hold is refused by its header", "[cli][memory]") {
  const ScratchFolder folder;
  write_huge_map(folder / "huge.png");
  for (const Words& words :
       {Words{"bake", "huge.png", "-o", "out"}, Words{"simulate", "huge.png", "-o", "out"}}) {
    const Told told = run_within(words, "4G", folder);
    INFO(told.error);
    CHECK(told.end.exit_code == 1);
    CHECK_THAT(told.error, Catch::Contains("huge.png: work on 30000 x 30000 samples takes"));
    CHECK(named_amount(told.error));
    CHECK(!std::filesystem::exists(folder / "out"));
  }
}

TEST_CASE("by default, nothing passes what RLIMIT_AS leaves", "[cli][memory]") {
  const ScratchFolder folder;
  make_map("brick", 512, folder);
  const rlim_t limit = GENERATE(rlim_t{1200}, rlim_t{1500}, rlim_t{3000}) << 20;
  const Told told =
      run_words({"bake", "brick512.png", "-o", "out", "--error", "0.01", "--quiet"}, folder, [limit] {
        const rlimit addresses{limit, limit};
        setrlimit(RLIMIT_AS, &addresses);
      });
  INFO((limit >> 20) << " MiB of addresses: " << told.error);
  CHECK((told.end.exit_code == 0 || named_amount(told.error)));
}

TEST_CASE("by default, nothing passes what a control group leaves", "[cli][memory]") {
  namespace fs = std::filesystem;
  constexpr int kMebibytes = 240;
  const fs::path first = "/sys/fs/cgroup/memory";
  const bool divided = fs::exists(first);
  const fs::path group =
      (divided ? first : fs::path("/sys/fs/cgroup")) / ("heightlight-test-" + std::to_string(getpid()));
  std::error_code failure;
  fs::create_directory(group, failure);
  const fs::path limit = group / (divided ? "memory.limit_in_bytes" : "memory.max");
  if (failure || !fs::exists(limit)) {
    fs::remove(group, failure);
    WARN("no control group can be made here: NOT TESTED");
    return;
  }
  std::ofstream(limit) << std::to_string(kMebibytes) + "M" << std::flush;
  const ScratchFolder folder;
  make_map("brick", 512, folder);
  make_map("fbm", 2048, folder);
  const auto enter = [&] { std::ofstream(group / "cgroup.procs") << getpid() << std::flush; };
  const Told small =
      run_words({"bake", "brick512.png", "-o", "out", "--error", "0.01", "--quiet"}, folder, enter);
  const Told large = run_words({"simulate", "fbm2048.png", "-o", "out", "--quiet"}, folder, enter);
  fs::remove(group, failure);
  INFO(small.error << large.error);
  CHECK(small.end.exit_code == 0);
  CHECK(large.end.exit_code == 1);  // and no signal of the kernel's
  CHECK(named_amount(large.error));
}

}  // namespace heightlight

#endif
