#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "scratch_folder.h"

namespace heightlight {

/// How a process ended.
struct ProcessEnd {
  int exit_code = -1;  ///< -1: by a signal
  int signal = 0;
  double peak_mebibytes = 0;  ///< of memory
};

/// `heightlight ARGUMENTS…` in a folder, while it runs. What it prints goes to files outside that folder.
class RunningCommand {
 public:
  /// `prepare` runs in the new process first: for limits.
  RunningCommand(
      const std::vector<std::string>& arguments, const std::filesystem::path& folder,
      const std::function<void()>& prepare = [] {}) {
    std::vector<std::string> words{HEIGHTLIGHT_COMMAND};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string out = (streams_ / "out").string();
    const std::string error = (streams_ / "error").string();
    process_ = fork();
    if (process_ < 0) throw std::runtime_error("no process");
    if (process_ > 0) return;
    const bool ready = chdir(folder.c_str()) == 0 && dup2(open("/dev/null", O_RDONLY), STDIN_FILENO) >= 0 &&
                       dup2(open(out.c_str(), O_WRONLY | O_CREAT, 0666), STDOUT_FILENO) >= 0 &&
                       dup2(open(error.c_str(), O_WRONLY | O_CREAT, 0666), STDERR_FILENO) >= 0;
    prepare();
    if (ready) execv(argv[0], argv.data());
    _exit(127);
  }
  ~RunningCommand() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  RunningCommand(const RunningCommand&) = delete;
  RunningCommand& operator=(const RunningCommand&) = delete;

  void send(int signal) const { kill(process_, signal); }

  ProcessEnd wait() {
    int status = 0;
    rusage usage{};
    wait4(process_, &status, 0, &usage);
    process_ = 0;
    const double peak = static_cast<double>(usage.ru_maxrss) / 1024;
    if (WIFEXITED(status)) return {WEXITSTATUS(status), 0, peak};
    return {-1, WTERMSIG(status), peak};
  }

  /// Lets it run for a while, then sends the signal and waits.
  ProcessEnd interrupt_after(double seconds, int signal) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    send(signal);
    return wait();
  }

  std::string error_output() const { return read_text(streams_ / "error"); }

 private:
  ScratchFolder streams_;
  pid_t process_ = 0;
};

}  // namespace heightlight
