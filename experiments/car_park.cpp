#include "experiments/car_park.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "experiments/curves.hpp"
#include "experiments/run_trace.hpp"
#include "incognita/io/recordings/range_recording.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/math/largest_sigma.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/slam/estimator/single_vehicle.hpp"

namespace incognita::car_park {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double right_heading_deg = -127;  // at which the anchored filter ends
constexpr double beacon_reach_m =
    1.5;  // of a landmark from its beacon after the fit; the nearest beacons are 2 m apart

/// Gives each detection the identity of its beacon: the nearest one, within a meter, by the pose of a filter
/// with both anchors and the right heading at the start (that at which the anchored filter ends, 15 degrees
/// from the authors'). The error of that filter is far below the distance between beacons. Filters with
/// unknown association ignore the identity.
void identify(Data& data) {
  PlanarSlamSettings settings = data.settings;
  settings.filter.linearization = Linearization::first_estimate;
  settings.filter.anchors = data.anchors;
  settings.start.heading_rad = radians(right_heading_deg);
  settings.start.sigma_heading_rad = radians(2);
  const auto nearest_beacon = [&](const Estimate& estimate, const Tick& tick) {
    if (!estimate.started) return;
    for (Detection& d : data.recording.scans[static_cast<std::size_t>(tick.frame)].detections) {
      const Eigen::Vector2d at = RangeBearing::j<double>(planar::Pose<double>(estimate.bodies.front().state),
                                                         {d.range_m, d.bearing_rad});
      double nearest_m = 1;
      for (std::size_t b = 0; b < data.recording.landmarks.size(); ++b) {
        const double distance = (data.recording.landmarks[b].position - at).norm();
        if (distance < nearest_m) nearest_m = distance, d.identity = static_cast<std::int64_t>(b);
      }
    }
  };
  replay(std::make_shared<const std::vector<RangeRecording>>(1, data.recording), duration_s,
         {settings.sensor.max_range_m, Fixes::first}, single_vehicle(settings), nearest_beacon);
}

/// Records a drive while the estimator runs.
class Driver {
 public:
  Driver(const Data& data, const PlanarSlamSettings& settings) : data_(data), settings_(settings) {
    for (const Eigen::Vector2d& anchor : settings.filter.anchors)
      for (std::size_t b = 0; b < data.recording.landmarks.size(); ++b)
        if ((data.recording.landmarks[b].position - anchor).norm() < 0.01)
          anchors_.push_back(static_cast<int>(b));
  }

  Drive run() {
    compare(replay(std::make_shared<const std::vector<RangeRecording>>(1, data_.recording), duration_s,
                   {settings_.sensor.max_range_m, settings_.filter.use_fixes ? Fixes::all : Fixes::first},
                   single_vehicle(settings_, std::vector<std::int64_t>(anchors_.begin(), anchors_.end())),
                   [&](const Estimate& estimate, const Tick& tick) {
                     if (estimate.started) gather(estimate, tick);
                   }));
    return drive_;
  }

 private:
  bool is_anchor(int beacon) const { return std::ranges::find(anchors_, beacon) != anchors_.end(); }

  void gather(const Estimate& e, const Tick& tick) {
    const Body& vehicle = e.bodies.front();
    const auto truth = true_position(data_.recording, tick.t);
    drive_.t.push_back(tick.t);
    drive_.path.push_back(vehicle.state.head<2>());
    drive_.gps.push_back(truth ? truth->position : Eigen::Vector2d(unknown, unknown));
    drive_.sigma_m.push_back(largest_sigma(Eigen::Matrix2d(vehicle.state_covariance.topLeftCorner<2, 2>())));
    drive_.sigma_heading_rad.push_back(std::sqrt(std::max(0.0, vehicle.state_covariance(2, 2))));
    drive_.lost_scans += e.status.state == TrackingState::lost;
    gather_measurements(e, data_.recording.scans[static_cast<std::size_t>(tick.frame)].detections);
    for (const auto& [id, landmark] : e.landmarks) {
      if (landmark.fixed) continue;
      const LandmarkPosition at = *position_of(landmark, e);
      Track& track = tracks_[id];
      track.t.push_back(tick.t);
      track.sigma_m.push_back(largest_sigma(at.covariance));
      const int beacon = initialized_from_[id];
      track.error_m.push_back(
          beacon < 0
              ? unknown
              : (at.position - data_.recording.landmarks[static_cast<std::size_t>(beacon)].position).norm());
    }
  }

