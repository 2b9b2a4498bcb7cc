#include "plot/gnuplot_run.h"

#include <gnuplot-iostream.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "files/interrupt.h"
#include "files/printable.h"
#include "heightlight/error.h"

extern char** environ;

namespace heightlight {
namespace {

PlotError gnuplot_error(const std::string& fault) { return PlotError("plots need gnuplot, " + fault); }

std::string system_message(int error_number) { return std::generic_category().message(error_number); }

/// A nameless file in memory. Through files, rather than pipes, gnuplot may end early or talk much and
/// neither side waits for the other.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("heightlight", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw gnuplot_error("and memory to talk with it: " + system_message(errno));
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  int descriptor() const { return descriptor_; }
  void rewind() { lseek(descriptor_, 0, SEEK_SET); }

  std::string read_all() {
    std::string bytes(static_cast<std::size_t>(lseek(descriptor_, 0, SEEK_END)), '\0');
    rewind();
    std::size_t got = 0;
    while (got < bytes.size()) {
      const ssize_t count = read(descriptor_, bytes.data() + got, bytes.size() - got);
      if (count <= 0) throw gnuplot_error("whose output could not be read: " + system_message(errno));
      got += static_cast<std::size_t>(count);
    }
    return bytes;
  }

 private:
  int descriptor_;
};

/// The environment, with the locale that the scripts are written for (in any other, gnuplot may stumble over
/// Greek letters and degree signs), and without the terminal that a user draws on.
std::vector<std::string> gnuplot_environment() {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    if (!text.starts_with("LC_") && !text.starts_with("LANG") && !text.starts_with("GNUTERM"))
      variables.emplace_back(text);
  }
  variables.emplace_back("LC_ALL=C.UTF-8");
  return variables;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// A gnuplot on three files. It ends with this object, and with this process, however that ends.
class GnuplotProcess {
 public:
  GnuplotProcess(std::vector<std::string> words, const MemoryFile& input, const MemoryFile& output,
                 const MemoryFile& messages) {
    std::vector<std::string> variables = gnuplot_environment();
    const std::vector<char*> arguments = pointers_to(words);
    const std::vector<char*> environment = pointers_to(variables);
    MemoryFile fault;  // why it could not be started, if it could not
    const pid_t parent = getpid();
    // Not fork(): what libraries do around it in a process of many threads may wait for ever, and where no
    // memory is promised twice, it wants as much again as this process has. posix_spawn() knows neither of
    // limits nor of parents that end. The child makes system calls alone.
    child_ = vfork();  // NOLINT(clang-analyzer-security.insecureAPI.vfork)
    if (child_ < 0) throw gnuplot_error("which cannot be started: " + system_message(errno));
    if (child_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) _exit(1);  // it ended before
      for (const int ignored : {SIGXFSZ, SIGPIPE}) std::signal(ignored, SIG_DFL);
      constexpr rlim_t kLargestPicture = 256 << 20;
      const rlimit most{kLargestPicture, kLargestPicture};
      setrlimit(RLIMIT_FSIZE, &most);  // of what it may leave in memory
      const bool ready = dup2(input.descriptor(), STDIN_FILENO) >= 0 &&
                         dup2(output.descriptor(), STDOUT_FILENO) >= 0 &&
                         dup2(messages.descriptor(), STDERR_FILENO) >= 0;
      if (ready) execvpe(arguments[0], arguments.data(), environment.data());
      const int error_number = errno;
      static_cast<void>(!write(fault.descriptor(), &error_number, sizeof error_number));
      _exit(127);
    }
    wait();
    if (const std::string bytes = fault.read_all(); bytes.size() == sizeof(int)) {
      int error_number = 0;
      std::memcpy(&error_number, bytes.data(), sizeof error_number);
      throw gnuplot_error("which cannot be started (is it installed?): " + system_message(error_number));
    }
  }
  ~GnuplotProcess() { end(); }
  GnuplotProcess(const GnuplotProcess&) = delete;
  GnuplotProcess& operator=(const GnuplotProcess&) = delete;

  /// As waitpid reports it.
  int status() const { return status_; }

 private:
  void wait() {
    constexpr std::chrono::seconds kPatience{60};
    const auto late = std::chrono::steady_clock::now() + kPatience;
    for (;;) {
      const pid_t ended = waitpid(child_, &status_, WNOHANG);
      if (ended < 0 && errno != EINTR) {
        const int error_number = errno;
        child_ = 0;
        throw gnuplot_error("which was lost: " + system_message(error_number));
      }
      if (ended == child_) {
        child_ = 0;
        return;
      }
      const bool is_late = std::chrono::steady_clock::now() > late;
      const bool is_stopped = noted_signal() != 0;
      if (is_late || is_stopped) end();
      if (is_stopped) throw Cancelled();
      if (is_late) throw gnuplot_error("which did not end within a minute");
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  void end() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    child_ = 0;
  }

  pid_t child_ = 0;
  int status_ = 0;
};

/// gnuplot shows the line it stumbled on, a caret, and then what is wrong.
std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "no message";
  const std::size_t before = text.find_last_of('\n', end);
  return text.substr(before == std::string::npos ? 0 : before + 1, end - before);
}

}  // namespace

std::string gnuplot_fault() {
  try {
    const MemoryFile input;
    MemoryFile output;
    MemoryFile messages;
    const GnuplotProcess process({"gnuplot", "--version"}, input, output, messages);
    if (process.status() == 0 && output.read_all().starts_with("gnuplot ")) return "";
    return gnuplot_error("and what is called so is none").what();
  } catch (const PlotError& error) {
    return error.what();
  }
}

GnuplotResult run_gnuplot(const std::function<void(gnuplotio::Gnuplot&)>& write_script) {
  MemoryFile input;
  MemoryFile output;
  MemoryFile messages;
  {
    const int copy = dup(input.descriptor());  // closed by the stream
    std::FILE* stream = copy < 0 ? nullptr : fdopen(copy, "w");
    if (!stream) {
      const int error_number = errno;
      if (copy >= 0) close(copy);
      throw gnuplot_error("and a file to talk with it: " + system_message(error_number));
    }
    gnuplotio::Gnuplot script(stream);
    write_script(script);
  }
  input.rewind();
  // -d: nobody's start-up files. A script from a file, not from a terminal: its first error ends the run.
  const GnuplotProcess process({"gnuplot", "-d", "/dev/stdin"}, input, output, messages);
  throw_if_interrupted();  // the signal may have reached gnuplot too
  GnuplotResult result{output.read_all(), messages.read_all()};
  if (process.status() != 0) throw gnuplot_error("which failed: " + last_line(result.messages));
  if (result.output.empty()) throw gnuplot_error("which drew nothing: " + last_line(result.messages));
  return result;
}

void send_table(gnuplotio::Gnuplot& script, const std::string& name, const PlotTable& table) {
  script << '$' << name << " << e\n";  // the table ends with a line of "e"
  script.send1d(table);
}

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : printable(text)) {
    if (c == '\'') quoted += c;
    quoted += c;
  }
  // gnuplot puts titles into CDATA sections of SVG, which these three characters end.
  for (std::size_t at = quoted.find("]]>"); at != std::string::npos; at = quoted.find("]]>", at))
    quoted.replace(at, 3, "]] >");
  return quoted + "'";
}

}  // namespace heightlight
