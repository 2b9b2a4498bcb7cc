#include "cli/command_line.h"

#include <atomic>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "cli/commands.h"
#include "cli/user_message.h"
#include "files/interrupt.h"
#include "files/staging_folder.h"
#include "heightlight/error.h"
#include "heightlight/version.h"

namespace heightlight {
namespace {

int fail(int exit_code, const std::string& message) {
  std::fputs(("heightlight: " + message + "\n").c_str(), stderr);
  return exit_code;
}

/// Says so once: work may heed a signal just as patience with it ends.
int end_interrupted(int signal_number) {
  static std::atomic_flag told;
  if (!told.test_and_set()) fail(0, "interrupted");
  return 128 + signal_number;
}

/// After a signal that the work at hand did not heed in time.
void end_late(int signal_number) { end_without_staging(end_interrupted(signal_number)); }

// CLI11 tells usage errors from requests for help by the exit code that it would use.
int finish_parse(const CLI::App& app, const CLI::ParseError& error) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return app.exit(error);
  return fail(2, std::string(error.what()) + " (see heightlight --help)");
}

}  // namespace

int run_command_line(int argument_count, const char* const* arguments) {
  CLI::App app{
      "Light on height fields: ambient occlusion, form factors, bounces, and what closed forms make of them"};
  app.name("heightlight");
  app.set_version_flag("--version", HEIGHTLIGHT_VERSION);
  app.require_subcommand(1);
  add_simulate_command(app);
  add_bake_command(app);
  add_compare_command(app);
  add_fit_command(app);
  add_synth_command(app);
  add_info_command(app);
  add_dataset_command(app);
  try {
    note_interrupts(end_late);
    app.parse(argument_count, arguments);
    return 0;
  } catch (const CLI::ParseError& error) {
    return finish_parse(app, error);
  } catch (const Cancelled&) {
    return end_interrupted(noted_signal());
  } catch (const UsageError& error) {
    return fail(2, user_message(error));
  } catch (const Error& error) {
    return fail(1, user_message(error));
  } catch (const std::bad_alloc&) {
    return fail(1, "out of memory");
  } catch (const std::exception& error) {
    return fail(1, error.what());
  }
}

}  // namespace heightlight
