#include "plot/gnuplot_run.h"

#include <gnuplot-iostream.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>
#include <vector>

#include "files/interrupt.h"
#include "heightlight/error.h"

extern char** environ;

namespace heightlight {
namespace {

Error gnuplot_error(const std::string& fault) { return Error("plots need gnuplot, " + fault); }

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

/// The environment, with the locale that the scripts are written for: in any other, gnuplot may stumble over
/// Greek letters and degree signs.
std::vector<std::string> gnuplot_environment() {
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    if (!text.starts_with("LC_") && !text.starts_with("LANG")) variables.emplace_back(text);
  }
  variables.emplace_back("LC_ALL=C.UTF-8");
  return variables;
}

/// Starts gnuplot on the three files and waits; its exit status as waitpid reports it.
int spawn_gnuplot(const MemoryFile& input, const MemoryFile& output, const MemoryFile& messages) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, messages.descriptor(), STDERR_FILENO);
  std::string name = "gnuplot";
  std::string without_start_up_files = "-d";
  std::string script = "/dev/stdin";  // as a file, whose first error ends the run
  char* const arguments[] = {name.data(), without_start_up_files.data(), script.data(), nullptr};
  std::vector<std::string> variables = gnuplot_environment();
  std::vector<char*> environment;
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);
  pid_t child = 0;
  const int failure = posix_spawnp(&child, name.c_str(), &actions, nullptr, arguments, environment.data());
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0)
    throw gnuplot_error("which cannot be started (is it installed?): " + system_message(failure));
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw gnuplot_error("which was lost: " + system_message(errno));
  }
  return status;
}

/// gnuplot shows the line it stumbled on, a caret, and then what is wrong.
std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "no message";
  const std::size_t before = text.find_last_of('\n', end);
  return text.substr(before == std::string::npos ? 0 : before + 1, end - before);
}

}  // namespace

GnuplotResult run_gnuplot(const std::function<void(gnuplotio::Gnuplot&)>& write_script) {
  MemoryFile input;
  MemoryFile output;
  MemoryFile messages;
  {
    const int copy = dup(input.descriptor());  // closed by the stream
    std::FILE* stream = copy < 0 ? nullptr : fdopen(copy, "w");
    if (!stream) throw gnuplot_error("and a file to talk with it: " + system_message(errno));
    gnuplotio::Gnuplot script(stream);
    write_script(script);
  }
  input.rewind();
  const int status = spawn_gnuplot(input, output, messages);
  throw_if_interrupted();  // the signal reached gnuplot too
  GnuplotResult result{output.read_all(), messages.read_all()};
  if (status != 0) throw gnuplot_error("which failed: " + last_line(result.messages));
  return result;
}

void send_table(gnuplotio::Gnuplot& script, const std::string& name, const PlotTable& table) {
  script << '$' << name << " << e\n";  // the table ends with a line of "e"
  script.send1d(table);
}

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'') quoted += c;
    quoted += c >= '\0' && c < ' ' ? '?' : c;
  }
  return quoted + "'";
}

}  // namespace heightlight
