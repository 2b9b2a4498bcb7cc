#include <set>

#include "files/input_file.h"
#include "files/printable.h"
#include "files/text_lines.h"
#include "heightlight/error.h"
#include "user_form/user_form.h"

namespace heightlight {

std::vector<UserForm> read_user_forms(const std::vector<std::string>& arguments,
                                      const std::filesystem::path& file) {
  std::vector<UserForm> forms;
  for (const std::string& text : arguments) forms.push_back(parse_user_form(text));
  if (!file.empty()) {
    const InputFile input(file);
    LineReader lines(input);
    while (const auto line = lines.next()) {
      const std::size_t first = line->find_first_not_of(" \t");
      if (first == std::string_view::npos || (*line)[first] == '#') continue;
      try {
        forms.push_back(parse_user_form(std::string(*line)));
      } catch (const UsageError& error) {
        throw lines.error(error.what());
      }
    }
  }
  std::set<std::string> names;
  for (const UserForm& form : forms) {
    if (!names.insert(form.name).second) throw UsageError("form", form.name, "this name is given twice");
  }
  return forms;
}

}  // namespace heightlight
