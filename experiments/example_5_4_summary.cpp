#include <algorithm>
#include <cmath>

#include "experiments/example_5_4.hpp"
#include "experiments/seeds.hpp"
#include "incognita/analysis/evaluation/trajectory.hpp"

namespace incognita::swinging_camera {
namespace {

double most_m_s2(const Instant& i) { return i.command.head<3>().cwiseAbs().maxCoeff(); }
double most_rad_s2(const Instant& i) { return i.command.tail<3>().cwiseAbs().maxCoeff(); }

bool is_at_limit(const Instant& i) {
  constexpr double share = 0.9999;  // of the limit
  const ControlSettings limits;
  return most_m_s2(i) >= share * limits.max_acceleration_m_s2 ||
         most_rad_s2(i) >= share * limits.max_angular_acceleration_rad_s2;
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

template <class Of>
double mean(const std::vector<Instant>& instants, const Of& of) {
  return mean_of(each(instants, of)).value;
}

void add_all(const std::vector<Instant>& all, Summary& s) {
  s.lost = std::ranges::any_of(all, &Instant::lost);
  s.rms_error_m = rms_of(each(all, &Instant::position_error_m)).value;
  for (int k = 0; k < 6; ++k)
    s.inside[static_cast<std::size_t>(k)] =
        mean(all, [&](const Instant& i) { return std::abs(i.error[k]) <= 2 * i.sigma[k]; });
  s.pose_nees = mean(all, &Instant::pose_nees);
  std::vector<double> nis = each(all, &Instant::nis);
  std::erase(nis, 0);  // ticks without a measurement
  s.nis = mean_of(nis).value;
  s.last_sigma_angle_rad = all.back().sigma.tail<3>().norm() / std::sqrt(3.0);
  for (const Instant& i : all)
    if (i.t >= static_cast<double>(s.error_m.size()))
      s.error_m.push_back(i.position_error_m()), s.sigma_m.push_back(i.sigma_position_m());
}

void add_settled(const std::vector<Instant>& settled, Summary& s) {
  const auto quantile_of = [&](double share, const auto& of) { return quantile(each(settled, of), share); };
  const auto gaze_off = [](const Instant& i) { return gaze_off_rad(i.truth, i.reference); };
  s.estimated_off_m = quantile_of(0.5, &Instant::estimated_off_m);
  s.estimated_off_95_m = quantile_of(0.95, &Instant::estimated_off_m);
  s.truly_off_m = quantile_of(0.5, &Instant::truly_off_m);
  s.truly_off_95_m = quantile_of(0.95, &Instant::truly_off_m);
  s.most_off_m = quantile_of(1, &Instant::truly_off_m);
  s.estimated_off_rms_m = rms_of(each(settled, &Instant::estimated_off_m)).value;
  s.truly_off_rms_m = rms_of(each(settled, &Instant::truly_off_m)).value;
  s.gaze_off_95_rad = quantile_of(0.95, gaze_off);
  s.least_sigma_m = quantile_of(0, &Instant::sigma_position_m);
  s.most_sigma_m = quantile_of(1, &Instant::sigma_position_m);
  s.at_limit = mean(settled, is_at_limit);
  s.most_m_s2 = quantile_of(1, most_m_s2), s.most_rad_s2 = quantile_of(1, most_rad_s2);
}

std::ptrdiff_t near_path(const std::vector<Summary>& runs) {
  return std::ranges::count_if(runs, [](const Summary& s) { return s.most_off_m <= near_path_m; });
}

}  // namespace

Summary summary(const Course& course) {
  std::vector<Instant> at_first, settled;
  std::ranges::partition_copy(course.instants, std::back_inserter(at_first), std::back_inserter(settled),
                              [](const Instant& i) { return i.t < settled_s; });
  Summary s;
  add_all(course.instants, s);
  add_settled(settled, s);
  s.at_limit_at_first = mean(at_first, is_at_limit);
  s.scale_off = scale_off(course);
  s.mapped = static_cast<int>(course.map.size());
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

double mean(const std::vector<Summary>& runs, double Summary::*what) {
  return mean_of(each(runs, what)).value;
}

double share_near_path(const std::vector<Summary>& runs) {
  return static_cast<double>(near_path(runs)) / static_cast<double>(runs.size());
}

ClaimNumber followers(std::string what, const std::vector<Summary>& runs) {
  const Interval share = share_of(static_cast<std::size_t>(near_path(runs)), runs.size());
  return {std::move(what), {100 * share.value, 100 * share.low, 100 * share.high}, "%"};
}

Answer follows(const std::vector<Summary>& runs) { return happens_in(0.95, near_path(runs), runs.size()); }

int fewer(const ExperimentSettings& settings) { return std::max(5, settings.seeds / 5); }

}  // namespace incognita::swinging_camera
