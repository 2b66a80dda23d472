// The information filter of thesis Example 4.6: a planar vehicle with known speeds measures the bearings of
// two features, without prior information.
//
// State (7): x (m, north), y (m, east), heading (rad, from north to the east), then x and y of both features:
// (4.13). Its Jacobians are evaluated at the truth, which is known exactly: 10 s at rest facing north, 4 s to
// the north at 1 m/s, then 6 s along an arc to the east at 0.25 rad/s, as the text has it. (The caption of
// Figure 4.3 says five seconds, and would end 14 degrees before.) Both features are measured at the start and
// after each step.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/models/motion/planar_vehicle.hpp"
#include "incognita/report/plot.hpp"

namespace incognita::two_bearings {

using Eigen::MatrixXd, Eigen::Vector2d, Eigen::VectorXd;

inline constexpr int states = 7;
inline constexpr double at_rest_until_s = 10, north_until_s = 14, end_s = 20;
inline constexpr double speed_mps = 1, turn_radps = 0.25;

/// What a meter weighs against a radian where directions of the state are compared: this many are one unit.
inline constexpr double unit_m = 10;
/// Singular values of the information's root count above this of the largest; 1e-18 in the information.
inline constexpr double rank_tolerance = 1e-9;
/// There is information about a direction when no more than this share of it is unobservable.
inline constexpr double outside_tolerance = 1e-7;

struct Features {
  Vector2d first = {15, 0};    ///< m; straight ahead at first
  Vector2d second = {12, 12};  ///< m; to the north-east
};

/// The thesis does not print its noises.
struct Noise {
  double sigma_speed_mps = 0.05;   ///< of each step's mean speed
  double sigma_turn_radps = 0.02;  ///< of each step's mean turn rate
  double sigma_bearing_rad = 0.02;
};

/// Where F and H of a step and of the measurement after it are evaluated.
enum class Jacobians {
  where_it_is,        ///< F between the true poses, H at the true pose
  along_tangent,      ///< F by (4.14), with the heading at the step's start, as (3.17)
  measurements_late,  ///< H where the vehicle was a step ago
  odometry_late,      ///< F with what it did a step ago
  measured_speed,     ///< F with the speeds of encoders, 2 % off at random
  estimates           ///< F and H at poses and features that stray by 1 cm and 0.1 degrees about the truth
};

struct Setup {
  Features features = {};
  Noise noise = {};
  double dt_s = 0.1;  ///< a divisor of 2 s
  Jacobians jacobians = Jacobians::where_it_is;
  std::optional<double> sigma_heading_rad = {};  ///< how well the first heading is known; else not at all
};

struct Instant {
  double t_s = 0;
  planar::Pose<double> pose;  ///< the truth
  Vector2d input;             ///< speed and turn rate of the step that led here; 0 at the start
};
std::vector<Instant> drive(double dt_s);

/// The pose after an arc of constant speed and turn rate, and its derivatives: exact, not along the tangent.
planar::Step arc(const planar::Pose<double>& from, const Vector2d& input, double dt_s);

/// An information matrix Y = R'R by its root R. Directions without information stay so to rounding,
/// which in Y itself would exceed differences of measurements below 1e-8.
class RootInformation {
 public:
  explicit RootInformation(Eigen::Index size) : root_(MatrixXd::Zero(size, size)) {}

  /// Y + H'H / sigma^2
  void measure(const MatrixXd& H, double sigma);
  /// M - M G (G'M G + Q^-1)^-1 G'M with M = F^-T Y F^-1, also where Y or Q has no inverse; Q is diagonal.
  void move(const MatrixXd& F, const MatrixXd& G, const VectorXd& sigmas);

  const MatrixXd& root() const { return root_; }
  MatrixXd matrix() const { return root_.transpose() * root_; }

 private:
  MatrixXd root_;  ///< upper triangle
};

/// The information of a root of 7 columns, with meters in units of `unit_m`.
class Knowledge {
 public:
  explicit Knowledge(const MatrixXd& root);

  Rank rank;  ///< of the root
  /// Whether the rank is unambiguous.
  bool clear() const { return rank.gap >= 1000; }
  /// Orthonormal columns, in units: unobservable directions of the state.
  MatrixXd unobservable;

  /// The share (0 to 1) of a direction c of the state that is unobservable.
  double outside(const VectorXd& c) const;
  /// Marginal information of c'x: the inverse of its variance, c'Y^+ c, when nothing of c is outside, else 0.
  /// With c a state it is the Schur complement, with a pseudoinverse: the limit of ever weaker priors.
  double marginal(const VectorXd& c) const;

 private:
  MatrixXd known_;  ///< columns over their singular values
};

/// The information after each measurement of the drive.
std::vector<Knowledge> course(const Setup& setup);

/// Two observability matrices of all measurements up to each one: [H_0; H_1 F_0; H_2 F_1 F_0; ...] along the
/// motion,
std::vector<Knowledge> along_the_motion(const Setup& setup);
/// and (4.8), each step a segment with the [H; H F] of (4.14) and (4.15) where it ends.
std::vector<Knowledge> stripped(const Setup& setup);

/// A drive and the information after each measurement.
struct Run {
  Setup setup;
  std::vector<Instant> drive;
  std::vector<Knowledge> known;
  explicit Run(const Setup& s);
  std::size_t measurement_at(double t_s) const {
    return static_cast<std::size_t>(std::lround(t_s / setup.dt_s));
  }
};

/// A direction of the state, at the pose after a measurement.
using Direction = std::function<VectorXd(const Run&, std::size_t measurement)>;

inline constexpr int x = 0, y = 1, heading = 2, x1 = 3, y1 = 4, x2 = 5, y2 = 6;  // states
Direction sum(const std::vector<int>& of);
inline Direction state(int i) { return sum({i}); }
Direction difference(int i, int j);
/// Of the vehicle or a feature, by its first state, from another one.
Direction distance(int from, int to);

/// Marginal information after each measurement, in 1/m^2 or 1/rad^2.
std::vector<double> information(const Run& run, const Direction& c);

/// Figures 4.3 to 4.6.
std::vector<Plot> figures();

}  // namespace incognita::two_bearings
