#include "experiments/car_park.hpp"

#include <map>
#include <memory>

#include "experiments/common.hpp"
#include "experiments/run_trace.hpp"
#include "incognita/io/recordings/range_recording.hpp"
#include "incognita/io/scenario/load_scenario.hpp"
#include "incognita/math/largest_sigma.hpp"
#include "incognita/math/unknown.hpp"
#include "incognita/models/sensors/range_bearing.hpp"
#include "incognita/slam/estimator/single_vehicle.hpp"

namespace incognita::car_park {
namespace {

constexpr double right_heading_deg = -127;  // at which the anchored filter ends
constexpr double beacon_reach_m =
    1.5;  // of a landmark from its beacon after the fit; the nearest beacons are 2 m apart

PlanarSlamSettings settings_of(const Data& data, const Variant& variant) {
  PlanarSlamSettings s = data.settings;
  if (variant.anchored) s.filter.anchors = data.anchors;
  s.filter.linearization = variant.linearization;
  s.filter.decorrelate = variant.decorrelate;
  s.filter.map_frame = variant.map_frame;
  s.filter.use_fixes = variant.gps_all_along;
  if (variant.right_associations) {
    s.association.method = DataAssociationSettings::Method::known;
    s.association.gate_probability = 1 - 1e-9;
  }
  if (variant.nearest_neighbor) s.association.method = DataAssociationSettings::Method::nearest;
  s.start.sigma_position_m *= variant.start.position_times;
  s.start.sigma_heading_rad *= variant.start.heading_times;
  if (variant.start.right_heading) s.start.heading_rad = radians(right_heading_deg);
  s.start.heading_rad += radians(variant.start.heading_off_deg);
  return s;
}

/// Calls `visit(estimate, tick, detections)` after each scan from the filter's start on.
template <class Visit>
Estimate follow(const Data& data, const PlanarSlamSettings& settings,
                const std::vector<std::int64_t>& anchor_identities, const Visit& visit) {
  return replay(std::make_shared<const std::vector<RangeRecording>>(1, data.recording), duration_s,
                {settings.sensor.max_range_m, settings.filter.use_fixes ? Fixes::all : Fixes::first},
                single_vehicle(settings, anchor_identities), [&](const Estimate& e, const Tick& tick) {
                  const auto frame = static_cast<std::size_t>(tick.frame);
                  if (e.started) visit(e, tick, data.recording.scans[frame].detections);
                });
}

/// Gives each detection the identity of its beacon: the nearest one, within a meter, by the pose of a filter
/// with both anchors and the right heading at the start (that at which the anchored filter ends, 15 degrees
/// from the authors'). The error of that filter is far below the distance between beacons. Filters with
/// unknown association ignore the identity.
void identify(Data& data) {
  PlanarSlamSettings settings = settings_of(
      data,
      {.anchored = true, .linearization = Linearization::first_estimate, .start = {.right_heading = true}});
  settings.start.sigma_heading_rad = radians(2);
  follow(data, settings, {}, [&](const Estimate& estimate, const Tick& tick, const auto&) {
    const planar::Pose<double> pose(estimate.bodies.front().state);
    for (Detection& d : data.recording.scans[static_cast<std::size_t>(tick.frame)].detections) {
      const Vector2d at = RangeBearing::j<double>(pose, {d.range_m, d.bearing_rad});
      double nearest_m = 1;
      for (std::size_t b = 0; b < data.beacons.size(); ++b) {
        const double distance = (data.beacons[b] - at).norm();
        if (distance < nearest_m) nearest_m = distance, d.identity = static_cast<std::int64_t>(b);
      }
    }
  });
}

double rms_distance(const std::vector<Vector2d>& a, const std::vector<Vector2d>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.size()));
}

/// Records a drive while the estimator runs.
class Driver {
 public:
  explicit Driver(const Data& data) : data_(data) {}

  Drive run(const PlanarSlamSettings& settings) {
    for (const Vector2d& anchor : settings.filter.anchors)
      for (std::size_t b = 0; b < data_.beacons.size(); ++b)
        if ((data_.beacons[b] - anchor).norm() < 0.01) anchors_.push_back(static_cast<std::int64_t>(b));
    drive_.anchors = settings.filter.anchors;
    const Estimate last = follow(data_, settings, anchors_,
                                 [&](const Estimate& estimate, const Tick& tick, const auto& detections) {
                                   gather_vehicle(estimate, tick);
                                   gather_measurements(estimate, detections);
                                   gather_landmarks(estimate, tick);
                                 });
    for (const auto& [id, landmark] : last.landmarks) {
      if (landmark.fixed) continue;
      const LandmarkPosition at = *position_of(landmark, last);
      drive_.landmarks.push_back(at.position);
      drive_.covariances.push_back(at.covariance);
      drive_.tracks.push_back(tracks_[id]);
    }
    compare_with_truth();
    return drive_;
  }

