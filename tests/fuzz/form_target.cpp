// Closed forms as users write them: 'NAME = EXPRESSION'.

#include <string>
#include <vector>

#include "fuzz_input.h"
#include "heightlight/error.h"
#include "user_form/user_form.h"

namespace {

/// No '$' of a template that was not filled in.
void check_shader(const std::string& text) {
  heightlight::require(text.find_first_of("$@") == std::string::npos,
                       "a shader has no place that is not filled in");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace heightlight;
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    const UserForm form = parse_user_form(text);
    const std::vector<double> constants(form.expression.constants.size(), 0.7);
    ModelInputs inputs;
    inputs.sky_view_factor = SkyViewFactor(0.3);
    inputs.ambient_occlusion = AmbientOcclusion(0.4);
    inputs.seen = SeenSkyViewFactor(0.5);
    evaluate(form, inputs, 0.8, constants);
    const std::vector<ShaderFunction> functions = user_form_functions(form, constants);
    for (const ShaderLanguageName& one : kShaderLanguages)
      check_shader(print_shader(functions, one.language));
  } catch (const UsageError& error) {
    require(std::string(error.what()).find('\n') == std::string::npos, "an error is one line");
  }
  return 0;
}
