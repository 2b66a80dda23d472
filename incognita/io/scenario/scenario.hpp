// A scenario: all settings of a run as plain structs. Which of them a scenario has follows from its choices:
// scenario_tree.cpp.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "incognita/control/paths/reference_path.hpp"
#include "incognita/control/settings.hpp"
#include "incognita/decision/settings.hpp"
#include "incognita/io/scenario/live_settings.hpp"
#include "incognita/io/scenario/robot_settings.hpp"
#include "incognita/math/setting.hpp"
#include "incognita/models/motion/mount.hpp"
#include "incognita/slam/features/settings.hpp"
#include "incognita/slam/points/planar_settings.hpp"
#include "incognita/world/settings.hpp"

namespace incognita {

struct RunSettings {
  std::int64_t seed = 1;
  double duration_s = 60;
  double rate_hz = 30;
  bool observability = true;
  bool entropy = true;
  double save_every_s = 0;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = RunSettings;
    setting(&S::seed, "seed", "", at_least(0), "Seed of all random streams");
    setting(&S::duration_s, "duration_s", "s", above_up_to(0, 1e7),
            "Limit of the duration; a recording may end earlier");
    setting(&S::rate_hz, "rate_hz", "Hz", above_up_to(0, 10000),
            "Frame rate of simulations and of recordings without time stamps");
    setting(&S::observability, "observability", "", any(),
            "Whether the observability of the running filter is analyzed");
    setting(&S::entropy, "entropy", "", any(),
            "Whether the entropies of vehicle, map and both are computed; without, their outputs are empty");
    setting(
        &S::save_every_s, "save_every_s", "s", between(0, 1e7),
        "Time of the run from one save of its whole state to the next, in run.state; 0: only at its end and on request");
  }
};

struct WorldSettings {
  enum class Type {
    room,       ///< rendered, closed loop
    points,     ///< simulated point landmarks
    recording,  ///< replayed
    live,       ///< a camera, while it takes its images
    robot       ///< a vehicle that carries a camera, reached by rosbridge
  };
  Type type = Type::room;

  static void describe(auto&& setting) {
    setting(
        &WorldSettings::type, "type", "", limits::any(),
        "World: rendered room, simulated point landmarks, a recording, what a camera sees now, or a robot that is "
        "reached by rosbridge");
  }
};

/// The sensor of every body, by its word in models/registry.hpp.
struct SensorSettings {
  std::string type = "camera";
  bool measures_vehicles = true;
  double field_of_view_rad = 6.2831853;
  int ticks_per_measurement = 1;
  std::map<std::string, double> parameters = {};  ///< of the chosen sensor, by key

  static void describe(auto&& setting) {
    using namespace limits;
    using S = SensorSettings;
    setting(&S::type, "type", "", any(), "Sensor of each body");
    setting(&S::measures_vehicles, "measures_vehicles", "", any(), "Whether the vehicles measure each other");
    setting(&S::field_of_view_rad, "field_of_view_rad", "rad", above_up_to(0, 6.2831854),
            "Field of view of a scanner, centered straight ahead");
    setting(&S::ticks_per_measurement, "ticks_per_measurement", "", between(1, 100000),
            "Measurement interval in ticks");
  }
};

struct WideAngleLens {
  double kd1_per_px2 = 0;

  static void describe(auto&& setting) {
    setting(&WideAngleLens::kd1_per_px2, "kd1_per_px2", "1/px^2", limits::at_least(0),
            "Radial distortion of (5.26)");
  }
};

/// Distortion as in OpenCV.
struct PinholeLens {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = PinholeLens;
    setting(&S::k1, "k1", "", any(), "Radial distortion, first term, as in OpenCV");
    setting(&S::k2, "k2", "", any(), "Radial distortion, second term");
    setting(&S::p1, "p1", "", any(), "Tangential distortion, first term");
    setting(&S::p2, "p2", "", any(), "Tangential distortion, second term");
    setting(&S::k3, "k3", "", any(), "Radial distortion, third term");
  }
};

/// Distortion as in OpenCV's fisheye module, Kalibr's `equidistant`.
struct FisheyeLens {
  double k1 = 0, k2 = 0, k3 = 0, k4 = 0;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = FisheyeLens;
    setting(&S::k1, "k1", "", any(), "Radial distortion, first term, as in OpenCV");
    setting(&S::k2, "k2", "", any(), "Radial distortion, second term");
    setting(&S::k3, "k3", "", any(), "Radial distortion, third term");
    setting(&S::k4, "k4", "", any(), "Radial distortion, fourth term");
  }
};

