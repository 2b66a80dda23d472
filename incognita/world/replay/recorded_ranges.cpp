#include "incognita/world/replay/recorded_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/mount.hpp"

namespace incognita {

RangeRecording with_rounded_stamps(RangeRecording recording) {
  const auto round_times = [](auto& events) {
    for (auto& event : events) event.t = rounded_to_us(event.t);
  };
  round_times(recording.odometry), round_times(recording.scans);
  round_times(recording.truth), round_times(recording.fixes);
  recording.whole_us = true;
  return recording;
}

double start_time(const RangeRecording& r) {
  double first = std::numeric_limits<double>::infinity();
  const auto use_first = [&](const auto& events) {
    if (!events.empty()) first = std::min(first, events.front().t);
  };
  use_first(r.odometry), use_first(r.scans), use_first(r.fixes);
  return first;
}

std::optional<RangeRecording::TimedPosition> true_position(const RangeRecording& r, double t) {
  constexpr double longest_hole_s = 0.5;
  const auto after =
      std::lower_bound(r.truth.begin(), r.truth.end(), t,
                       [](const RangeRecording::TimedPosition& place, double at) { return place.t < at; });
  if (after == r.truth.end()) return std::nullopt;
  if (after->t == t) return *after;
  if (after == r.truth.begin()) return std::nullopt;
  const RangeRecording::TimedPosition &a = *(after - 1), &b = *after;
  if (b.t - a.t > longest_hole_s) return std::nullopt;
  const double share = (t - a.t) / (b.t - a.t);
  RangeRecording::TimedPosition place{t, a.position + share * (b.position - a.position), std::nullopt};
  if (a.heading_rad && b.heading_rad)
    place.heading_rad = wrap_angle(*a.heading_rad + share * wrap_angle(*b.heading_rad - *a.heading_rad));
  return place;
}

std::vector<double> scan_times(const std::vector<RangeRecording>& recordings, double duration_s) {
  double start =
      recordings.size() == 1 ? start_time(recordings.front()) : -std::numeric_limits<double>::infinity();
  if (recordings.size() > 1)
    for (const RangeRecording& r : recordings) start = std::max(start, r.odometry.front().t);
  std::vector<double> times;
  for (const RangeRecording& r : recordings)
    for (const RangeRecording::Scan& scan : r.scans)
      if (scan.t >= start && incognita::duration_s(start, scan.t, r.whole_us) <= duration_s)
        times.push_back(scan.t);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

std::vector<RecordedTruth> recorded_truths(const SharedRangeRecordings& recordings) {
  const bool is_team = recordings->size() > 1;
  std::vector<RecordedTruth> truths;
  for (std::size_t i = 0; i < recordings->size(); ++i)
    truths.emplace_back([recordings, i, is_team](double t) -> std::optional<BodyTruth> {
      const auto reference = true_position((*recordings)[i], t);
      if (!reference || (is_team && !reference->heading_rad)) return std::nullopt;
      const Eigen::Vector3d on_plane(reference->position.x(), reference->position.y(),
                                     reference->heading_rad.value_or(0));
      BodyTruth body;
      body.pose = on_floor(planar::Pose<double>(on_plane)).pose;
      body.orientation_known = reference->heading_rad.has_value();
      return body;
    });
  return truths;
}

RecordedRanges::RecordedRanges(SharedRangeRecordings recordings, std::size_t vehicle,
                               const RangeSensorSettings& settings)
    : recordings_(std::move(recordings)), recording_(&recordings_->at(vehicle)), settings_(settings) {}

void RecordedRanges::measure(const std::optional<Truth>&, std::size_t, const Tick& tick,
                             BodyObservation& observation) {
  add_readings(tick.t, observation);
  add_scans(tick.t, observation);
}

void RecordedRanges::add_readings(double t, BodyObservation& observation) {
  const RangeRecording& r = *recording_;
  for (; odometry_ < r.odometry.size() && r.odometry[odometry_].t <= t; ++odometry_)
    observation.odometry.push_back(r.odometry[odometry_]);
  for (; fixes_ < r.fixes.size() && r.fixes[fixes_].t <= t; ++fixes_) {
    if (settings_.fixes == Fixes::none || (settings_.fixes == Fixes::first && fix_given_)) continue;
    observation.fixes.push_back({r.fixes[fixes_].t, r.fixes[fixes_].position});
    fix_given_ = true;
  }
}

void RecordedRanges::add_scans(double t, BodyObservation& observation) {
  const auto add = [&](const std::vector<Detection>& detections, std::vector<PointDetection>& to) {
    for (const Detection& d : detections)
      if (!(d.range_m > settings_.max_range_m))
        to.push_back({d.identity, Eigen::Vector2d(d.range_m, d.bearing_rad)});
  };
  const std::vector<RangeRecording::Scan>& scans = recording_->scans;
  for (; scans_ < scans.size() && scans[scans_].t <= t; ++scans_) {
    if (scans[scans_].t < t) continue;  // before the first tick
    add(scans[scans_].detections, observation.landmarks);
    if (settings_.measures_vehicles) add(scans[scans_].vehicles, observation.vehicles);
  }
}

SensorSet recorded_ranges(const SharedRangeRecordings& recordings, const RangeSensorSettings& settings) {
  std::vector<BodySensors> bodies;
  for (std::size_t i = 0; i < recordings->size(); ++i)
    bodies.push_back(sensors_of_body(std::make_unique<RecordedRanges>(recordings, i, settings)));
  return SensorSet(std::move(bodies));
}

}  // namespace incognita
