// The command line: words, one a line. They run in an empty folder where hardly a file can be made, so that
// options are read and checked, and then the input is missing.

#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "fuzz_input.h"

namespace {

/// Words that would reach out of the folder, or make a large map.
bool is_safe(const std::string& word) {
  int digits = 0;
  for (const char c : word) {
    digits = c >= '0' && c <= '9' ? digits + 1 : 0;
    if (digits > 2) return false;
  }
  return word.find('/') == std::string::npos && word.find("..") == std::string::npos;
}

/// LLVM's OpenMP makes a file of so many bytes in memory, named by the process, in every process that forks
/// off. One that was made shorter stays, and the next process of that number dies of SIGBUS when it reads it.
constexpr rlim_t kFileOfOpenMp = 1024;

void limit_files(rlim_t bytes) {
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = bytes;
  setrlimit(RLIMIT_FSIZE, &limit);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string kFolder = [] {
    std::string name = (std::filesystem::temp_directory_path() / "heightlight-fuzz-XXXXXX").string();
    heightlight::require(mkdtemp(name.data()) != nullptr, "there is a folder to work in");
    std::signal(SIGXFSZ, SIG_IGN);
    return name;
  }();
  static const std::filesystem::path kHome = std::filesystem::current_path();
  std::vector<std::string> words{"heightlight"};
  std::string word;
  for (std::size_t i = 0; i <= size; ++i) {
    if (i < size && data[i] != '\n' && data[i] != 0) {
      word += static_cast<char>(data[i]);
      continue;
    }
    if (!is_safe(word)) return 0;
    words.push_back(word);
    word.clear();
  }
  std::vector<const char*> arguments;
  for (const std::string& one : words) arguments.push_back(one.c_str());

  std::filesystem::current_path(kFolder);
  limit_files(kFileOfOpenMp);
  const int exit_code = heightlight::run_command_line(static_cast<int>(arguments.size()), arguments.data());
  limit_files(RLIM_INFINITY);
  heightlight::require(exit_code >= 0 && exit_code <= 3, "an exit code is from 0 to 3");
  std::filesystem::remove_all(kFolder);
  std::filesystem::create_directory(kFolder);
  std::filesystem::current_path(kHome);
  return 0;
}
