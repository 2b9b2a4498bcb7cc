// Without a gnuplot that works, everything is there but the plots; that is told in a line, and by exit
// code 3.

#include <signal.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>

#include "command.h"
#include "running_command.h"

namespace heightlight {
namespace {

namespace fs = std::filesystem;
using Catch::Contains;

/// A folder with a program of that name in it, which the path begins with.
void put_gnuplot(const ScratchFolder& folder, const std::string& script) {
  fs::create_directory(folder / "bin");
  write_text(folder / "bin/gnuplot", "#!/bin/sh\n" + script);
  fs::permissions(folder / "bin/gnuplot", fs::perms::all);
}

void use_gnuplot_of(const ScratchFolder& folder) {
  setenv("PATH", ((folder / "bin").string() + ":" + getenv("PATH")).c_str(), 1);
}

}  // namespace

TEST_CASE("without gnuplot, results lack their plots and nothing else", "[cli][deep]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o m.png --size 24", folder).exit_code == 0);
  REQUIRE(run_command("simulate m.png -o run --rays 16 --bins 20 --quiet", folder).exit_code == 0);
  write_text(
      folder / "study.json",
      R"({"maps": [{"shape": "fbm", "size": 8}, {"shape": "brick", "size": 8}], "options": [{"rays": 4}]})");
  const std::string gnuplot = GENERATE("exit 3\n", "exit 0\n", "echo gnuplot 5.4\n", "absent",
                                       "echo gnuplot 5.4\n[ \"$1\" = --version ] && exit\nexec yes\n");
  if (gnuplot == "absent") {
    fs::create_directory(folder / "bin");
  } else {
    put_gnuplot(folder, gnuplot);
  }
  const auto [arguments, kept] = GENERATE(table<std::vector<std::string>, std::string>(
      {{{"simulate", "m.png", "-o", "out", "--rays", "4"}, "curves.csv"},
       {{"compare", "m.png", "-o", "out", "--azimuths", "4"}, "report.md"},
       {{"fit", "run/curves.csv", "-o", "out", "--bootstrap", "20"}, "models.glsl"},
       {{"dataset", "study.json", "-o", "out"}, "dataset.csv"}}));
  std::vector<std::string> words = arguments;
  words.emplace_back("--quiet");
  RunningCommand command(words, folder.path(), [&] { setenv("PATH", (folder / "bin").c_str(), 1); });
  const ProcessEnd end = command.wait();
  INFO(words[0] << ", " << gnuplot << "\n" << command.error_output());
  CHECK(end.exit_code == 3);
  CHECK(fs::exists(folder / "out" / kept));
  CHECK_FALSE(fs::exists(folder / "out/curves.svg"));
  CHECK_FALSE(fs::exists(folder / "out/pareto.png"));
  const std::string error = command.error_output();
  std::size_t told = 0;
  for (std::size_t at = error.find("have no plots"); at != std::string::npos;
       at = error.find("have no plots", at + 1)) {
    ++told;
  }
  CHECK(told == 1);
  if (words[0] != "dataset") return;
  // Once gnuplot works, runs without plots are made again.
  CHECK(run_command("dataset study.json -o out --quiet", folder).exit_code == 0);
  for (const auto& run : fs::directory_iterator(folder / "out/runs"))
    CHECK(fs::exists(run.path() / "curves.svg"));
}

TEST_CASE("plots do not depend on the terminal a user draws on, nor on who waits for children", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o m.png --size 16", folder).exit_code == 0);
  const bool ignores = GENERATE(false, true);
  RunningCommand command({"simulate", "m.png", "-o", "out", "--rays", "4", "--quiet"}, folder.path(), [&] {
    setenv("GNUTERM", "x11", 1);
    if (ignores) std::signal(SIGCHLD, SIG_IGN);
  });
  CHECK(command.wait().exit_code == 0);
  CHECK(fs::file_size(folder / "out/curves.png") > 1000);
}

TEST_CASE("a gnuplot that hangs ends with the command", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o m.png --size 16", folder).exit_code == 0);
  put_gnuplot(folder, "[ \"$1\" = --version ] && echo gnuplot 5.4 && exit\necho $$ > " +
                          (folder / "pid").string() + "\nexec sleep 1000\n");
  const int signal = GENERATE(SIGTERM, SIGKILL);
  RunningCommand command({"simulate", "m.png", "-o", "out", "--rays", "4", "--quiet"}, folder.path(),
                         [&] { use_gnuplot_of(folder); });
  for (int i = 0; i < 2000 && read_text(folder / "pid").empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const pid_t child = std::stoi(read_text(folder / "pid"));
  command.send(signal);
  const ProcessEnd end = command.wait();
  CHECK((signal == SIGKILL ? end.signal == SIGKILL : end.exit_code == 143));
  bool ended = false;
  for (int i = 0; i < 200 && !ended; ++i) {
    // A zombie that nobody has reaped has ended, too.
    const std::string state = read_text("/proc/" + std::to_string(child) + "/stat");
    ended = kill(child, 0) != 0 || state.find(") Z") != std::string::npos;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK(ended);
  CHECK_FALSE(fs::exists(folder / "out"));
}

TEST_CASE("a gnuplot that does not end is given up after a minute", "[cli][deep]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o m.png --size 16", folder).exit_code == 0);
  put_gnuplot(folder, "[ \"$1\" = --version ] && echo gnuplot 5.4 && exit\nexec sleep 1000\n");
  RunningCommand command({"simulate", "m.png", "-o", "out", "--rays", "4", "--quiet"}, folder.path(),
                         [&] { use_gnuplot_of(folder); });
  CHECK(command.wait().exit_code == 3);
  CHECK_THAT(command.error_output(), Contains("did not end within a minute"));
  CHECK(fs::exists(folder / "out/summary.json"));
}

}  // namespace heightlight