struct CameraSettings {
  std::string file;  ///< of a calibration that replaces the defaults of all others; read by the loader
  std::variant<WideAngleLens, PinholeLens, FisheyeLens> model;
  int width_px = 320;
  int height_px = 240;
  double fu_px = 195;
  double fv_px = 195;
  double u0_px = 159.5;
  double v0_px = 119.5;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = CameraSettings;
    setting(
        &S::file, "file", "", any(),
        "Calibration file that gives all of [camera], as `incognita calibrate` writes it, or of Kalibr, ROS, OpenCV, "
        "EuRoC or KITTI; beside the scenario, in the working folder or under the data folder; empty: none");
    setting(&S::model, "model", "", any(), "Projection and distortion model");
    setting(&S::width_px, "width_px", "px", between(16, 16384), "Width of the image");
    setting(&S::height_px, "height_px", "px", between(16, 16384), "Height of the image");
    setting(&S::fu_px, "fu_px", "px", above_up_to(0, 1e6), "Focal length over the width of a pixel");
    setting(&S::fv_px, "fv_px", "px", above_up_to(0, 1e6), "Focal length over the height of a pixel");
    setting(&S::u0_px, "u0_px", "px", any(),
            "Column of the principal point; the center of the first pixel is 0");
    setting(&S::v0_px, "v0_px", "px", any(),
            "Row of the principal point; the center of the first pixel is 0");
  }
};

struct RecordingSettings {
  enum class Format { automatic, images, tum, euroc, kitti, video, bag, acfr, mrclam, tables };
  /// The frame of the true poses.
  enum class TruthFrame {
    own,      ///< any; errors are after a fit
    estimate  ///< that of the estimate, e.g. of the target
  };

  Format format = Format::automatic;
  std::string folder;
  std::string pattern;
  bool check_calibration = true;
  std::string truth;
  std::string image_topic;
  std::string truth_topic;
  double truth_offset_s = 0;
  TruthFrame truth_frame = TruthFrame::own;
  int robot = 1;
  bool team = false;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = RecordingSettings;
    setting(&S::format, "format", "", any(), "Format of the recording; `auto`: guessed from its files");
    setting(&S::folder, "folder", "", any(),
            "Folder of the recording, or its file if it is a video or a bag, relative to the data folder");
    setting(&S::pattern, "pattern", "", any(),
            "Shell pattern of the file names of the images; empty: all images, which must be of one kind");
    setting(&S::check_calibration, "check_calibration", "", any(),
            "Whether the camera is compared with the calibration of the recording");
    setting(
        &S::truth, "truth", "", any(),
        "File of the true camera poses: TUM, or 4x4 or 3x4 matrices, one per image; or a folder with a 4x4 matrix "
        "per file; relative to the recording or to the data folder; empty: as the recording has it");
    setting(&S::image_topic, "image_topic", "", any(),
            "Topic of the images in a bag; empty: guessed, and said");
    setting(&S::truth_topic, "truth_topic", "", any(),
            "Topic of the true poses in a bag, e.g. of motion capture, or `/tf`; empty: guessed, and said");
    setting(&S::truth_offset_s, "truth_offset_s", "s", any(),
            "Time of the images minus time of the true poses, for two clocks");
    setting(
        &S::truth_frame, "truth_frame", "", any(),
        "Frame of the true poses: `own`, so that errors are after a fit, or `estimate`, that of the target");
    setting(&S::robot, "robot", "", between(1, 5), "Number of the recorded robot");
    setting(&S::team, "team", "", any(), "Whether all recorded robots are estimated in one belief");
  }
};

/// Initial poses of several vehicles and their uncertainty.
struct TeamStartSettings {
  std::vector<Eigen::Vector3d> positions_m{{0, 0, 0}};
  std::vector<double> headings_rad{0};
  double sigma_position_m = 0.01;
  double sigma_height_m = 0.01;
  double sigma_heading_rad = 0.01;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = TeamStartSettings;
    setting(&S::positions_m, "positions_m", "m", between(-1e6, 1e6),
            "Initial positions, [x, y, z] each; their number is the number of vehicles");
    setting(&S::headings_rad, "headings_rad", "rad", between(-6.3, 6.3),
            "Initial headings about z, from the x axis; one each, or one for all");
    setting(&S::sigma_position_m, "sigma_position_m", "m", between(0, 1e6),
            "Standard deviation of the initial position, per axis");
    setting(&S::sigma_height_m, "sigma_height_m", "m", between(0, 1e6),
            "Standard deviation of the initial height");
    setting(&S::sigma_heading_rad, "sigma_heading_rad", "rad", between(0, 3.2),
            "Standard deviation of the initial heading; of a body in space, of each of its three rotations");
  }
};

