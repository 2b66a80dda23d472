#include <algorithm>
#include <cmath>

#include "experiments/example_5_4.hpp"
#include "experiments/seeds.hpp"
#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita::swinging_camera {
namespace {

constexpr double at_limit_share = 0.9999;  // of the limit

bool is_at_limit(const Vector6& command) {
  const ControlSettings limits;
  return command.head<3>().cwiseAbs().maxCoeff() >= at_limit_share * limits.max_acceleration_m_s2 ||
         command.tail<3>().cwiseAbs().maxCoeff() >= at_limit_share * limits.max_angular_acceleration_rad_s2;
}

/// Estimated lengths times this are true ones, less 1.
double scale_off(const Course& course) {
  MatchedTrajectories both;
  for (const Instant& i : course.instants) {
    both.estimate.push_back({i.t, i.mean.head<3>()});
    both.truth.push_back({i.t, i.truth.head<3>()});
  }
  const auto alignment = align(both, AlignmentKind::sim3);
  return alignment ? alignment->scale - 1 : 0;
}

void add_map(const Course& course, Summary& s) {
  std::vector<double> off, sigma;
  for (const MappedPoint& p : course.map) {
    off.push_back((p.estimated - p.truth).norm());
    sigma.push_back(std::sqrt(p.covariance.trace()));
  }
  s.mapped = static_cast<int>(course.map.size());
  if (course.map.empty()) return;
  s.map_off_m = quantile(off, 0.5);
  s.map_sigma_m = quantile(sigma, 0.5);
}

void add_settled(const Course& course, Summary& s) {
  std::vector<double> estimated, truth, gaze;
  double limited = 0, limited_at_first = 0, at_first = 0;
  s.least_sigma_m = 1e9;
  for (const Instant& i : course.instants) {
    if (i.t < settled_s) {
      limited_at_first += is_at_limit(i.command), ++at_first;
      continue;
    }
    estimated.push_back(i.estimated_off_m());
    truth.push_back(i.truly_off_m());
    gaze.push_back(gaze_off_rad(i.truth, i.reference));
    limited += is_at_limit(i.command);
    s.most_m_s2 = std::max(s.most_m_s2, i.command.head<3>().cwiseAbs().maxCoeff());
    s.most_rad_s2 = std::max(s.most_rad_s2, i.command.tail<3>().cwiseAbs().maxCoeff());
    s.least_sigma_m = std::min(s.least_sigma_m, i.sigma_position_m());
    s.most_sigma_m = std::max(s.most_sigma_m, i.sigma_position_m());
  }
  s.at_limit = limited / static_cast<double>(estimated.size());
  s.at_limit_at_first = limited_at_first / at_first;
  s.estimated_off_m = quantile(estimated, 0.5), s.estimated_off_95_m = quantile(estimated, 0.95);
  s.truly_off_m = quantile(truth, 0.5), s.truly_off_95_m = quantile(truth, 0.95);
  s.most_off_m = quantile(truth, 1);
  s.gaze_off_95_rad = quantile(gaze, 0.95);
}

}  // namespace

Summary summary(const Course& course) {
  Summary s;
  double squares = 0, measurements = 0;
  for (const Instant& i : course.instants) {
    const double error = i.position_error_m();
    squares += error * error;
    s.worst_error_m = std::max(s.worst_error_m, error);
    for (int k = 0; k < 6; ++k)
      s.inside[static_cast<std::size_t>(k)] += std::abs(i.error[k]) <= 2 * i.sigma[k];
    s.pose_nees += i.pose_nees;
    if (i.nis > 0) s.nis += i.nis, ++measurements;
    s.lost = s.lost || i.lost;
    if (i.t >= static_cast<double>(s.error_m.size()))
      s.error_m.push_back(error), s.sigma_m.push_back(i.sigma_position_m());
  }
  const auto count = static_cast<double>(course.instants.size());
  for (double& share : s.inside) share /= count;
  s.rms_error_m = std::sqrt(squares / count);
  s.pose_nees /= count;
  s.nis /= measurements;
  s.last_sigma_angle_rad = course.instants.back().sigma.tail<3>().norm() / std::sqrt(3.0);
  s.scale_off = scale_off(course);
  add_settled(course, s);
  add_map(course, s);
  return s;
}

std::vector<Summary> runs(const Setup& setup, int seeds) {
  return over_seeds(seeds, [&](std::uint64_t seed) { return summary(run(setup, seed)); });
}

double quantile(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

double median(const std::vector<Summary>& runs, double Summary::*what) {
  return quantile(each(runs, what), 0.5);
}

double mean_of_runs(const std::vector<Summary>& runs, double Summary::*what) {
  double sum = 0;
  for (const Summary& s : runs) sum += s.*what;
  return sum / static_cast<double>(runs.size());
}

double share_near_path(const std::vector<Summary>& runs) {
  const auto near = std::ranges::count_if(runs, [](const Summary& s) { return s.most_off_m <= near_path_m; });
  return static_cast<double>(near) / static_cast<double>(runs.size());
}

Finding follows(const std::vector<Summary>& runs) {
  const auto near = std::ranges::count_if(runs, [](const Summary& s) { return s.most_off_m <= near_path_m; });
  return happens_in(0.95, near, runs.size());
}

int fewer(const ExperimentSettings& settings) { return std::max(5, settings.seeds / 5); }

}  // namespace incognita::swinging_camera
