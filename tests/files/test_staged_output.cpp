#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "files/staged_output.h"
#include "heightlight/error.h"
#include "kill_at_calls.h"
#include "remedy.h"
#include "scratch_folder.h"

using namespace heightlight;
using Catch::Contains;
namespace fs = std::filesystem;

TEST_CASE("A committed folder holds its files and nothing else", "[files]") {
  const ScratchFolder scratch;
  {
    StagedFolder out(scratch / "a/b/out/", {}, {});
    write_text(out.file("one.txt"), "1");
    write_text(out.file("two.txt"), "2");
    CHECK_FALSE(fs::exists(out.final_path("one.txt")));
    out.commit();
  }
  CHECK(read_text(scratch / "a/b/out/one.txt") == "1");
  CHECK(read_text(scratch / "a/b/out/two.txt") == "2");
  CHECK(scratch.entry_count() == 5);  // three folders, two files
}

TEST_CASE("A folder without commit leaves no trace, not even the folders it created", "[files]") {
  const ScratchFolder scratch;
  {
    StagedFolder out(scratch / "a/b/out", {}, {});
    write_text(out.file("one.txt"), "1");
  }
  CHECK(scratch.entry_count() == 0);
}

TEST_CASE("A folder without commit leaves what was there before", "[files]") {
  const ScratchFolder scratch;
  write_text(scratch / "one.txt", "old");
  {
    StagedFolder out(scratch.path(), {}, {});
    write_text(out.file("one.txt"), "new");
  }
  CHECK(read_text(scratch / "one.txt") == "old");
  CHECK(scratch.entry_count() == 1);
}

TEST_CASE("A commit replaces files of the same name and keeps the others", "[files]") {
  const ScratchFolder scratch;
  write_text(scratch / "one.txt", "old");
  write_text(scratch / "other.txt", "other");
  StagedFolder out(scratch.path(), {}, {});
  write_text(out.file("one.txt"), "new");
  out.commit();
  CHECK(read_text(scratch / "one.txt") == "new");
  CHECK(scratch.entry_count() == 2);
}

TEST_CASE("A commit that lacks a file names it and changes nothing", "[files]") {
  const ScratchFolder scratch;
  {
    StagedFolder out(scratch / "out", {}, {});
    write_text(out.file("one.txt"), "1");
    out.file("never_written.txt");
    CHECK_THROWS_WITH(out.commit(), Contains("never_written.txt"));
  }
  CHECK(scratch.entry_count() == 0);
}

TEST_CASE("A folder that cannot be made is refused by name, and nothing is left behind", "[files]") {
  const ScratchFolder scratch;
  const fs::path file = write_text(scratch / "file", "x");
  CHECK_THROWS_WITH(StagedFolder(file, {}, {}), Contains(file.string()) && Contains("not a folder"));
  CHECK_THROWS_WITH(StagedFolder(file / "below", {}, {}), Contains((file / "below").string()));
  CHECK_THROWS_AS(StagedFolder(scratch / ("new/" + std::string(300, 'x')), {}, {}),
                  Error);  // a name too long for any disk
  CHECK(scratch.entry_count() == 1);
}

TEST_CASE("A folder in the place of a result is refused before work is spent", "[files]") {
  const ScratchFolder scratch;
  fs::create_directory(scratch / "result.csv");
  StagedFolder out(scratch.path(), {}, {});
  CHECK_THROWS_WITH(out.file("result.csv"), Contains("result.csv") && Contains("directory"));
  CHECK_THROWS_WITH(StagedFile(scratch / "result.csv"), Contains("result.csv") && Contains("directory"));
}

TEST_CASE("A result never replaces an input, whatever that is called", "[files]") {
  const ScratchFolder scratch;
  const fs::path input = write_text(scratch / "one.txt", "input");
  fs::create_symlink("one.txt", scratch / "link.txt");
  fs::create_hard_link(input, scratch / "twin.txt");
  const auto entries = scratch.entry_count();
  for (const char* name : {"one.txt", "link.txt", "twin.txt"}) {
    CAPTURE(name);
    const auto stage = [&] { StagedFolder(scratch.path(), {input}, {name}); };
    CHECK_THROWS_AS(stage(), UsageError);
    CHECK_THROWS_WITH(stage(), Contains("one.txt: the results would replace it"));
    CHECK(remedy_of(stage) == "output");
    StagedFolder out(scratch.path(), {input}, {});  // a name that nobody told beforehand
    CHECK_THROWS_AS(out.file(name), UsageError);
    CHECK_THROWS_AS(StagedFile(scratch / name, {input}), UsageError);
  }
  CHECK_NOTHROW(StagedFolder(scratch.path(), {input, scratch / "absent.txt"}, {"absent.txt", "other.txt"}));
  CHECK(read_text(input) == "input");
  CHECK(scratch.entry_count() == entries);
}

TEST_CASE("A staged file keeps its extension, appears on commit, and leaves nothing without", "[files]") {
  const ScratchFolder scratch;
  {
    StagedFile out(scratch / "map.exr");
    CHECK(out.path().extension() == ".exr");
    write_text(out.path(), "new");
    CHECK_FALSE(fs::exists(scratch / "map.exr"));
  }
  CHECK(scratch.entry_count() == 0);
  {
    StagedFile out(scratch / "map.exr");
    write_text(out.path(), "new");
    out.commit();
  }
  CHECK(read_text(scratch / "map.exr") == "new");
  CHECK(scratch.entry_count() == 1);
}

