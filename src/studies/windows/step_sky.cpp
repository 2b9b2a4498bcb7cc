#include "visibility/horizon_sky.h"
#include "windows/sky_maps.h"
#include "windows/steps.h"

namespace heightlight {

void find_window_sky(Work& work, int window) {
  const BakeOptions& options = work.task.options;
  const SkyPlan& plan = plan_at_hand(work).sky;
  const bool refines = !work.state.refined.empty();
  const Surface surface = surface_of_window(work, window, {plan.walk});
  const SkyTask task{
      .wanted = sky_wanted(options), .maximum_distance = options.maximum_distance, .below = options.below};
  const HorizonSky sky = walk_horizon_sky(surface, {}, plan, refines ? SkyTask{} : task, options.watch);
  if (refines)
    return write_window(lighting_folder(work), window, {&sky.sky_view_factor, &sky.ambient_occlusion});
  const std::vector<Map> maps = kept_sky_maps(sky, options);
  std::vector<const Map*> written;
  for (const Map& map : maps) written.push_back(&map);
  write_window(sky_folder(work), window, written);
}

}  // namespace heightlight