  void gather_measurements(const Estimate& e, const std::vector<Detection>& detections) {
    for (std::size_t d = 0; d < e.last.matches.size(); ++d) {
      const Match& match = e.last.matches[d];
      const int beacon = static_cast<int>(detections[d].identity);
      ++drive_.detections;
      if (beacon >= 0) ++seen_[beacon];
      if (match.outcome == MatchOutcome::initialized) initialized_from_[match.id] = beacon;
      if (match.outcome != MatchOutcome::matched) continue;
      ++drive_.matched;
      if (beacon < 0) continue;
      if (match.anchor ? !is_anchor(beacon) : initialized_from_[match.id] != beacon) ++drive_.wrong;
    }
  }

  void compare(const Estimate& e) {
    for (const auto& [id, landmark] : e.landmarks) {
      if (landmark.fixed) continue;
      const LandmarkPosition at = *position_of(landmark, e);
      drive_.landmarks.push_back(at.position);
      drive_.covariances.push_back(at.covariance);
      drive_.tracks.push_back(tracks_[id]);
    }
    std::vector<Eigen::Vector2d> surveyed, path, gps;
    std::vector<int> which;
    for (std::size_t b = 0; b < data_.recording.landmarks.size(); ++b) {
      if (is_anchor(static_cast<int>(b))) continue;
      surveyed.push_back(data_.recording.landmarks[b].position);
      which.push_back(static_cast<int>(b));
    }
    for (std::size_t i = 0; i < drive_.path.size(); ++i) {
      if (!drive_.gps[i].allFinite()) continue;
      path.push_back(drive_.path[i]);
      gps.push_back(drive_.gps[i]);
    }
    drive_.fitted = fitted_map_error(drive_.landmarks, surveyed, beacon_reach_m, fit_rigid(path, gps));
    const PlanarFit path_fit = fit_rigid(path, gps);
    double before = 0, plain = 0, fitted = 0;
    for (const MapError::Match& m : drive_.fitted.error.matches)
      before += (drive_.landmarks[m.estimated] - surveyed[m.surveyed]).squaredNorm();
    for (std::size_t i = 0; i < path.size(); ++i) {
      plain += (path[i] - gps[i]).squaredNorm();
      fitted += (path_fit(path[i]) - gps[i]).squaredNorm();
    }
    drive_.map_rms_m = std::sqrt(before / static_cast<double>(drive_.fitted.error.matches.size()));
    drive_.path_rms_m = std::sqrt(plain / static_cast<double>(path.size()));
    drive_.fitted_path_rms_m = std::sqrt(fitted / static_cast<double>(path.size()));
    count_often_seen(which);
  }

  void count_often_seen(const std::vector<int>& which) {
    for (std::size_t s = 0; s < which.size(); ++s) {
      if (seen_[which[s]] < 10) continue;
      ++drive_.often_seen;
      const auto& missing = drive_.fitted.error.missing;
      drive_.often_seen_mapped += std::ranges::find(missing, s) == missing.end();
    }
  }

  const Data& data_;
  PlanarSlamSettings settings_;
  std::vector<int> anchors_;
  std::map<std::int64_t, Track> tracks_;
  std::map<std::int64_t, int> initialized_from_;
  std::map<int, int> seen_;
  Drive drive_;
};

std::vector<double> plus_minus(const std::vector<double>& sigma, double factor) {
  std::vector<double> out;
  for (const double s : sigma) out.push_back(factor * s);
  return out;
}

}  // namespace

double Drive::mean_landmark_sigma_m() const {
  double sum = 0;
  for (const Eigen::Matrix2d& P : covariances) sum += largest_sigma(P);
  return sum / static_cast<double>(covariances.size());
}

