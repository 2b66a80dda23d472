#include "incognita/world/replay/range_replay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "incognita/math/angles.hpp"

namespace incognita {
namespace {

FreeCameraMotion::State<double> upright(const RangeRecording::Place& place) {
  FreeCameraMotion::State<double> state = FreeCameraMotion::State<double>::Zero();
  const double half = place.heading_rad.value_or(0) / 2;
  state.head<7>() << place.position.x(), place.position.y(), 0, std::cos(half), 0, 0, std::sin(half);
  return state;
}

}  // namespace

double start_time(const RangeRecording& r) {
  double first = std::numeric_limits<double>::infinity();
  const auto look = [&](const auto& events) {
    if (!events.empty()) first = std::min(first, events.front().t);
  };
  look(r.odometry), look(r.scans), look(r.fixes);
  return first;
}

std::optional<RangeRecording::Place> true_place(const RangeRecording& r, double t) {
  constexpr double longest_hole_s = 0.5;
  const auto after =
      std::lower_bound(r.truth.begin(), r.truth.end(), t,
                       [](const RangeRecording::Place& place, double at) { return place.t < at; });
  if (after == r.truth.end()) return std::nullopt;
  if (after->t == t) return *after;
  if (after == r.truth.begin()) return std::nullopt;
  const RangeRecording::Place &a = *(after - 1), &b = *after;
  if (b.t - a.t > longest_hole_s) return std::nullopt;
  const double share = (t - a.t) / (b.t - a.t);
  RangeRecording::Place place{t, a.position + share * (b.position - a.position), std::nullopt};
  if (a.heading_rad && b.heading_rad)
    place.heading_rad = wrap_angle(*a.heading_rad + share * wrap_angle(*b.heading_rad - *a.heading_rad));
  return place;
}

RangeClock::RangeClock(SharedRangeRecording recording, double duration_s) : recording_(std::move(recording)) {
  const double end = start_time(*recording_) + duration_s;
  ticks_ = std::count_if(recording_->scans.begin(), recording_->scans.end(),
                         [&](const RangeRecording::Scan& scan) { return scan.t <= end; });
}

Tick RangeClock::next() {
  if (done_ >= ticks_) return {};
  const auto k = static_cast<std::size_t>(done_);
  const double t = recording_->scans[k].t;
  return {done_++, t, k == 0 ? 0 : t - recording_->scans[k - 1].t};
}

std::optional<Truth> RangeWorld::move(const Command&, const Tick& tick) {
  const auto place = true_place(*recording_, tick.t);
  if (!place) return std::nullopt;
  return Truth{upright(*place), place->heading_rad.has_value(), {}, {}};
}

Observation RangeSensor::look(const std::optional<Truth>&, const Tick& tick) {
  const RangeRecording& r = *recording_;
  Observation seen;
  for (; odometry_done_ < r.odometry.size() && r.odometry[odometry_done_].t <= tick.t; ++odometry_done_)
    seen.odometry.push_back(r.odometry[odometry_done_]);
  for (; fixes_done_ < r.fixes.size() && r.fixes[fixes_done_].t <= tick.t; ++fixes_done_) {
    if (fixes_ == Fixes::none || (fixes_ == Fixes::first && fix_given_)) continue;
    seen.fixes.push_back({r.fixes[fixes_done_].t, r.fixes[fixes_done_].position});
    fix_given_ = true;
  }
  for (const Detection& detection : r.scans[static_cast<std::size_t>(tick.frame)].detections)
    if (detection.range_m <= max_range_m_) seen.detections.push_back(detection);
  return seen;
}

}  // namespace incognita
