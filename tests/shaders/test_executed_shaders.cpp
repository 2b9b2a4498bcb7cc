#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "shaders/compute_device.h"
#include "shaders/shader_print.h"
#include "shaders/shader_program.h"
#include "shaders/shader_samples.h"
#include "shaders/trial_function.h"
#include "user_form/user_form.h"

// The text that is emitted, compiled by glslang, executed on Vulkan by Mesa's lavapipe, and compared with the
// C++.

namespace heightlight {
namespace {

constexpr std::size_t kSamples = 100032;      ///< 10⁵, in groups of 64
constexpr std::size_t kMutantSamples = 8192;  ///< edges, and some

/// What executes shaders; nothing, loudly, where something of it is missing.
ComputeDevice* device() {
  static std::string why_not;
  static const std::unique_ptr<ComputeDevice> opened = [] {
    for (const char* command : {"glslangValidator", "spirv-val"}) {
      if (has_command(command)) continue;
      why_not = std::string("no ") + command + " here";
      return std::unique_ptr<ComputeDevice>();
    }
    return open_compute_device(why_not);
  }();
  if (!opened)
    WARN("SKIPPED: shaders are not executed: " << why_not << " (scripts/install-packages --tests)");
  return opened.get();
}

/// What a function does with samples, and how far that is from what it should.
struct Execution {
  std::string fault = {};    ///< of its compilation
  double ulps = 0;           ///< greatest difference, in units of 2⁻²³; infinite where a number is none
  std::size_t jumped = 0;    ///< samples that differ by more than they may
  std::size_t compared = 0;  ///< results whose C++ is finite
  std::string worst = {};
};

Execution execute(ComputeDevice& compute, const std::string& text, const ShaderFunction& function,
                  ShaderLanguage language, std::size_t samples) {
  Execution execution;
  const std::vector<std::uint32_t> spirv =
      compile_program(program_text(text, function, language), language, execution.fault);
  if (spirv.empty()) return execution;
  const std::vector<float> inputs = sample_inputs(function, samples);
  const std::vector<float> found = compute.run(spirv, inputs, samples, function.components);
  const auto floats = static_cast<std::size_t>(input_floats(function));
  const auto components = static_cast<std::size_t>(function.components);
  std::vector<float> expected(components);
  for (std::size_t i = 0; i < samples; ++i) {
    function.evaluate(&inputs[i * floats], expected.data());
    bool jumps = false;
    for (std::size_t c = 0; c < components; ++c) {
      if (!std::isfinite(expected[c])) continue;
      const double value = double{found[i * components + c]};
      const double ulps = std::abs(value - double{expected[c]}) * 8388608;
      ++execution.compared;
      jumps = jumps || !(ulps <= function.ulps);
      if (ulps <= execution.ulps) continue;
      execution.ulps = std::isnan(ulps) ? std::numeric_limits<double>::infinity() : ulps;
      execution.worst =
          Catch::Detail::stringify(std::vector<float>(&inputs[i * floats], &inputs[(i + 1) * floats])) +
          " gives " + std::to_string(value) + ", not " + std::to_string(expected[c]);
    }
    if (jumps) ++execution.jumped;
  }
  return execution;
}

bool agrees(const Execution& execution, const ShaderFunction& function, std::size_t samples) {
  return execution.fault.empty() &&
         static_cast<double>(execution.jumped) <= function.jumps * static_cast<double>(samples);
}

void check_functions(ComputeDevice& compute, const std::string& text,
                     const std::vector<ShaderFunction>& functions, ShaderLanguage language) {
  for (const ShaderFunction& one : functions) {
    std::vector<ShaderFunction> forms{one};
    if (one.is_per_channel) forms.push_back(for_three_albedos(one, language));
    for (const ShaderFunction& function : forms) {
      const Execution execution = execute(compute, text, function, language, kSamples);
      CAPTURE(function.name, execution.fault, execution.ulps, execution.jumped, execution.worst);
      CHECK(execution.compared > kSamples / 2);
      CHECK(agrees(execution, function, kSamples));
    }
  }
}

/// Where numbers of the code stand, comments left out.
struct NumberPlace {
  std::size_t begin;
  std::size_t end;
};

std::vector<NumberPlace> find_numbers(const std::string& text) {
  const auto is_word = [&](std::size_t i) {
    return std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_';
  };
  std::vector<NumberPlace> places;
  for (std::size_t i = 0; i < text.size();) {
    if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    const std::size_t begin = i;
    if (!is_word(i)) {
      ++i;
      continue;
    }
    const bool is_number = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    while (i < text.size() && (is_word(i) || (is_number && text[i] == '.') ||
                               (is_number && text[i - 1] == 'e' && text[i] == '-')))
      ++i;
    if (is_number) places.push_back({begin, i});
  }
  return places;
}

/// The text with one number changed by a hundredth of it, or of 1 where it is 0; a whole number by 1.
std::string mutate(const std::string& text, const NumberPlace& place) {
  const std::string number = text.substr(place.begin, place.end - place.begin);
  const double value = std::stod(number);
  const bool is_whole = number.find_first_of(".e") == std::string::npos;
  const std::string changed =
      is_whole ? std::to_string(std::stoi(number) + 1) : std::to_string(value == 0 ? 0.01 : 1.01 * value);
  return text.substr(0, place.begin) + changed + text.substr(place.end);
}

/// The function in whose body a place lies.
const ShaderFunction* function_at(const std::string& text, std::size_t place,
                                  const std::vector<ShaderFunction>& functions) {
  const ShaderFunction* last = nullptr;
  std::size_t last_head = 0;
  for (const ShaderFunction& function : functions) {
    const std::size_t head = text.find(' ' + function.name + '(', text.find("\nfloat heightlight_share("));
    if (head > place || head < last_head) continue;
    last_head = head;
    last = &function;
  }
  return last;
}

/// Every number of the text matters: the comparison tells a change of any by a hundredth.
void check_mutants(ComputeDevice& compute, const std::string& text,
                   const std::vector<ShaderFunction>& functions, ShaderLanguage language) {
  const std::vector<NumberPlace> numbers = find_numbers(text);
  CHECK(numbers.size() >= 40);
  for (const NumberPlace& number : numbers) {
    const ShaderFunction* function = function_at(text, number.begin, functions);
    REQUIRE(function != nullptr);
    const Execution execution = execute(compute, mutate(text, number), *function, language, kMutantSamples);
    CAPTURE(function->name, text.substr(number.begin - 20, 50), execution.fault, execution.ulps,
            execution.jumped);
    CHECK(execution.fault.empty());
    CHECK_FALSE(agrees(execution, *function, kMutantSamples));
  }
}

ShaderConstants other_constants() {
  ShaderConstants constants;
  constants.notes = {0.41, 1, 20.5, 3.1};
  constants.cubic = {1.9, -0.31, 4.5, -0.6, 2.6, 0.71};
  constants.seen.offset = 0.0625;
  constants.seen.map_offset = -0.011;
  constants.seen.map_curvature = -0.2;
  constants.seen.blur_offset = 0.013;
  return constants;
}

std::vector<ShaderFunction> own_functions() {
  std::vector<ShaderFunction> functions;
  const auto add = [&](const std::string& text, const std::vector<double>& constants) {
    for (ShaderFunction& function : user_form_functions(parse_user_form(text), constants))
      functions.push_back(std::move(function));
  };
  add("curved = A/(1 - 0.9*rho*(1 - A)^k)", {1.25});
  add("twisted = mix(alpha, 1, saturate(c1*rho)) - mod(-alpha, 3)/4", {0.75});
  add("all_inputs = A + rho*(1 - A)*n*exp(-alpha)/(1.5 - rho*(1 - n))", {});
  add("powers = (A - 0.5)^2 + (rho - 0.7)^3 + A^rho/4", {});
  add("functions = sqrt(A)*rsqrt(1 + rho) + frac(3*A)/8 + log2(1 + A) + cos(rho)", {});
  return functions;
}

const std::vector<ShaderLanguage> kExecuted{ShaderLanguage::glsl, ShaderLanguage::hlsl,
                                            ShaderLanguage::godot};

}  // namespace

TEST_CASE("the shaders of the library, executed, are equal to the C++", "[shaders][slow]") {
  ComputeDevice* compute = device();
  if (!compute) return;
  for (const ShaderLanguage language : kExecuted)
    check_functions(*compute, shader_library(language), shader_functions(), language);
}

TEST_CASE("the shaders of a fit and of users' forms, executed, are equal to the C++", "[shaders][slow]") {
  ComputeDevice* compute = device();
  if (!compute) return;
  std::vector<ShaderFunction> functions = fitted_shader_functions(other_constants());
  for (ShaderFunction& function : own_functions()) functions.push_back(std::move(function));
  for (const ShaderLanguage language : kExecuted)
    check_functions(*compute, shader_text(language, other_constants(), own_functions()), functions, language);
}

TEST_CASE("loops and arrays of shaders, executed, are what they are in C++", "[shaders][slow]") {
  ComputeDevice* compute = device();
  if (!compute) return;
  const std::vector<ShaderFunction> trial{trial_function()};
  for (const ShaderLanguage language : kExecuted)
    check_functions(*compute, print_shader(trial, language), trial, language);
}

TEST_CASE("the shader beside ao-n maps, executed, is bounced_total", "[shaders][slow]") {
  ComputeDevice* compute = device();
  if (!compute) return;
  for (const ShaderFunction& function : shader_functions()) {
    if (function.name != "multi_bounce") continue;
    for (const ShaderLanguage language : {ShaderLanguage::glsl, ShaderLanguage::hlsl})
      check_functions(*compute, stored_pair_shader(language), {function}, language);
  }
}

TEST_CASE("a hundredth more in any number of a shader is found", "[shaders][deep]") {
  ComputeDevice* compute = device();
  if (!compute) return;
  const auto language = GENERATE(ShaderLanguage::glsl, ShaderLanguage::hlsl);
  check_mutants(*compute, shader_library(language), shader_functions(), language);
}

}  // namespace heightlight
