// Small files that announce or inflate to gigabytes, and large ones that are none: what they make the
// commands take is bounded.

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "command.h"
#include "files/png_bytes.h"
#include "running_command.h"

#ifndef HEIGHTLIGHT_SANITIZED  // which holds memory of its own

namespace heightlight {
namespace {

namespace fs = std::filesystem;

ProcessEnd run_words(const ScratchFolder& folder, const std::string& line) {
  std::istringstream stream(line);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return RunningCommand(words, folder.path()).wait();
}

void write_large(const fs::path& path, std::size_t mebibytes) {
  std::ofstream file(path, std::ios::binary);
  const std::string block(1 << 20, '[');
  for (std::size_t i = 0; i < mebibytes; ++i) file << block;
}

}  // namespace

TEST_CASE("what a file makes a reader take is bounded before it is taken", "[cli]") {
  const ScratchFolder folder;
  REQUIRE(run_command("synth brick -o good.png --size 16", folder).exit_code == 0);
  const ProcessEnd usual = run_words(folder, "simulate good.png -o run --rays 4 --quiet");
  REQUIRE(usual.exit_code == 0);

  REQUIRE(run_command("synth brick -o good.exr --size 16", folder).exit_code == 0);
  write_text(folder / "greedy.exr", read_text(folder / "good.exr").substr(0, 8) +
                                        std::string("comments\0string\0\xff\xff\xff\x7f", 20));
  const std::string zeros = deflated_zeros(std::size_t{400} << 20);
  write_text(folder / "bomb.png",
             kPngSignature + png_header(4, 4) + png_chunk("IDAT", zeros) + png_chunk("IEND", ""));
  write_large(folder / "large.csv", 300);
  write_large(folder / "large.json", 300);
  fs::create_directory(folder / "in");
  fs::copy_file(folder / "good.png", folder / "in/good.png");
  write_large(folder / "in/x_bake.json", 300);
  write_large(folder / "run/summary.json", 300);

  for (const char* arguments :
       {"info greedy.exr --memory 300M", "simulate good.png -o o --albedo greedy.exr --memory 300M",
        "info bomb.png --memory 300M", "simulate good.png -o o --albedo bomb.png --memory 300M",
        "fit large.csv -o f --memory 300M", "fit large.csv -o f", "dataset large.json -o d",
        "bake in -o b --maps ao --azimuths 4", "fit run/curves.csv -o f"}) {
    const ProcessEnd end = run_words(folder, arguments);
    INFO(arguments);
    CHECK(end.exit_code >= 0);
    CHECK(end.exit_code <= 1);
    CHECK(end.peak_mebibytes < usual.peak_mebibytes + 64);
  }
}

}  // namespace heightlight

#endif
