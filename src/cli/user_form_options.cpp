#include "cli/user_form_options.h"

namespace heightlight {

void add_user_form_options(CLI::App& command, UserFormOptions& options) {
  command
      .add_option(
          "--form", options.forms,
          "your own closed form of E/pi: 'NAME = EXPRESSION' in A, alpha, n (the mean A of what is seen) and "
          "rho,\n"
          "with the functions of GLSL and ^; other letters are constants to be fitted; may be repeated")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command
      .add_option("--forms", options.file,
                  "file of your own closed forms, one per line, written as for --form; # begins a comment")
      ->type_name("FILE");
}

}  // namespace heightlight
