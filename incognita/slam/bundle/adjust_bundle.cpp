#include "incognita/slam/bundle/adjust_bundle.hpp"

#include <algorithm>

namespace incognita {
namespace {

/// The bundle after a step.
void apply(const BundleEquations& equations, Bundle& bundle) {
  for (std::size_t i = 0; i < bundle.views.size(); ++i) {
    const Eigen::Matrix<double, 6, 1> step = equations.view_step(static_cast<int>(i));
    BundleView& view = bundle.views[i];
    view.position += step.head<3>();
    view.world_from_camera =
        quaternion_product(view.world_from_camera, quaternion_exp<double>(step.tail<3>())).normalized();
  }
  for (std::size_t i = 0; i < bundle.points.size(); ++i)
    if (bundle.points[i].kind != BundlePoint::Kind::fixed)
      bundle.points[i].value += equations.point_step(static_cast<int>(i));
}

}  // namespace

AdjustmentReport adjust(Bundle& bundle, const Camera& camera, const AdjustmentSettings& settings,
                        BundleEquations& equations) {
  constexpr double first_damping = 1e-5, least_damping = 1e-9, most_damping = 1e6;
  const Bundle before = bundle;
  AdjustmentReport report;
  report.first_cost = report.last_cost = cost_of(bundle, camera, settings.robust);
  equations.linearize(bundle, camera, settings.robust);
  double damping = first_damping;
  report.outcome = AdjustmentReport::Outcome::stopped;
  while (report.iterations < settings.max_iterations) {
    Bundle next = bundle;
    double cost = report.last_cost;
    if (equations.factorize(damping)) {
      equations.solve();
      apply(equations, next);
      cost = cost_of(next, camera, settings.robust);
    }
    ++report.iterations;
    if (!(cost < report.last_cost)) {
      damping *= 10;
      if (damping < most_damping) continue;
      report.outcome = AdjustmentReport::Outcome::converged;
      break;
    }
    const bool done = report.last_cost - cost < settings.min_relative_decrease * report.last_cost;
    bundle = std::move(next);
    report.last_cost = cost;
    damping = std::max(damping / 10, least_damping);
    equations.linearize(bundle, camera, settings.robust);
    if (!done) continue;
    report.outcome = AdjustmentReport::Outcome::converged;
    break;
  }
  if (!equations.factorize(0)) {
    bundle = before;
    report.outcome = AdjustmentReport::Outcome::refused;
  }
  return report;
}

}  // namespace incognita
