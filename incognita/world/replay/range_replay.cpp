#include "incognita/world/replay/range_replay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "incognita/math/angles.hpp"
#include "incognita/models/motion/mount.hpp"

namespace incognita {
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

RangeClock::RangeClock(const SharedRangeRecordings& recordings, double duration_s) {
  double start =
      recordings->size() == 1 ? start_time(recordings->front()) : -std::numeric_limits<double>::infinity();
  if (recordings->size() > 1)
    for (const RangeRecording& r : *recordings) start = std::max(start, r.odometry.front().t);
  for (const RangeRecording& r : *recordings)
    for (const RangeRecording::Scan& scan : r.scans)
      if (scan.t >= start && scan.t <= start + duration_s) times_.push_back(scan.t);
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
}

Tick RangeClock::next() {
  if (done_ >= times_.size()) return {};
  const std::size_t k = done_++;
  return {static_cast<std::int64_t>(k), times_[k], k == 0 ? 0 : times_[k] - times_[k - 1]};
}

std::optional<Truth> RangeWorld::move(const Command&, const Tick& tick) {
  Truth truth;
  bool any_known = false;
  for (const RangeRecording& r : *recordings_) {
    BodyTruth& body = truth.bodies.emplace_back();
    const auto reference = true_position(r, tick.t);
    // A single vehicle may have a GPS, which measures no heading; in a team each needs its heading
    if (!reference || (!reference->heading_rad && recordings_->size() > 1)) continue;
    const Eigen::Vector3d on_plane(reference->position.x(), reference->position.y(),
                                   reference->heading_rad.value_or(0));
    body.pose = on_floor(planar::Pose<double>(on_plane)).pose;
    any_known = true;
    body.orientation_known = reference->heading_rad.has_value();
  }
  return any_known ? std::optional(truth) : std::nullopt;
}

RangeSensor::RangeSensor(SharedRangeRecordings recordings, const RangeSensorSettings& settings)
    : recordings_(std::move(recordings)), settings_(settings), done_(recordings_->size()) {}

BodyObservation RangeSensor::next(const RangeRecording& r, Progress& done, double t) const {
  BodyObservation view;
  for (; done.odometry < r.odometry.size() && r.odometry[done.odometry].t <= t; ++done.odometry)
    view.odometry.push_back(r.odometry[done.odometry]);
  for (; done.fixes < r.fixes.size() && r.fixes[done.fixes].t <= t; ++done.fixes) {
    if (settings_.fixes == Fixes::none || (settings_.fixes == Fixes::first && done.fix_given)) continue;
    view.fixes.push_back({r.fixes[done.fixes].t, r.fixes[done.fixes].position});
    done.fix_given = true;
  }
  const auto add = [&](const std::vector<Detection>& detections, std::vector<PointDetection>& to) {
    for (const Detection& d : detections)
      if (!(d.range_m > settings_.max_range_m))
        to.push_back({d.identity, Eigen::Vector2d(d.range_m, d.bearing_rad)});
  };
  for (; done.scans < r.scans.size() && r.scans[done.scans].t <= t; ++done.scans) {
    if (r.scans[done.scans].t < t) continue;  // before the first tick
    add(r.scans[done.scans].detections, view.landmarks);
    if (settings_.measures_vehicles) add(r.scans[done.scans].vehicles, view.vehicles);
  }
  return view;
}

Observation RangeSensor::measure(const std::optional<Truth>&, const Tick& tick) {
  Observation observation;
  for (std::size_t i = 0; i < recordings_->size(); ++i)
    observation.bodies.push_back(next((*recordings_)[i], done_[i], tick.t));
  return observation;
}

}  // namespace incognita
