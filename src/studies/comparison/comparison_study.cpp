#include "comparison/comparison_study.h"

#include <utility>

#include "comparison/far_field.h"

namespace heightlight {
namespace {

/// With what making it costs.
DepthBuffer make_depth(const Surface& surface, Cost& cost) {
  const Stopwatch watch;
  DepthBuffer depth = make_depth_buffer(surface);
  cost = watch.elapsed();
  return depth;
}

}  // namespace

ComparisonStudy::ComparisonStudy(const Surface& surface, ComparisonOptions options)
    : albedos(std::move(options.albedos)),
      depth(make_depth(surface, depth_cost)),
      reference(build_reference(surface, {.azimuths = options.azimuths,
                                          .sky = std::move(options.sky),
                                          .albedos = albedos,
                                          .memory = options.memory,
                                          .seed = options.seed,
                                          .watch = options.watch})),
      far_field(bake_far_field(surface, options.memory)),
      scene{.surface = surface,
            .depth = depth,
            .albedos = albedos,
            .far_field = &far_field,
            .memory = options.memory,
            .seed = options.seed} {
  for (const UserForm& form : options.own_forms) {
    own_forms.push_back(fit_on_map(form, scene, reference));
    scene.forms.push_back(to_closed_form(form, own_forms.back().constants));
  }
  comparison = compare_methods(scene, reference, make_contenders(scene), options.watch);
  answer = find_answer(comparison, scene);
}

}  // namespace heightlight