struct FormSettings {
  BeliefForm form = BeliefForm::covariance;

  static void describe(auto&& setting) {
    setting(&FormSettings::form, "form", "", limits::any(),
            "Representation of the belief: the same estimate at different cost");
  }
};

/// Point landmarks of a simulation.
struct PointsSettings {
  std::string file;
  int count = 16;
  Eigen::Vector3d size_m{30, 30, 2.5};
  Eigen::Vector2d center_m{0, 0};
  int known = 0;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = PointsSettings;
    setting(&S::file, "file", "", any(),
            "Table of the landmarks with columns id, x, y, z, beside the scenario or under the data folder; "
            "empty: random landmarks");
    setting(&S::count, "count", "", between(0, 10000), "Number of random landmarks");
    setting(&S::size_m, "size_m", "m", between(0, 1e6),
            "Box of the random landmarks: uniform in +-x/2, +-y/2 about the center, and 0 to z");
    setting(&S::center_m, "center_m", "m", between(-1e6, 1e6), "Center of the random landmarks");
    setting(&S::known, "known", "", between(-1, 100000),
            "Number of landmarks that the estimator has as anchors; -1: all, for localization only");
  }
};

/// The true vehicle where it differs from the estimator's model.
struct TruePlantSettings {
  enum class Motion { as_modeled, terrain };

  Motion motion = Motion::as_modeled;
  double speed_ratio = 1;
  double turn_ratio = 1;
  double sigma_start_position_m = 0.01;
  double sigma_start_height_m = 0.01;
  double sigma_start_heading_rad = 0.01;
  double sigma_speed_m_s = 0.05;
  double sigma_turn_rate_rad_s = 0.02;
  double sigma_steering_rad = 0.01;
  double sigma_acceleration_m_s2 = 0.3;
  double sigma_angular_acceleration_rad_s2 = 0.3;
  double sigma_range_m = 0.1;
  double sigma_range_ratio = 0;
  double sigma_bearing_rad = 0.0174533;
  double sigma_pixel_px = 1;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = TruePlantSettings;
    setting(&S::motion, "motion", "", any(),
            "True motion: that of the estimator's model, or a vehicle on uneven ground");
    setting(&S::speed_ratio, "speed_ratio", "", between(0.1, 10), "True speed over the measured one");
    setting(&S::turn_ratio, "turn_ratio", "", between(0.1, 10),
            "True turn rate or steering angle over the measured one");
    setting(&S::sigma_start_position_m, "sigma_start_position_m", "m", between(0, 1e6),
            "Standard deviation of the true initial position about the nominal one, per axis");
    setting(&S::sigma_start_height_m, "sigma_start_height_m", "m", between(0, 1e6),
            "Standard deviation of the true initial height about the nominal one");
    setting(&S::sigma_start_heading_rad, "sigma_start_heading_rad", "rad", between(0, 3.2),
            "Standard deviation of the true initial heading about the nominal one");
    setting(&S::sigma_speed_m_s, "sigma_speed_m_s", "m/s", between(0, 1000),
            "Standard deviation of the true disturbance of the speed, constant over one tick");
    setting(&S::sigma_turn_rate_rad_s, "sigma_turn_rate_rad_s", "rad/s", between(0, 1000),
            "Standard deviation of the true disturbance of the turn rate, constant over one tick");
    setting(&S::sigma_steering_rad, "sigma_steering_rad", "rad", between(0, 3.2),
            "Standard deviation of the true disturbance of the steering angle, constant over one tick");
    setting(
        &S::sigma_acceleration_m_s2, "sigma_acceleration_m_s2", "m/s^2", between(0, 1e4),
        "Standard deviation of the true disturbance of the acceleration per axis, constant over one tick");
    setting(&S::sigma_angular_acceleration_rad_s2, "sigma_angular_acceleration_rad_s2", "rad/s^2",
            between(0, 1e4),
            "Standard deviation of the true disturbance of the angular acceleration per axis");
    setting(&S::sigma_range_m, "sigma_range_m", "m", between(0, 1000),
            "Standard deviation of the true noise of a range measurement");
    setting(&S::sigma_range_ratio, "sigma_range_ratio", "", between(0, 1),
            "Share of the range that is added to the true standard deviation of a range measurement");
    setting(&S::sigma_bearing_rad, "sigma_bearing_rad", "rad", between(0, 3.2),
            "Standard deviation of the true noise of a bearing measurement");
    setting(&S::sigma_pixel_px, "sigma_pixel_px", "px", between(0, 100),
            "Standard deviation of the true noise of an image position, per axis");
  }
};

