#include "incognita/world/replay/team_replay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "incognita/models/mount.hpp"
#include "incognita/world/replay/range_replay.hpp"

namespace incognita {

TeamReplayClock::TeamReplayClock(const SharedTeamRecording& recordings, double duration_s) {
  double start = -std::numeric_limits<double>::infinity();
  for (const RangeRecording& r : *recordings) start = std::max(start, r.odometry.front().t);
  for (const RangeRecording& r : *recordings)
    for (const RangeRecording::Scan& scan : r.scans)
      if (scan.t >= start && scan.t <= start + duration_s) times_.push_back(scan.t);
  std::sort(times_.begin(), times_.end());
  times_.erase(std::unique(times_.begin(), times_.end()), times_.end());
}

Tick TeamReplayClock::next() {
  if (done_ >= times_.size()) return {};
  const std::size_t k = done_++;
  return {static_cast<std::int64_t>(k), times_[k], k == 0 ? 0 : times_[k] - times_[k - 1]};
}

std::optional<Truth> TeamReplayWorld::move(const Command&, const Tick& tick) {
  Truth truth;
  bool any_known = false;
  for (const RangeRecording& r : *recordings_) {
    std::optional<RigidPose>& pose = truth.poses.emplace_back();
    const auto place = true_place(r, tick.t);
    if (!place || !place->heading_rad) continue;
    const Eigen::Vector3d on_plane(place->position.x(), place->position.y(), *place->heading_rad);
    pose = on_floor(planar::Pose<double>(on_plane)).pose;
    any_known = true;
    const double half = on_plane[2] / 2;
    if (truth.poses.size() == 1)
      truth.camera.head<7>() << on_plane[0], on_plane[1], 0, std::cos(half), 0, 0, std::sin(half);
  }
  return any_known ? std::optional(truth) : std::nullopt;
}

TeamReplaySensor::TeamReplaySensor(SharedTeamRecording recordings, bool sees_vehicles, double max_range_m)
    : recordings_(std::move(recordings)),
      sees_vehicles_(sees_vehicles),
      max_range_m_(max_range_m),
      odometry_done_(recordings_->size()),
      scans_done_(recordings_->size()) {}

Observation TeamReplaySensor::look(const std::optional<Truth>&, const Tick& tick) {
  Observation seen;
  for (std::size_t i = 0; i < recordings_->size(); ++i) {
    const RangeRecording& r = (*recordings_)[i];
    VehicleView view;
    for (std::size_t& o = odometry_done_[i]; o < r.odometry.size() && r.odometry[o].t <= tick.t; ++o)
      view.odometry.push_back(r.odometry[o]);
    const auto tell = [&](const std::vector<Detection>& detections, std::vector<Sighting>& to) {
      for (const Detection& d : detections)
        if (d.identity != Detection::unknown && d.range_m <= max_range_m_)
          to.push_back({d.identity, Eigen::Vector2d(d.range_m, d.bearing_rad)});
    };
    for (std::size_t& s = scans_done_[i]; s < r.scans.size() && r.scans[s].t <= tick.t; ++s) {
      if (r.scans[s].t < tick.t) continue;  // from before all knew how they move
      tell(r.scans[s].detections, view.landmarks);
      if (sees_vehicles_) tell(r.scans[s].vehicles, view.vehicles);
    }
    seen.team.push_back(std::move(view));
  }
  return seen;
}

}  // namespace incognita
