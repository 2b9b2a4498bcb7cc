#include <pybind11/stl.h>

#include <limits>

#include "expression/expression.h"
#include "heightlight/closed_forms.h"
#include "heightlight/error.h"
#include "heightlight/shaders.h"
#include "python/arrays.h"
#include "python/bindings.h"
#include "user_form/user_form.h"

namespace heightlight {
namespace {

/// The inputs of a form, by their names in Python.
std::vector<std::string> inputs_of(AoKind kind, ExtraInput extra, bool both_kinds) {
  std::vector<std::string> inputs;
  if (kind == AoKind::ambient_occlusion || both_kinds) inputs.emplace_back("alpha");
  if (kind == AoKind::sky_view_factor || both_kinds) inputs.emplace_back("A");
  switch (extra) {
    case ExtraInput::none:
      break;
    case ExtraInput::expected_seen:
      inputs.emplace_back("s");
      break;
    case ExtraInput::deep_seen:
      inputs.emplace_back("t");
      break;
    case ExtraInput::blurred:
      inputs.emplace_back("W");
      break;
    case ExtraInput::seen:
      inputs.emplace_back("n");
      break;
  }
  return inputs;
}

/// The inputs of the i-th texel; 0 for inputs that are not given.
ModelInputs read_inputs(const std::map<std::string, Array<double>>& values, py::ssize_t i) {
  const auto at = [&](const char* name) {
    const auto found = values.find(name);
    return found == values.end() ? 0.0 : found->second.data()[i];
  };
  return {.ambient_occlusion = AmbientOcclusion<double>(at("alpha")),
          .sky_view_factor = SkyViewFactor<double>(at("A")),
          .expected_seen = SeenSkyViewFactor<double>(at("s")),
          .deep_seen = SeenSkyViewFactor<double>(at("t")),
          .blurred = SeenSkyViewFactor<double>(at("W")),
          .seen = SeenSkyViewFactor<double>(at("n"))};
}

/// Calls value(inputs, albedo) for each index; all arrays have the same length.
template <class Value>
py::array_t<double> for_each(const std::map<std::string, Array<double>>& values, const Array<double>& albedo,
                             Value&& value) {
  for (const auto& [name, array] : values) {
    if (array.size() != albedo.size()) throw UsageError(name, "", "has another length than the albedo");
  }
  std::vector<double> totals(static_cast<std::size_t>(albedo.size()));
  {
    const py::gil_scoped_release release;
    for (py::ssize_t i = 0; i < albedo.size(); ++i)
      totals[static_cast<std::size_t>(i)] = value(read_inputs(values, i), albedo.data()[i]);
  }
  return take_array(std::move(totals), {albedo.size()});
}

const ClosedForm& find_form(const std::string& name) {
  std::string known;
  for (const ClosedForm& form : closed_forms()) {
    if (form.name == name) return form;
    known += (known.empty() ? "" : ", ") + form.name;
  }
  throw UsageError("form", name, "is none of " + known);
}

py::array_t<double> evaluate_form(const std::string& name, const Array<double>& albedo,
                                  const std::map<std::string, Array<double>>& values) {
  const ClosedForm& form = find_form(name);
  return for_each(values, albedo, [&](const ModelInputs& inputs, double rho) {
    return form.evaluate(inputs, rho).value_or(std::numeric_limits<double>::quiet_NaN());
  });
}

ShaderLanguage find_language(const std::string& name) {
  for (const ShaderLanguageName& known : kShaderLanguages) {
    if (name == known.name) return known.language;
  }
  throw UsageError("language", name, "must be glsl, hlsl, wgsl or godot");
}

py::list list_forms() {
  py::list forms;
  for (const ClosedForm& form : closed_forms()) {
    py::dict one;
    one["name"] = form.name;
    one["formula"] = form.description;
    one["source"] = form.source;
    one["inputs"] = inputs_of(form.kind, form.extra, form.both_kinds);
    forms.append(one);
  }
  return forms;
}

void add_user_form(py::module_& module) {
  py::class_<UserForm>(module, "UserForm")
      .def(py::init([](const std::string& text) { return parse_user_form(text); }), py::arg("text"))
      .def_readonly("name", &UserForm::name)
      .def_property_readonly("formula", [](const UserForm& form) { return form.expression.text; })
      .def_property_readonly("constants", [](const UserForm& form) { return form.expression.constants; })
      .def_property_readonly("inputs",
                             [](const UserForm& form) {
                               return inputs_of(user_form_kind(form), user_form_extra(form),
                                                wants_both_kinds(form));
                             })
      .def(
          "evaluate",
          [](const UserForm& form, const Array<double>& albedo,
             const std::map<std::string, Array<double>>& values, const std::vector<double>& constants) {
            if (constants.size() != form.expression.constants.size())
              throw UsageError("constants", "", "are not as many as the form has");
            return for_each(values, albedo, [&](const ModelInputs& inputs, double rho) {
              return evaluate(form, inputs, rho, constants);
            });
          },
          py::arg("albedo"), py::arg("values"), py::arg("constants"))
      .def(
          "shader",
          [](const UserForm& form, const std::string& language, const std::vector<double>& constants) {
            if (constants.size() != form.expression.constants.size())
              throw UsageError("constants", "", "are not as many as the form has");
            return own_shader(user_form_functions(form, constants), find_language(language));
          },
          py::arg("language"), py::arg("constants"));
}

}  // namespace

void add_forms(py::module_& module) {
  module.def("list_forms", list_forms);
  module.def("evaluate_form", evaluate_form, py::arg("name"), py::arg("albedo"), py::arg("values"));
  module.def(
      "form_shader",
      [](const std::string& name, const std::string& language) {
        return form_shader(name, find_language(language));
      },
      py::arg("name"), py::arg("language"));
  module.def(
      "all_shaders", [](const std::string& language) { return shader_text(find_language(language), {}); },
      py::arg("language"));
  module.def("expected_seen", [](const Surface& surface, const Array<float>& sky) {
    check_shape(sky, "A", surface.height(), surface.width());
    Map map(surface.width(), surface.height());
    std::copy(sky.data(), sky.data() + sky.size(), map.values.begin());
    return expected_seen(map, surface).value;
  });
  module.def("blur_seen", [](const Array<float>& sky, bool tiles, double sigma) {
    if (sky.ndim() != 2) throw UsageError("A", "", "must have two dimensions");
    Map map(static_cast<int>(sky.shape(1)), static_cast<int>(sky.shape(0)));
    std::copy(sky.data(), sky.data() + sky.size(), map.values.begin());
    const py::gil_scoped_release release;
    Map blurred = blur_seen(map, tiles, sigma);
    const py::gil_scoped_acquire acquire;
    return take_map(std::move(blurred));
  });
  add_user_form(module);
}

}  // namespace heightlight