struct PlaneTerrain {
  double slope_x = 0, slope_y = 0;

  static void describe(auto&& setting) {
    setting(&PlaneTerrain::slope_x, "slope_x", "", limits::between(-2, 2), "Slope along x");
    setting(&PlaneTerrain::slope_y, "slope_y", "", limits::between(-2, 2), "Slope along y");
  }
};

/// Two perpendicular waves.
struct WavesTerrain {
  double amplitude_m = 0.15;
  double length_m = 6;

  static void describe(auto&& setting) {
    setting(&WavesTerrain::amplitude_m, "amplitude_m", "m", limits::between(0, 100),
            "Amplitude of each of the two perpendicular waves");
    setting(&WavesTerrain::length_m, "length_m", "m", limits::between(0.01, 1e5), "Length of each wave");
  }
};

/// A height map from a gray image.
struct ImageTerrain {
  std::string file;
  double size_m = 6;
  double height_m = 0.3;

  static void describe(auto&& setting) {
    using namespace limits;
    setting(
        &ImageTerrain::file, "file", "", any(),
        "Gray image of 8 or 16 bits, seen from above with its center at the origin and x to the right; beside "
        "the scenario or under the data folder");
    setting(&ImageTerrain::size_m, "size_m", "m", between(0.01, 1e5),
            "Extent along x, from the centers of the first pixels to those of the last");
    setting(&ImageTerrain::height_m, "height_m", "m", between(-100, 100), "Height of white; black is at 0");
  }
};

struct TerrainSettings {
  std::variant<WavesTerrain, PlaneTerrain, ImageTerrain> type;

  static void describe(auto&& setting) {
    setting(&TerrainSettings::type, "type", "", limits::any(), "Surface of the ground");
  }
};

/// Axes of the poses of a trajectory: those of a camera, x right, y down, z forward.
struct CameraAxes {
  static void describe(auto&&) {}
};

/// Those of a body that carries the camera at its origin. The default are the axes of the EuRoC vehicle, x up and z
/// forward.
struct BodyAxes {
  Eigen::Vector3d body_from_camera_rad{0, 0, 1.5707963267948966};

  static void describe(auto&& setting) {
    setting(
        &BodyAxes::body_from_camera_rad, "body_from_camera_rad", "rad", limits::between(-6.3, 6.3),
        "Rotation vector from camera axes (x right, y down, z forward) to those of the trajectory; the default "
        "is for x up and z forward, as in EuRoC; [-1.2092, 1.2092, -1.2092] is for x forward and z up");
  }
};

/// The camera moves by itself: it obeys commands.
struct CommandedMotion {
  static void describe(auto&&) {}
};

/// The camera follows a recorded trajectory, placed in the room.
struct TrajectoryMotion {
  std::string file;
  double start_s = 0;
  std::variant<CameraAxes, BodyAxes> axes;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = TrajectoryMotion;
    setting(
        &S::file, "file", "", any(),
        "Trajectory as lines of t x y z qx qy qz qw (TUM), or a table of EuRoC, z up; beside the scenario or under "
        "the data folder");
    setting(&S::start_s, "start_s", "s", between(0, 1e7),
            "Time after the start of the trajectory at which the run starts");
    setting(&S::axes, "axes", "", any(), "Axes of the orientations in the trajectory");
  }
};

/// The true motion of the camera in the rendered room.
struct MotionSettings {
  std::variant<CommandedMotion, TrajectoryMotion> type;

  static void describe(auto&& setting) {
    setting(&MotionSettings::type, "type", "", limits::any(),
            "True motion of the camera: as commanded, or along a recorded trajectory, whatever is commanded");
  }
};

struct ControllerSettings {
  ControlLaw law = ControlLaw::none;
  std::vector<double> input{};
  double max_speed_m_s = 1, max_turn_rate_rad_s = 1, max_steering_rad = 0.6;
  double avoidance_distance_m = 0;

