// Streams, signals and names as shells and other programs make them.

#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <string>

#include "command.h"
#include "faults/clean_failure.h"
#include "running_command.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;

/// Runs a line of the shell in the folder, HEIGHTLIGHT standing for the command.
int run_line(const ScratchFolder& folder, std::string line) {
  for (std::size_t at = line.find("HEIGHTLIGHT"); at != std::string::npos;
       at = line.find("HEIGHTLIGHT", at + 1))
    line.replace(at, 11, "'" HEIGHTLIGHT_COMMAND "'");
  const int status = std::system(("cd '" + folder.path().string() + "' && " + line).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Until the command is at work: beside its map there is something.
void wait_until_at_work(const ScratchFolder& folder) {
  for (int i = 0; i < 60000 && folder.entry_count() < 2; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  REQUIRE(folder.entry_count() >= 2);
}

const std::vector<std::string> kLong{"simulate", "map.png", "-o", "out", "--rays", "65536", "--quiet"};

}  // namespace

TEST_CASE("what cannot be printed is an error", "[cli]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png");
  const std::string arguments =
      GENERATE("--help", "--version", "info map.png", "bake --help", "simulate map.png -o out --rays 4",
               "bake map.png -o out --azimuths 4");
  CAPTURE(arguments);
  CHECK(run_line(folder, "HEIGHTLIGHT " + arguments + " > /dev/full 2> error") == 1);
  CHECK_THAT(read_text(folder / "error"), Contains("standard output: cannot be written"));
}

TEST_CASE("streams that are closed do no harm, and a reader that leaves is no fault to tell", "[cli]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png");
  CHECK(run_line(folder, "HEIGHTLIGHT simulate map.png -o out --rays 4 >&- 2>&- <&-") == 0);
  CHECK(read_text(folder / "out/curves.csv").starts_with("ao_kind,"));
  CHECK(run_line(folder, "(HEIGHTLIGHT dataset --help; echo $? > code) 2> error | true") == 0);
  CHECK(read_text(folder / "error").empty());
}

TEST_CASE("a limit on the size of files is told, and leaves nothing", "[cli]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png", 64);
  const std::vector<std::string> arguments =
      GENERATE(std::vector<std::string>{"simulate", "map.png", "-o", "out", "--rays", "4"},
               std::vector<std::string>{"bake", "map.png", "-o", "out", "--azimuths", "4"},
               std::vector<std::string>{"synth", "brick", "-o", "new.png"});
  const auto before = entries_below(folder.path());
  RunningCommand command(arguments, folder.path(), [] {
    const rlimit limit{2048, 2048};
    setrlimit(RLIMIT_FSIZE, &limit);
    std::signal(SIGXFSZ, SIG_DFL);  // which would end the process without a word
  });
  const ProcessEnd end = command.wait();
  check_failed_cleanly(end, command.error_output(), folder.path(), before);
  CHECK_THAT(command.error_output(), Contains("cannot be written: File too large"));
}

TEST_CASE("SIGHUP ends it as SIGINT does, what the parent ignores does not", "[cli][slow]") {
  const ScratchFolder folder;
  write_small_map(folder / "map.png", 64);
  const auto before = entries_below(folder.path());
  {
    RunningCommand command(kLong, folder.path());
    wait_until_at_work(folder);
    command.send(SIGHUP);
    CHECK(command.wait().exit_code == 128 + SIGHUP);
    CHECK((entries_below(folder.path()) == before));
  }
  const int ignored = GENERATE(SIGINT, SIGTERM, SIGHUP);
  RunningCommand command({"simulate", "map.png", "-o", "out", "--rays", "2000", "--quiet"}, folder.path(),
                         [&] { std::signal(ignored, SIG_IGN); });
  wait_until_at_work(folder);
  REQUIRE_FALSE(fs::exists(folder / "out"));  // it is at work
  command.send(ignored);
  CHECK(command.wait().exit_code == 0);
  CHECK(fs::exists(folder / "out/summary.json"));
}

TEST_CASE("control characters of names reach neither the terminal nor reports", "[cli][slow]") {
  const ScratchFolder folder;
  const std::string name = "x]]>\xff&<b>|\n\x1b[31m.png";
  write_small_map(folder / name);
  const auto run = [&](const std::vector<std::string>& before, const std::vector<std::string>& after) {
    std::vector<std::string> words = before;
    words.push_back(name);
    words.insert(words.end(), after.begin(), after.end());
    RunningCommand command(words, folder.path());
    CHECK(command.wait().exit_code == 0);
    const std::string said = command.error_output();
    CHECK(said.find('\x1b') == std::string::npos);
    CHECK(said.find('\xff') == std::string::npos);
  };
  run({"info"}, {});
  run({"simulate"}, {"-o", "s", "--rays", "4"});
  run({"compare"}, {"-o", "c", "--azimuths", "4"});
  run({"bake"}, {"-o", "b", "--azimuths", "4"});
  const CommandResult failed = run_command("info $(printf 'absent\\033\\n\\377')x", folder);
  CHECK(failed.error.find('\x1b') == std::string::npos);
  CHECK(std::count(failed.error.begin(), failed.error.end(), '\n') == 1);
  const std::string report = read_text(folder / "c/report.md");
  CHECK_THAT(report.substr(0, report.find('\n')), Contains("\\|") && !Contains("\x1b"));
  for (const char* svg : {"s/curves.svg", "c/pareto.svg"}) {
    const std::string text = read_text(folder / svg);
    CHECK(text.find('\xff') == std::string::npos);
    CHECK(text.find('\x1b') == std::string::npos);
    // A CDATA section ends where it is meant to.
    for (std::size_t at = text.find("<![CDATA["); at != std::string::npos;
         at = text.find("<![CDATA[", at + 1))
      CHECK(text.substr(text.find("]]>", at), 5) == "]]></");
  }
}

TEST_CASE("a name that is too long for its results fails before anything is computed", "[cli]") {
  const ScratchFolder folder;
  const std::string name(244, 'n');
  write_small_map(folder / (name + ".png"), 64);
  const auto before = entries_below(folder.path());
  RunningCommand command({"bake", name + ".png", "-o", "out", "--maps", "bent-normal", "--error", "0.00001"},
                         folder.path());
  const ProcessEnd end = command.wait();
  check_failed_cleanly(end, command.error_output(), folder.path(), before);
  CHECK_THAT(command.error_output(), Contains("File name too long"));
  RunningCommand synth({"synth", "brick", "-o", std::string(300, 'n') + ".png", "--size", "4096"},
                       folder.path());
  const ProcessEnd synth_end = synth.wait();
  check_failed_cleanly(synth_end, synth.error_output(), folder.path(), before);
}

}  // namespace heightlight