Data load() {
  const LoadedScenario loaded = load_scenario("car-park");
  Data data{read_range_recording(loaded), loaded.scenario.planar, {}};
  data.settings.filter.linearization = Linearization::analytic;
  data.settings.health.max_sigma_position_m = 1e6;  // how far it diverges is the result
  data.anchors = {{2.8953, -4.0353}, {9.9489, 6.9239}};
  identify(data);
  return data;
}

Drive drive(const Data& data, const PlanarSlamSettings& settings) { return Driver(data, settings).run(); }

bool is_accurate(const Drive& d) { return d.map_rms_m < 0.25 && d.path_rms_m < 0.20; }

double apart(const Drive& a, const Drive& b) {
  const auto relative = [](double x, double y) { return std::abs(x - y) / std::min(x, y); };
  return std::max(relative(a.mean_landmark_sigma_m(), b.mean_landmark_sigma_m()),
                  relative(a.last_sigma_m(), b.last_sigma_m()));
}

PlanarSlamSettings Start::applied_to(PlanarSlamSettings s) const {
  s.start.sigma_position_m *= position_times;
  s.start.sigma_heading_rad *= heading_times;
  if (right_heading) s.start.heading_rad = radians(right_heading_deg);
  return s;
}

std::vector<Start> other_starts() {
  return {{"a third of the position sigma", 1.0 / 3, 1, false},
          {"three times the position sigma", 3, 1, false},
          {"twice the heading sigma", 1, 2, false},
          {"heading right and to 5°", 1, 1.0 / 3, true}};
}

double largest_growth(const Drive& d) {
  double most = 0;
  for (const Track& track : d.tracks)
    most = std::max(most, track.sigma_m.back() / track.sigma_m[track.sigma_m.size() / 2] - 1);
  return most;
}

Plot four_frames(const std::string& id, const std::string& title, const Drive& d) {
  std::vector<double> off;
  for (std::size_t i = 0; i < d.path.size(); ++i) off.push_back((d.path[i] - d.gps[i]).norm());
  std::vector<double> degrees;
  for (const double s : d.sigma_heading_rad) degrees.push_back(s * 180 / 3.14159265358979);
  Panel a{"(a) vehicle", "t, s", "from GPS, m", {}}, b{"(b) vehicle", "t, s", "σ", {}},
      c{"(c) landmarks", "t, s", "from their beacons, m", {}}, e{"(d) landmarks", "t, s", "σ, m", {}};
  a.curves = {
      {"2σ", Style::band, d.t, std::vector<double>(d.t.size(), 0.0), plus_minus(d.sigma_m, 2), Color::sky},
      {"error", Style::line, d.t, off, {}, Color::orange}};
  b.curves = {{"position, m", Style::line, d.t, d.sigma_m, {}, Color::blue},
              {"heading, °", Style::line, d.t, degrees, {}, Color::green}};
  b.log_y = true;
  e.log_y = true;
  for (const Track& track : d.tracks) {
    c.curves.push_back({"", Style::thin, track.t, track.error_m, {}, Color::automatic});
    e.curves.push_back({"", Style::thin, track.t, track.sigma_m, {}, Color::automatic});
  }
  return {id, title, 2, {a, b, c, e}};
}

Plot map(const std::string& id, const std::string& title, const Data& data, const Drive& d,
         const std::vector<Eigen::Vector2d>& anchors) {
  std::vector<Eigen::Vector2d> beacons;
  for (const auto& landmark : data.recording.landmarks) beacons.push_back(landmark.position);
  Panel panel{"", "east, m", "north, m", {}, true};
  panel.curves = {path_of("GPS", Style::thin, Color::gray, d.gps),
                  path_of("estimated path", Style::line, Color::orange, d.path),
                  path_of("surveyed beacons", Style::circles, Color::ink, beacons),
                  path_of("landmarks", Style::crosses, Color::blue, d.landmarks)};
  Curve outlines = ellipses("2σ", d.landmarks, d.covariances);
  outlines.color = Color::blue;
  panel.curves.push_back(outlines);
  if (!anchors.empty()) panel.curves.push_back(path_of("anchors", Style::stars, Color::green, anchors));
  return {id, title, 1, {panel}};
}

}  // namespace incognita::car_park
