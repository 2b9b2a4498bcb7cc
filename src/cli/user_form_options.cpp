#include "cli/user_form_options.h"

namespace heightlight {

void add_user_form_options(CLI::App& command, UserFormOptions& options) {
  command
      .add_option(
          "--form", options.forms,
          "a form of your own, of E/pi: 'NAME = EXPRESSION' in A, alpha, n (the mean A of what is seen) "
          "and rho,\nwith GLSL's functions, or ^; other letters are constants, which are fitted; again "
          "for another form")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command.add_option("--forms", options.file, "a file of such forms, one a line; # begins a remark")
      ->type_name("FILE");
}

}  // namespace heightlight
