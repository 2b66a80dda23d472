// The car park of thesis Examples 3.2, 3.5, 3.7, 3.9 and 3.11: one drive, several filters.
//
// Fixed before anything was compared: recording, vehicle, noises and start of scenarios/car-park.toml, which
// are those of the recording's authors (0.7 m/s, 7 degrees, 0.1 m, 1 degree; start at the first GPS fix,
// heading -112 degrees give or take 15), the 112 s they use, unknown association by joint compatibility. GPS
// gives the first position and is otherwise the truth. A landmark is compared with its surveyed beacon.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "incognita/analysis/evaluation/map_error.hpp"
#include "incognita/report/experiment.hpp"
#include "incognita/report/plot.hpp"
#include "incognita/slam/points/planar_settings.hpp"
#include "incognita/world/replay/range_recording.hpp"

namespace incognita::car_park {

inline constexpr double duration_s = 112;

struct Data {
  RangeRecording
      recording;  ///< detections have the identities of their beacons, for `known` association and for counting
  PlanarSlamSettings settings;           ///< of the scenario, with the thesis' plain EKF
  std::vector<Eigen::Vector2d> beacons;  ///< surveyed
  std::vector<Eigen::Vector2d> anchors;  ///< (2.8953, -4.0353) and (9.9489, 6.9239)
};

/// Throws InputError, saying where the recording is published, when it is not there.
Data load();

/// One landmark over the drive, from its initialization.
struct Track {
  std::vector<double> t, sigma_m, error_m;  ///< s; in the worst direction; from its beacon, NaN without one
};

struct Drive {
  std::vector<double> t;                           ///< s, of scans
  std::vector<Eigen::Vector2d> path, gps;          ///< gps NaN where there is none
  std::vector<double> sigma_m, sigma_heading_rad;  ///< of the vehicle; the position's in the worst direction
  std::vector<Track> tracks;                       ///< by landmark, anchors left out
  std::vector<Eigen::Vector2d> landmarks;          ///< at the end
  std::vector<Eigen::Matrix2d> covariances;
  std::vector<Eigen::Vector2d> anchors;
  FittedMapError fitted;  ///< after a rigid fit to the survey, begun from that of the path to GPS
  double map_rms_m = 0;   ///< before it, the same landmarks and beacons
  double path_rms_m = 0;  ///< vehicle against GPS
  double fitted_path_rms_m = 0;
  int detections = 0, matched = 0;
  int wrong = 0;              ///< matches with a landmark that was initialized from another beacon
  int often_seen = 0;         ///< beacons, anchors left out, with ten detections or more
  int often_seen_mapped = 0;  ///< of them, those near a landmark after the fit
  double mean_landmark_sigma_m() const;
  double last_sigma_m() const { return sigma_m.back(); }
};

/// A start other than the recording's.
struct Start {
  std::string name = {};
  double position_times = 1, heading_times = 1;  ///< of the sigmas
  bool right_heading = false;                    ///< -127 degrees
  double heading_off_deg = 0;
};

/// What a filter has other than the plain EKF of the scenario without anchors.
struct Variant {
  bool anchored = false;
  Linearization linearization = Linearization::analytic;
  Decorrelation decorrelate = Decorrelation::nothing;
  MapFrame map_frame = MapFrame::world;
  bool right_associations = false;
  bool nearest_neighbor = false;  ///< instead of joint compatibility
  bool gps_all_along = false;
  Start start = {};
};
Drive drive(const Data& data, const Variant& variant);

/// Landmarks within 0.25 m rms of the survey and the vehicle within 0.20 m rms of GPS, nothing fitted.
bool is_accurate(const Drive& drive);

/// The variant from other consistent starts: no sigma is smaller than the error allows (the authors' heading
/// is 15 degrees off).
struct FromOtherStarts {
  std::vector<std::string> starts;
  std::vector<Drive> drives;
  /// The largest relative difference from `own` of the sigmas at the end: landmarks' mean, and the vehicle's.
  double apart_from(const Drive& own) const;
};
FromOtherStarts from_other_starts(const Data& data, Variant variant);

/// `0.1 and 0.2`: sigmas at the end, landmarks' mean and the vehicle's.
std::string last_sigmas(const Drive& drive);
/// `landmarks 0.1 m against 0.2 m, vehicle ...`
std::string sigmas_against(const Drive& one, const Drive& other);
bool has_smaller_sigmas(const Drive& one, const Drive& other, double times = 1);

/// The largest share by which a landmark's sigma grows in the second half of its life.
double largest_growth(const Drive& drive);

/// Sigmas that differ by less, relatively, count as equal.
inline constexpr double same_sigmas = 0.10;

/// Path and landmarks with 2-sigma ellipses, GPS and surveyed beacons, as in Figure 3.6.
Plot map(const std::string& id, const std::string& title, const Data& data, const Drive& drive);

/// Four frames over time as in Figure 3.5 (vehicle error within 2 sigma, its sigma, landmark errors, their
/// sigmas), and the map.
std::vector<Plot> frames_and_map(const std::string& frames_id, const std::string& map_id,
                                 const std::string& title, const Data& data, const Drive& drive);

}  // namespace incognita::car_park