TEST_CASE("A staged file needs a folder, and never replaces a device", "[files]") {
  const ScratchFolder scratch;
  CHECK_THROWS_WITH(StagedFile(scratch / "absent/map.exr"), Contains("absent/map.exr") && Contains("folder"));
  CHECK_THROWS_WITH(StagedFile("/dev/null"), Contains("/dev/null") && Contains("not a regular file"));
}

TEST_CASE("A folder of somebody's that is called like a staging folder is left alone", "[files]") {
  const ScratchFolder scratch;
  for (const char* name : {".heightlight-2025-11", ".heightlight-99999999-0"}) {
    fs::create_directory(scratch / name);
    write_text(scratch / name / "diary.txt", "mine");
  }
  {
    StagedFolder out(scratch / "out", {}, {});
    write_text(out.file("one.txt"), "1");
    out.commit();
  }
  StagedFile file(scratch / "two.txt");
  write_text(file.path(), "2");
  file.commit();
  CHECK(read_text(scratch / ".heightlight-2025-11" / "diary.txt") == "mine");
  CHECK(read_text(scratch / ".heightlight-99999999-0" / "diary.txt") == "mine");
}

TEST_CASE("What a killed process left is tidied up", "[files]") {
  const ScratchFolder scratch;
  fs::path staging;
  {
    StagedFolder out(scratch / "out", {}, {});
    write_text(out.file("one.txt"), "1");
    for (const auto& entry : fs::directory_iterator(scratch.path())) staging = entry.path();
    fs::copy(staging, scratch / "kept", fs::copy_options::recursive);
  }
  fs::rename(scratch / "kept", scratch / ".heightlight-99999999-0");
  { StagedFolder out(scratch / "out", {}, {}); }
  CHECK(scratch.entry_count() == 0);
}

namespace {

void stage_all(const ScratchFolder& scratch) {
  StagedFile map(scratch / "map.exr");
  write_text(map.path(), "new");
  map.commit();
  for (const char* folder : {"there", "absent"}) {
    StagedFolder out(scratch / folder, {}, {});
    write_text(out.file("one.txt"), "new");
    write_text(out.file("two.txt"), "new");
    out.commit();
  }
}

/// Whole files, of before or of now, and nothing else; a folder that was absent has all or is not there.
void check_whole(const ScratchFolder& scratch) {
  CHECK_THAT(read_text(scratch / "map.exr"), Catch::Equals("old") || Catch::Equals("new"));
  for (const char* name : {"one.txt", "two.txt"}) {
    CHECK_THAT(read_text(scratch / "there" / name), Catch::Equals("old") || Catch::Equals("new"));
    if (fs::exists(scratch / "absent")) CHECK(read_text(scratch / "absent" / name) == "new");
  }
  CHECK(scratch.entry_count() == (fs::exists(scratch / "absent") ? 7U : 4U));
}

}  // namespace

TEST_CASE("Killed before any call, staging leaves whole results, and what the next process removes",
          "[files]") {
  TracedEnd end = TracedEnd::killed;
  int call = 0;
  for (; end == TracedEnd::killed; ++call) {
    const ScratchFolder scratch;
    fs::create_directory(scratch / "there");
    write_text(scratch / "map.exr", "old");
    write_text(scratch / "there/one.txt", "old");
    write_text(scratch / "there/two.txt", "old");
    end = kill_at_call(call, [&] { stage_all(scratch); });
    remove_left_behind(scratch.path());
    remove_left_behind(scratch / "there");
    INFO("call " << call);
    check_whole(scratch);
  }
  if (end == TracedEnd::untraceable) WARN("processes cannot be traced here: NOT TESTED");
  if (end == TracedEnd::finished) CHECK(call > 30);
}

TEST_CASE("Where staging cannot be opened, one try is enough and leaves nothing", "[files]") {
  const ScratchFolder scratch;
  rlimit whole{};
  REQUIRE(getrlimit(RLIMIT_NOFILE, &whole) == 0);
  // No descriptor is left, but folders can be made.
  const int first_free = dup(STDERR_FILENO);
  close(first_free);
  const rlimit none{static_cast<rlim_t>(first_free), whole.rlim_max};
  REQUIRE(setrlimit(RLIMIT_NOFILE, &none) == 0);
  CHECK_THROWS_AS(StagedFolder(scratch / "out", {}, {}), OutputError);
  REQUIRE(setrlimit(RLIMIT_NOFILE, &whole) == 0);
  CHECK(scratch.entry_count() == 0);
}

TEST_CASE("A name that no file can have is refused before work is spent", "[files]") {
  const ScratchFolder scratch;
  CHECK_THROWS_AS(StagedFolder(scratch / "out", {}, {std::string(300, 'n')}), OutputError);
  CHECK_THROWS_AS(StagedFile(scratch / std::string(300, 'n')), OutputError);
  CHECK(scratch.entry_count() == 0);
}
