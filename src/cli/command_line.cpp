#include "cli/command_line.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>

#include "cli/commands.h"
#include "cli/config_file.h"
#include "cli/noted_command.h"
#include "cli/plots.h"
#include "cli/tell.h"
#include "cli/user_message.h"
#include "files/interrupt.h"
#include "files/lock_file.h"
#include "files/staging_folder.h"
#include "heightlight/error.h"
#include "heightlight/version.h"

namespace heightlight {
namespace {

int fail(int exit_code, const std::string& message) {
  tell(message);
  return exit_code;
}

/// Says so once: work may heed a signal just as patience with it ends. Nobody who closed the pipe listens.
int end_interrupted(int signal_number) {
  static std::atomic_flag told;
  if (signal_number != SIGPIPE && !told.test_and_set()) fail(0, "interrupted");
  return 128 + signal_number;
}

/// After a signal that the work at hand did not heed in time.
void end_late(int signal_number) {
  const int exit_code = end_interrupted(signal_number);
  leave_locks();
  end_without_staging(exit_code);
}

/// A standard stream that the parent closed would become the first file that is opened.
void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(descriptor, F_GETFD) >= 0 || errno != EBADF) continue;
    if (open("/dev/null", descriptor == STDIN_FILENO ? O_RDONLY : O_WRONLY) < 0) std::abort();
  }
}

/// An empty argument is what an unset variable of a shell leaves.
void refuse_empty_arguments(int count, const char* const* arguments) {
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    const bool assigned = argument.starts_with("--") && argument.ends_with('=');
    if (!argument.empty() && !assigned) continue;
    const std::string before = assigned ? argument.substr(0, argument.size() - 1) : arguments[i - 1];
    throw UsageError("the argument after " + (i > 1 || assigned ? before : "the name of the program") +
                     " is empty (an unset variable?)");
  }
}

/// CLI11 would say that there is none.
void refuse_unknown_command(const CLI::App& app, int count, const char* const* arguments) {
  if (count < 2) return;
  const std::string first = arguments[1];
  if (first == "-h" || first == "--help" || first == "--version") return;
  if (first.starts_with('-')) throw UsageError("there is no option " + first + " before a command");
  std::string known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == first) return;
    known += (known.empty() ? "" : ", ") + command->get_name();
  }
  throw UsageError("there is no command '" + first + "'; the commands are " + known);
}

// CLI11 tells usage errors from requests for help by the exit code that it would use.
int finish_parse(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  const std::string file = config_file_of(app);
  return fail(2, std::string(error.what()) + " (see heightlight --help" +
                     (file.empty() ? ")" : "; options were also read from " + file + ")"));
}

/// Runs the command, and says what it threw.
int run(CLI::App& app, int argument_count, const char* const* arguments) {
  try {
    note_interrupts(end_late);
    refuse_empty_arguments(argument_count, arguments);
    refuse_unknown_command(app, argument_count, arguments);
    app.parse(argument_count, arguments);
    return 0;
  } catch (const CLI::ParseError& error) {
    return finish_parse(app, error);
  } catch (const PlotsMissing&) {
    return kExitWithoutPlots;
  } catch (const Cancelled&) {
    return end_interrupted(noted_signal());
  } catch (const UsageError& error) {
    return fail(2, user_message(error));
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return 1;  // which is told where all that was printed is checked
    return fail(1, user_message(error));
  }
}

/// What was printed may not have gone out: a full disk, a pipe that was closed.
int check_printed(int exit_code) {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  if (noted_signal() == SIGPIPE) return end_interrupted(SIGPIPE);
  return fail(1,
              std::string("standard output: cannot be written: ") + std::strerror(errno == 0 ? EIO : errno));
}

}  // namespace

int run_command_line(int argument_count, const char* const* arguments) {
  open_standard_streams();
  note_command(argument_count, arguments);
  CLI::App app{
      "Light on height fields: ambient occlusion, form factors and bounces, and how well closed forms "
      "predict them"};
  app.footer(
      "Exit codes: 0 done; 1 failed; 2 wrong usage; 3 done except for the plots (gnuplot does not work);\n"
      "128 + N ended by signal N.");
  app.name("heightlight");
  app.set_version_flag("--version", HEIGHTLIGHT_VERSION);
  app.require_subcommand(1);
  add_simulate_command(app);
  add_bake_command(app);
  add_compare_command(app);
  add_fit_command(app);
  add_shaders_command(app);
  add_synth_command(app);
  add_specular_table_command(app);
  add_info_command(app);
  add_dataset_command(app);
  add_completion_command(app);
  add_config_options(app);
  return check_printed(run(app, argument_count, arguments));
}

}  // namespace heightlight