 private:
  bool is_anchor(std::int64_t beacon) const { return std::ranges::find(anchors_, beacon) != anchors_.end(); }

  void gather_vehicle(const Estimate& e, const Tick& tick) {
    const Body& vehicle = e.bodies.front();
    const auto truth = true_position(data_.recording, tick.t);
    drive_.t.push_back(tick.t);
    drive_.path.push_back(vehicle.state.head<2>());
    drive_.gps.push_back(truth ? truth->position : Vector2d(unknown, unknown));
    drive_.sigma_m.push_back(largest_sigma(Matrix2d(vehicle.state_covariance.topLeftCorner<2, 2>())));
    drive_.sigma_heading_rad.push_back(std::sqrt(std::max(0.0, vehicle.state_covariance(2, 2))));
  }

  void gather_measurements(const Estimate& e, const std::vector<Detection>& detections) {
    for (std::size_t d = 0; d < e.last.matches.size(); ++d) {
      const Match& match = e.last.matches[d];
      const std::int64_t beacon = detections[d].identity;
      ++drive_.detections;
      if (beacon >= 0) ++seen_[beacon];
      if (match.outcome == MatchOutcome::initialized) initialized_from_[match.id] = beacon;
      if (match.outcome != MatchOutcome::matched) continue;
      ++drive_.matched;
      if (beacon < 0) continue;
      if (match.anchor ? !is_anchor(beacon) : initialized_from_[match.id] != beacon) ++drive_.wrong;
    }
  }

  void gather_landmarks(const Estimate& e, const Tick& tick) {
    for (const auto& [id, landmark] : e.landmarks) {
      if (landmark.fixed) continue;
      const LandmarkPosition at = *position_of(landmark, e);
      const std::int64_t b = initialized_from_[id];
      Track& track = tracks_[id];
      track.t.push_back(tick.t);
      track.sigma_m.push_back(largest_sigma(at.covariance));
      track.error_m.push_back(b < 0 ? unknown
                                    : (at.position - data_.beacons[static_cast<std::size_t>(b)]).norm());
    }
  }

  void compare_with_truth() {
    std::vector<Vector2d> path, gps, fitted_path;
    for (std::size_t i = 0; i < drive_.path.size(); ++i) {
      if (!drive_.gps[i].allFinite()) continue;
      path.push_back(drive_.path[i]);
      gps.push_back(drive_.gps[i]);
    }
    const PlanarFit fit = fit_rigid(path, gps);
    for (const Vector2d& position : path) fitted_path.push_back(fit(position));
    drive_.path_rms_m = rms_distance(path, gps);
    drive_.fitted_path_rms_m = rms_distance(fitted_path, gps);

    std::vector<Vector2d> surveyed, matched, truth;
    std::vector<int> times_seen;
    for (std::size_t b = 0; b < data_.beacons.size(); ++b) {
      if (is_anchor(static_cast<std::int64_t>(b))) continue;
      surveyed.push_back(data_.beacons[b]);
      times_seen.push_back(seen_[static_cast<std::int64_t>(b)]);
    }
    drive_.fitted = fitted_map_error(drive_.landmarks, surveyed, beacon_reach_m, fit);
    for (const MapError::Match& m : drive_.fitted.error.matches) {
      matched.push_back(drive_.landmarks[m.estimated]);
      truth.push_back(surveyed[m.surveyed]);
    }
    drive_.map_rms_m = rms_distance(matched, truth);
    for (const int times : times_seen) drive_.often_seen += times >= often;
    drive_.often_seen_mapped = drive_.often_seen;
    for (const std::size_t s : drive_.fitted.error.missing)
      drive_.often_seen_mapped -= times_seen[s] >= often;
  }

  static constexpr int often = 10;  // detections
  const Data& data_;
  std::vector<std::int64_t> anchors_;
  std::map<std::int64_t, Track> tracks_;
  std::map<std::int64_t, std::int64_t> initialized_from_;
  std::map<std::int64_t, int> seen_;
  Drive drive_;
};