  static void describe(auto&& setting) {
    using namespace limits;
    using S = ControllerSettings;
    setting(
        &S::law, "law", "", any(),
        "Control law; `none`: a constant input; `active`: the action chosen by the decision, thesis Chapter 6");
    setting(
        &S::input, "input", "", between(-1e4, 1e4),
        "Constant input: speed (m/s) and turn rate (rad/s) or steering angle (rad); of a body in space, three "
        "accelerations (m/s^2) and three angular accelerations (rad/s^2); empty: 0");
    setting(&S::max_speed_m_s, "max_speed_m_s", "m/s", above_up_to(0, 1000), "Limit of the speed");
    setting(&S::max_turn_rate_rad_s, "max_turn_rate_rad_s", "rad/s", above_up_to(0, 1000),
            "Limit of the turn rate");
    setting(&S::max_steering_rad, "max_steering_rad", "rad", above_up_to(0, 1.5),
            "Limit of the steering angle");
    setting(
        &S::avoidance_distance_m, "avoidance_distance_m", "m", between(0, 10),
        "Distance of walls and boxes from the axle below which the vehicle slows down and turns away; 0: off");
  }
};

/// A path from a table.
struct PathFile {
  std::string file;

  static void describe(auto&& setting) {
    setting(
        &PathFile::file, "file", "", limits::any(),
        "Table with columns t, x, y and, optionally, z and heading, beside the scenario or under the data "
        "folder");
  }
};

struct PathSettings {
  std::variant<PointPath, CirclePath, BackAndForthPath, WayPointPath, PathFile> type;
  std::vector<Eigen::Vector3d> offsets_m{};

  static void describe(auto&& setting) {
    using namespace limits;
    setting(&PathSettings::type, "type", "", any(), "Reference path in time");
    setting(&PathSettings::offsets_m, "offsets_m", "m", between(-1e6, 1e6),
            "Offset of the path of each vehicle, [x, y, z] each; empty: none");
  }
};

struct Scenario {
  RunSettings run;
  WorldSettings world;
  SensorSettings sensor;
  CameraSettings camera;
  RecordingSettings recording;
  LiveSettings live;
  RoomSettings room;
  ExposureSettings exposure;
  MotionSettings true_motion;
  PointsSettings points;
  StartSettings start;
  TeamStartSettings team_start;
  CameraSlamSettings slam;
  PlanarSlamSettings planar;
  FormSettings belief;
  DecisionSettings decision;
  ExplorationSettings exploration;
  ControllerSettings controller;
  LawSettings law_settings;
  ControlSettings control;
  PathSettings path;
  OperatorSettings operator_settings;
  TruePlantSettings plant;
  TerrainSettings terrain;
  Mount mount{.up_m = 0.6};
  RobotSettings robot;

  const MotionTraits& motion() const { return motion_traits_of(planar.vehicle.model); }
  const SensorTraits& measured() const { return sensor_traits_of(sensor.type, motion()); }
  bool is_recording() const { return world.type == WorldSettings::Type::recording; }
  bool is_live() const { return world.type == WorldSettings::Type::live; }
  bool is_simulated() const { return world.type == WorldSettings::Type::points; }
  /// Whether vehicles are estimated in one team belief: with simulated point landmarks, or from a team recording.
  bool is_team() const { return is_simulated() || (is_recording() && recording.team); }
  /// Whether a vehicle on uneven ground carries the camera through the rendered room.
  bool is_room_vehicle() const {
    return world.type == WorldSettings::Type::room && motion().space == Space::uneven_ground;
  }
  bool is_robot() const { return world.type == WorldSettings::Type::robot; }
  /// Whether the camera that maps by its images is on a vehicle: thesis Section 6.4.
  bool is_camera_vehicle() const { return is_room_vehicle() || is_robot(); }
  /// Whether the true motion is that of a recording, also in the rendered room, or of a person: commands and disturbances have
  /// no effect.
  bool has_recorded_motion() const {
    return is_recording() || is_live() ||
           (world.type == WorldSettings::Type::room && !is_room_vehicle() &&
            std::holds_alternative<TrajectoryMotion>(true_motion.type));
  }
  /// Whether a camera is carried by a vehicle that its filter does not model: thesis Section 6.4.
  bool has_carried_camera() const {
    return is_simulated() && motion().in_space() && plant.motion == TruePlantSettings::Motion::terrain;
  }
  /// Whether the observability monitor knows the symmetries of the sensors: of cameras that map by their images, and of
  /// ranges and bearings on a plane.
  bool has_observability_report() const {
    return !is_team() || (motion().is_planar_pose() && sensor.type == "range-bearing");
  }
  bool decides() const { return controller.law == ControlLaw::active; }
};

}  // namespace incognita
