#include "comparison/rendered_forms.h"

#include <cmath>

#include "comparison/closed_form_totals.h"
#include "comparison/form_panels.h"

namespace heightlight {
namespace {

/// Which albedos are the three channels of the picture.
std::array<std::size_t, 3> picture_channels(const std::vector<ComparedAlbedo>& albedos) {
  const bool is_colour = albedos.size() == 3 && albedos[0].label == "R" && albedos[2].label == "B";
  if (is_colour) return {0, 1, 2};
  const std::size_t last = albedos.size() - 1;
  return {last, last, last};
}

/// albedo × E/π; texels where the form has no value are as bright as in the open.
Map reflect(const Map& total, const ComparedAlbedo& albedo) {
  Map reflected(total.width, total.height);
  for (std::size_t i = 0; i < total.size(); ++i) {
    const float light = std::isnan(total.values[i]) ? 1.0F : total.values[i];
    reflected.values[i] = static_cast<float>(albedo.reflectance[i]) * light;
  }
  return thin_out(reflected);
}

const ClosedForm* find_form(const std::vector<ClosedForm>& forms, const std::string& name) {
  for (const ClosedForm& form : forms) {
    if (form.name == name) return &form;
  }
  return nullptr;
}

}  // namespace

std::vector<RenderedForm> render_forms(const std::string& role, const Estimate& estimate,
                                       const ComparedScene& scene, const ComparisonReference& reference) {
  const std::array<std::size_t, 3> channels = picture_channels(scene.albedos);
  std::vector<RenderedForm> rendered;
  const auto render = [&](const std::string& label, const auto& total_at) {
    RenderedForm& one = rendered.emplace_back();
    one.title = role;
    one.label = label;
    double squares = 0;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const std::size_t albedo = channels[c];
      if (c > 0 && albedo == channels[0]) {  // grey
        one.reflected[c] = one.reflected[0];
        squares += one.rmse * one.rmse;
        continue;
      }
      const Map total = total_at(albedo);
      one.reflected[c] = reflect(total, scene.albedos[albedo]);
      const double rmse = measure(subtract(total, reference.totals[albedo])).rmse;
      squares += rmse * rmse;
      if (c == 0) one.rmse = rmse;
    }
    one.rmse = std::sqrt(squares / static_cast<double>(channels.size()));
  };
  render("no AO",
         [&](std::size_t) { return Map(reference.totals[0].width, reference.totals[0].height, 1.0F); });
  for (const AnsweringForm& answering : answering_forms(scene.forms)) {
    const ClosedForm* form = find_form(scene.forms, answering.form);
    if (form && can_evaluate(*form, estimate)) {
      render(answering.label, [&](std::size_t albedo) {
        return evaluate_closed_form(*form, estimate, scene.surface, scene.albedos[albedo]);
      });
    } else {
      rendered.push_back({.title = role, .label = answering.label});
    }
  }
  render("truth", [&](std::size_t albedo) { return reference.totals[albedo]; });
  return rendered;
}

}  // namespace heightlight
