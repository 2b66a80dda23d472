#include "incognita/slam/bundle/flat_start.hpp"

#include <algorithm>
#include <vector>

#include "incognita/math/median.hpp"

namespace incognita {

void put_on_rays(Bundle& bundle, const Camera& camera, double inverse_depth) {
  for (const BundleObservation& seen : bundle.observations) {
    BundlePoint& point = bundle.points[static_cast<std::size_t>(seen.point)];
    if (point.kind != BundlePoint::Kind::inverse_depth || seen.view != point.host) continue;
    if (const auto ray = camera.unproject(seen.pixel)) point.value.head<2>() = ray->head<2>();
    point.initial_axes = bundle.views[static_cast<std::size_t>(seen.view)].world_from_camera;
    point.value[2] = inverse_depth;
  }
}

namespace {

void put_views_at_first(Bundle& bundle) {
  for (BundleView& view : bundle.views) {
    if (view.fixed) continue;
    view.position = bundle.views.front().position;
    view.world_from_camera = bundle.views.front().world_from_camera;
  }
}

bool is_inverse_depth(const BundlePoint& point) { return point.kind == BundlePoint::Kind::inverse_depth; }

}  // namespace

Bundle flat_start(Bundle bundle, const Camera& camera) {
  std::vector<double> priors;
  for (const BundlePoint& point : bundle.points)
    if (is_inverse_depth(point)) priors.push_back(point.prior_inverse_depth);
  put_views_at_first(bundle);
  if (!priors.empty()) put_on_rays(bundle, camera, median(priors));
  return bundle;
}

Bundle reversed_start(Bundle bundle, const Camera& camera) {
  constexpr double least_share = 0.05, most_times = 20;  // of the median
  std::vector<double> values, inverse_depths;
  for (const BundlePoint& point : bundle.points) values.push_back(point.value[2]);
  for (const BundlePoint& point : bundle.points)
    if (is_inverse_depth(point)) inverse_depths.push_back(point.value[2]);
  if (inverse_depths.empty()) return bundle;
  const double middle = median(inverse_depths);
  put_views_at_first(bundle);
  put_on_rays(bundle, camera, middle);
  for (std::size_t i = 0; i < bundle.points.size(); ++i)
    if (is_inverse_depth(bundle.points[i]))
      bundle.points[i].value[2] =
          std::clamp(2 * middle - values[i], least_share * middle, most_times * middle);
  return bundle;
}

}  // namespace incognita