Plot four_frames(const std::string& id, const std::string& title, const Drive& d) {
  std::vector<double> off;
  for (std::size_t i = 0; i < d.path.size(); ++i) off.push_back((d.path[i] - d.gps[i]).norm());
  const auto two_sigmas = each(d.sigma_m, [](double s) { return 2 * s; });
  const auto degrees = each(d.sigma_heading_rad, [](double s) { return s * 180 / 3.14159265358979; });
  Panel a = time_panel("(a) vehicle", "from GPS, m"), b = time_panel("(b) vehicle", "σ"),
        c = time_panel("(c) landmarks", "from their beacons, m"), e = time_panel("(d) landmarks", "σ, m");
  a.curves = {{"2σ", Style::band, d.t, std::vector<double>(d.t.size(), 0.0), two_sigmas, Color::sky},
              {"error", Style::line, d.t, off, {}, Color::orange}};
  b.curves = {{"position, m", Style::line, d.t, d.sigma_m, {}, Color::blue},
              {"heading, °", Style::line, d.t, degrees, {}, Color::green}};
  b.log_y = e.log_y = true;
  for (const Track& track : d.tracks) {
    c.curves.push_back({"", Style::thin, track.t, track.error_m});
    e.curves.push_back({"", Style::thin, track.t, track.sigma_m});
  }
  return {id, title, 2, {a, b, c, e}};
}

}  // namespace

double Drive::mean_landmark_sigma_m() const {
  double sum = 0;
  for (const Matrix2d& P : covariances) sum += largest_sigma(P);
  return sum / static_cast<double>(covariances.size());
}

Data load() {
  const LoadedScenario loaded = load_scenario("car-park");
  Data data{read_range_recording(loaded), loaded.scenario.planar, {}, {}};
  data.settings.filter.linearization = Linearization::analytic;
  data.settings.health.max_sigma_position_m = 1e6;  // how far it diverges is the result
  data.anchors = {{2.8953, -4.0353}, {9.9489, 6.9239}};
  for (const auto& landmark : data.recording.landmarks) data.beacons.push_back(landmark.position);
  identify(data);
  return data;
}

Drive drive(const Data& data, const Variant& variant) { return Driver(data).run(settings_of(data, variant)); }

bool is_accurate(const Drive& d) { return d.map_rms_m < 0.25 && d.path_rms_m < 0.20; }

double FromOtherStarts::apart_from(const Drive& own) const {
  const auto relative = [](double x, double y) { return std::abs(x - y) / std::min(x, y); };
  double most = 0;
  for (const Drive& d : drives)
    most = std::max({most, relative(own.mean_landmark_sigma_m(), d.mean_landmark_sigma_m()),
                     relative(own.last_sigma_m(), d.last_sigma_m())});
  return most;
}

FromOtherStarts from_other_starts(const Data& data, Variant variant) {
  FromOtherStarts all;
  for (const Start& start : {Start{"a third of the position sigma", 1.0 / 3},
                             {"three times the position sigma", 3},
                             {"twice the heading sigma", 1, 2},
                             {"heading right and to 5°", 1, 1.0 / 3, true}}) {
    variant.start = start;
    all.starts.push_back(start.name);
    all.drives.push_back(drive(data, variant));
  }
  return all;
}

std::string last_sigmas(const Drive& d) {
  return fmt::format("{:.3f} and {:.3f}", d.mean_landmark_sigma_m(), d.last_sigma_m());
}

std::string sigmas_against(const Drive& one, const Drive& other) {
  return fmt::format("landmarks {:.3f} m against {:.3f} m, vehicle {:.3f} m against {:.3f} m",
                     one.mean_landmark_sigma_m(), other.mean_landmark_sigma_m(), one.last_sigma_m(),
                     other.last_sigma_m());
}

bool has_smaller_sigmas(const Drive& one, const Drive& other, double times) {
  return one.mean_landmark_sigma_m() < times * other.mean_landmark_sigma_m() &&
         one.last_sigma_m() < times * other.last_sigma_m();
}

double largest_growth(const Drive& d) {
  double most = 0;
  for (const Track& track : d.tracks)
    most = std::max(most, track.sigma_m.back() / track.sigma_m[track.sigma_m.size() / 2] - 1);
  return most;
}

Plot map(const std::string& id, const std::string& title, const Data& data, const Drive& d) {
  Panel panel{"", "east, m", "north, m", {}, true};
  panel.curves = {path_of("GPS", Style::thin, Color::gray, d.gps),
                  path_of("estimated path", Style::line, Color::orange, d.path),
                  path_of("surveyed beacons", Style::circles, Color::ink, data.beacons),
                  path_of("landmarks", Style::crosses, Color::blue, d.landmarks)};
  Curve outlines = ellipses("2σ", d.landmarks, d.covariances);
  outlines.color = Color::blue;
  panel.curves.push_back(outlines);
  if (!d.anchors.empty()) panel.curves.push_back(path_of("anchors", Style::stars, Color::green, d.anchors));
  return {id, title, 1, {panel}};
}

std::vector<Plot> frames_and_map(const std::string& frames_id, const std::string& map_id,
                                 const std::string& title, const Data& data, const Drive& d) {
  return {four_frames(frames_id, title, d), map(map_id, title, data, d)};
}

}  // namespace incognita::car_park
