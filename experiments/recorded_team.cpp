#include "experiments/recorded_team.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "experiments/seeds.hpp"
#include "incognita/analysis/evaluation/statistics.hpp"
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

void count(const Estimate& e, Drive& drive) {
  drive.lost = drive.lost || e.status.state == TrackingState::lost;
  for (const Match& match : e.last.matches) {
    drive.measurements += match.outcome == MatchOutcome::matched || match.outcome == MatchOutcome::outlier;
    drive.left_out += match.outcome == MatchOutcome::outlier;
  }
}

void compare(const AnyBelief& belief, BlockId block, const RangeRecording::TimedPosition& place, double t,
             RobotCourse& course) {
  const Eigen::Matrix3d P = belief.covariance(block);
  course.add(t, {{place.position.x(), place.position.y(), *place.heading_rad}, belief.mean(block), P});
  course.sigma_m.push_back(largest_sigma(Eigen::Matrix2d(P.topLeftCorner<2, 2>())));
  course.most_sigma_heading_rad = std::max(course.most_sigma_heading_rad, std::sqrt(P(2, 2)));
}

void fit_landmarks(const Estimate& e, const std::vector<RangeRecording::Landmark>& surveyed, Drive& drive) {
  std::vector<Vector2d> from, to;
  for (const RangeRecording::Landmark& landmark : surveyed) {
    const auto found = e.landmarks.find(landmark.identity);
    if (found == e.landmarks.end()) continue;
    const BlockId block = found->second.block;
    from.emplace_back(e.belief.mean(block)), to.push_back(landmark.position);
    drive.landmarks.push_back(
        {landmark.identity, from.back(), to.back(), Eigen::Matrix2d(e.belief.covariance(block))});
  }
  drive.fit = fit_rigid(from, to);
  for (MappedLandmark& l : drive.landmarks) {
    l.off_m = (l.estimated - l.surveyed).norm();
    l.fitted_off_m = (drive.fit(l.estimated) - l.surveyed).norm();
  }
  drive.map_rms_m = rms_of(each(drive.landmarks, &MappedLandmark::off_m)).value;
  drive.fitted_map_rms_m = rms_of(each(drive.landmarks, &MappedLandmark::fitted_off_m)).value;
}

void finish(const PlanarFit& fit, RobotCourse& course) {
  course.rms_m = course.position_rms_m();
  course.rms_heading_rad = course.heading_rms_rad();
  course.nees = course.mean_nees();
  for (const PoseInstant& now : course.instants)
    course.fitted_rms_m += (fit(now.mean.head<2>()) - now.truth.head<2>()).squaredNorm() /
                           static_cast<double>(course.instants.size());
  course.fitted_rms_m = std::sqrt(course.fitted_rms_m);
}

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

Drive together(const Robots& robots, const Setup& setup) {
  const double start_t = scan_times(robots, duration_s).front();
  Drive drive;
  drive.robots.resize(robots.size());
  double squares = 0, matched_t = start_t;
  int rows = 0;
  const auto visit = [&](const Estimate& e, const Tick& tick) {
    drive.recorded_s = tick.t - start_t;
    drive.longest_blind_s = std::max(drive.longest_blind_s, tick.t - matched_t);
    if (e.last.matched > 0) matched_t = tick.t;
    squares += e.last.update.nis, rows += e.last.update.rows;
    count(e, drive);
    for (std::size_t i = 0; i < robots.size(); ++i)
      if (const auto place = true_position(robots[i], tick.t))
        compare(e.belief, e.bodies[i].block, *place, tick.t - start_t, drive.robots[i]);
  };
  const Estimate last =
      replay(std::make_shared<const Robots>(robots), duration_s, {.measures_vehicles = setup.see_each_other},
             settings_of(robots, start_t, setup), visit, &drive.took_s);
  drive.nis = squares / std::max(1, rows);
  fit_landmarks(last, robots.front().landmarks, drive);
  for (RobotCourse& course : drive.robots) finish(drive.fit, course);
  return drive;
}

Drive alone(const Robots& robots, std::size_t which, const Setup& setup, Times times) {
  Setup by_itself = setup;
  by_itself.see_each_other = false;
  Robots only = {robots[which]};
  if (times == Times::of_team) measure_at_all_times(only.front(), robots);
  return together(only, by_itself);
}

std::vector<Drive> each_alone(const Robots& robots, const Setup& setup, Times times) {
  std::vector<Drive> drives;
  for (std::size_t i = 0; i < robots.size(); ++i) drives.push_back(alone(robots, i, setup, times));
  return drives;
}

}  // namespace incognita::recorded_team
