#include "experiments/recorded_team.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "experiments/processor_time.hpp"
#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/recordings/range_formats.hpp"
#include "incognita/math/largest_sigma.hpp"

namespace incognita::recorded_team {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

BodyModel member_of(const RangeRecording& robot, double start_t, const Setup& setup) {
  BodyModel member = body_with_sensor(DifferentialDrive{}, RangeBearingSensor{}, {}, {}, {}, {});
  auto place = true_position(robot, start_t);
  for (double t = start_t; !place; t += 0.1) place = true_position(robot, t);
  member.start = Vector3d(place->position.x(), place->position.y(), *place->heading_rad);
  member.start_sigmas = Vector3d::Constant(0.01);
  member.input_sigmas = setup.input_sigmas_times * Vector2d(0.1, 0.5);
  member.sensors[0].sigmas = setup.sensor_sigmas_times * Vector2d(0.1, 0.02);
  member.sensors[0].sigma_range_ratio = setup.sensor_sigmas_times * 0.03;
  return member;
}

EstimatorSettings settings_of(const Robots& robots, double start_t, const Setup& setup) {
  EstimatorSettings settings;
  settings.filter.linearization = setup.linearization;
  settings.filter.gate_probability = 0.999;
  for (const RangeRecording& robot : robots) settings.bodies.push_back(member_of(robot, start_t, setup));
  return settings;
}

/// Records a drive while the estimator runs.
class Driver {
 public:
  Driver(const Robots& robots, const Setup& setup)
      : robots_(robots), recordings_(std::make_shared<const Robots>(robots)), setup_(setup) {
    drive_.robots.resize(robots.size());
  }

  Drive run() {
    ReplayClock clock(scan_times(*recordings_, duration_s));
    SensorSet sensors = recorded_ranges(recordings_, {.measures_vehicles = setup_.see_each_other});
    Tick tick = clock.next();
    const double start_t = tick.t;
    SlamEstimator estimator(settings_of(robots_, start_t, setup_));
    Estimate estimate;
    double matched_t = start_t;
    for (; tick; tick = clock.next()) {
      const Observation observation = sensors.measure({}, tick);
      const double before = processor_seconds();
      estimator.update(estimate, {}, observation, tick);
      drive_.took_s += processor_seconds() - before;
      drive_.recorded_s = tick.t - start_t;
      drive_.longest_blind_s = std::max(drive_.longest_blind_s, tick.t - matched_t);
      if (estimate.last.matched > 0) matched_t = tick.t;
      count(estimate);
      for (std::size_t i = 0; i < robots_.size(); ++i) compare(estimate, i, tick.t, start_t);
    }
    finish(estimate);
    return drive_;
  }

 private:
  void count(const Estimate& e) {
    squares_ += e.last.update.nis, rows_ += e.last.update.rows;
    drive_.lost = drive_.lost || e.status.state == TrackingState::lost;
    for (const Match& match : e.last.matches) {
      drive_.measurements += match.outcome == MatchOutcome::matched || match.outcome == MatchOutcome::outlier;
      drive_.left_out += match.outcome == MatchOutcome::outlier;
    }
  }

  void compare(const Estimate& e, std::size_t i, double t, double start_t) {
    const auto place = true_position(robots_[i], t);
    if (!place) return;
    const Eigen::Matrix3d P = e.belief.covariance(e.bodies[i].block);
    RobotCourse& course = drive_.robots[i];
    course.add(t - start_t, {{place->position.x(), place->position.y(), *place->heading_rad},
                             e.belief.mean(e.bodies[i].block),
                             P});
    course.sigma_m.push_back(largest_sigma(Eigen::Matrix2d(P.topLeftCorner<2, 2>())));
    course.most_sigma_heading_rad = std::max(course.most_sigma_heading_rad, std::sqrt(P(2, 2)));
  }

  void finish(const Estimate& e) {
    drive_.nis = squares_ / std::max(1, rows_);
    fit_landmarks(e);
    for (RobotCourse& course : drive_.robots) {
      for (const PoseInstant& now : course.instants)
        course.fitted_rms_m += (drive_.fit(now.mean.head<2>()) - now.truth.head<2>()).squaredNorm() /
                               static_cast<double>(course.instants.size());
      course.fitted_rms_m = std::sqrt(course.fitted_rms_m);
      course.rms_m = course.position_rms_m();
      course.rms_heading_rad = course.heading_rms_rad();
      course.nees = course.mean_nees();
    }
  }

  void fit_landmarks(const Estimate& e) {
    std::vector<Vector2d> estimated, surveyed;
    for (const RangeRecording::Landmark& landmark : robots_.front().landmarks) {
      const auto found = e.landmarks.find(landmark.identity);
      if (found == e.landmarks.end()) continue;
      const BlockId block = found->second.block;
      estimated.emplace_back(e.belief.mean(block));
      surveyed.push_back(landmark.position);
      drive_.landmarks.push_back({landmark.identity, estimated.back(), landmark.position,
                                  Eigen::Matrix2d(e.belief.covariance(block))});
    }
    drive_.fit = fit_rigid(estimated, surveyed);
    const auto count = static_cast<double>(drive_.landmarks.size());
    for (MappedLandmark& l : drive_.landmarks) {
      l.off_m = (l.estimated - l.surveyed).norm(),
      l.fitted_off_m = (drive_.fit(l.estimated) - l.surveyed).norm();
      drive_.map_rms_m += l.off_m * l.off_m / count;
      drive_.fitted_map_rms_m += l.fitted_off_m * l.fitted_off_m / count;
    }
    drive_.map_rms_m = std::sqrt(drive_.map_rms_m);
    drive_.fitted_map_rms_m = std::sqrt(drive_.fitted_map_rms_m);
  }

  const Robots& robots_;
  std::shared_ptr<const Robots> recordings_;
  Setup setup_;
  double squares_ = 0;
  int rows_ = 0;
  Drive drive_;
};

/// Scans that show nothing at the times of the others' scans; none from before the team's first.
void measure_at_all_times(RangeRecording& robot, const Robots& team) {
  std::vector<RangeRecording::Scan> scans;
  auto own = robot.scans.begin();
  for (const double t : scan_times(team, duration_s)) {
    while (own != robot.scans.end() && own->t < t) ++own;
    const bool saw = own != robot.scans.end() && own->t == t;
    scans.push_back(saw ? *own : RangeRecording::Scan{t, {}});
  }
  robot.scans = std::move(scans);
}

}  // namespace

Robots load() { return read_mrclam_team(find_data("mrclam/MRCLAM_Dataset7", "", "reproduce mrclam")); }

Drive together(const Robots& robots, const Setup& setup) { return Driver(robots, setup).run(); }

Drive alone(const Robots& robots, std::size_t which, const Setup& setup, Times times) {
  Setup by_itself = setup;
  by_itself.see_each_other = false;
  Robots only = {robots[which]};
  if (times == Times::of_team) measure_at_all_times(only.front(), robots);
  return Driver(only, by_itself).run();
}

std::vector<Drive> each_alone(const Robots& robots, const Setup& setup, Times times) {
  std::vector<Drive> drives;
  for (std::size_t i = 0; i < robots.size(); ++i) drives.push_back(alone(robots, i, setup, times));
  return drives;
}

}  // namespace incognita::recorded_team
