#include "experiments/example_4_6_filter.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "incognita/math/angles.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/planar_frame.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita::two_bearings {
namespace {

using Pose = planar::Pose<double>;

/// The state in units, from the state.
VectorXd in_units() {
  VectorXd D = VectorXd::Constant(states, unit_m);
  D[2] = 1;
  return D;
}

MatrixXd triangle_of(const MatrixXd& rows) {
  const Eigen::Index n = rows.cols();
  return Eigen::HouseholderQR<MatrixXd>(rows).matrixQR().topRows(n).triangularView<Eigen::Upper>();
}

MatrixXd stacked(const MatrixXd& top, const MatrixXd& bottom) {
  MatrixXd rows(top.rows() + bottom.rows(), top.cols());
  rows << top, bottom;
  return rows;
}

/// (4.14) over a step, with the heading at its start.
planar::PoseJacobian tangent(const Pose& from, const Vector2d& input, double dt_s) {
  return DifferentialDrive{}.step(from, input, dt_s).F;
}

/// The bearings of both features by the state: (4.15), 2 x 7.
MatrixXd bearing_rows(const Pose& pose, const Features& features) {
  MatrixXd H = MatrixXd::Zero(2, states);
  int row = 0;
  for (const Vector2d& feature : {features.first, features.second}) {
    const auto prediction = RangeBearing::predict_measurement(pose, feature);
    H.row(row).head<3>() = prediction.value().Hv.row(1);
    H.row(row).segment<2>(3 + 2 * row) = prediction.value().Hl.row(1);
    ++row;
  }
  return H;
}

/// F of the whole state from that of the vehicle.
MatrixXd with_features(const planar::PoseJacobian& F) {
  MatrixXd whole = MatrixXd::Identity(states, states);
  whole.topLeftCorner<3, 3>() = F;
  return whole;
}

struct Stray {
  Pose pose;
  Features features;
};

Stray stray(RandomStream& random, const Pose& pose, const Features& features) {
  constexpr double sigma_m = 0.01, sigma_rad = radians(0.1);
  const auto off = [&] {
    const double x = random.normal();
    return Vector2d(sigma_m * x, sigma_m * random.normal());
  };
  Stray s{pose, features};
  s.pose.head<2>() += off();
  s.pose[2] += sigma_rad * random.normal();
  s.features.first += off();
  s.features.second += off();
  return s;
}

/// F and H of each step of a drive, and of the measurement after it.
class Linearized {
 public:
  explicit Linearized(const Setup& setup) : setup_(setup), drive_(drive(setup.dt_s)) {
    for (const Instant& i : drive_) strays_.push_back(stray(random_, i.pose, setup.features));
    for (std::size_t k = 0; k < drive_.size(); ++k) speed_errors_.push_back(0.02 * encoders_.normal());
  }

  std::size_t measurements() const { return drive_.size(); }

  /// Of the step that leads to measurement k.
  planar::PoseJacobian F(std::size_t k) const {
    const Pose &from = drive_[k - 1].pose, &to = drive_[k].pose;
    switch (setup_.jacobians) {
      case Jacobians::where_it_is:
      case Jacobians::measurements_late:
        break;
      case Jacobians::along_tangent:
        return tangent(from, drive_[k].input, setup_.dt_s);
      case Jacobians::odometry_late:
        return k < 2 ? planar::PoseJacobian::Identity() : planar::jacobian_between(drive_[k - 2].pose, from);
      case Jacobians::measured_speed:
        return planar::jacobian_between(from, from + (1 + speed_errors_[k]) * (to - from));
      case Jacobians::estimates: {
        const Pose& estimate = strays_[k - 1].pose;
        return planar::jacobian_between(estimate, arc(estimate, drive_[k].input, setup_.dt_s).x);
      }
    }
    return planar::jacobian_between(from, to);
  }

  MatrixXd G(std::size_t k) const { return arc(drive_[k - 1].pose, drive_[k].input, setup_.dt_s).G; }

  MatrixXd H(std::size_t k) const {
    if (setup_.jacobians == Jacobians::measurements_late && k > 0)
      return bearing_rows(drive_[k - 1].pose, setup_.features);
    if (setup_.jacobians == Jacobians::estimates) return bearing_rows(strays_[k].pose, strays_[k].features);
    return bearing_rows(drive_[k].pose, setup_.features);
  }

 private:
  Setup setup_;
  std::vector<Instant> drive_;
  RandomStream random_{1, "estimates"}, encoders_{1, "encoders"};
  std::vector<Stray> strays_;
  std::vector<double> speed_errors_;
};

Vector2d position(const Run& run, std::size_t measurement, int first_state) {
  if (first_state == x) return run.drive[measurement].pose.head<2>();
  return first_state == x1 ? run.setup.features.first : run.setup.features.second;
}

Direction constantly(const VectorXd& c) {
  return [c](const Run&, std::size_t) { return c; };
}

}  // namespace

planar::Step arc(const Pose& from, const Vector2d& input, double dt_s) {
  const double half = 0.5 * input[1] * dt_s, c = std::cos(from[2] + half), s = std::sin(from[2] + half);
  const bool straight = std::abs(half) < 1e-4;
  const double chord = straight ? 1 - half * half / 6 : std::sin(half) / half;  // of the arc's length
  const double chord_by_half =
      straight ? -half / 3 : (half * std::cos(half) - std::sin(half)) / (half * half);
  const Vector2d ahead(c, s), beside(-s, c);
  planar::Step step;
  step.x << from.head<2>() + input[0] * dt_s * chord * ahead, wrap_angle(from[2] + 2 * half);
  step.F = planar::jacobian_between(from, step.x);
  step.G.col(0) << dt_s * chord * ahead, 0;
  step.G.col(1) << input[0] * dt_s * (dt_s / 2) * (chord_by_half * ahead + chord * beside), dt_s;
  return step;
}

std::vector<Instant> drive(double dt_s) {
  const int steps = static_cast<int>(std::lround(end_s / dt_s));
  std::vector<Instant> all{{0, Pose::Zero(), Vector2d::Zero()}};
  for (int k = 1; k <= steps; ++k) {
    const double middle = (k - 0.5) * dt_s;
    const Vector2d input(middle > at_rest_until_s ? speed_mps : 0, middle > north_until_s ? turn_radps : 0);
    all.push_back({k * dt_s, arc(all.back().pose, input, dt_s).x, input});
  }
  return all;
}

void RootInformation::measure(const MatrixXd& H, double sigma) {
  root_ = triangle_of(stacked(root_, H / sigma));
}

// Square-root information smoothing of one step (Bierman 1977): rows over the step's noises, in sigmas, and
// the state after it; what a triangle leaves below the noises no longer depends on them.
void RootInformation::move(const MatrixXd& F, const MatrixXd& G, const VectorXd& sigmas) {
  const Eigen::Index n = root_.cols(), m = G.cols();
  const MatrixXd back = F.partialPivLu().solve(MatrixXd::Identity(n, n));
  MatrixXd rows = MatrixXd::Zero(m + n, m + n);
  rows.topLeftCorner(m, m).setIdentity();
  rows.bottomLeftCorner(n, m) = -root_ * back * G * sigmas.asDiagonal();
  rows.bottomRightCorner(n, n) = root_ * back;
  root_ = triangle_of(rows).bottomRightCorner(n, n);
}

Knowledge::Knowledge(const MatrixXd& root) {
  const MatrixXd scaled = root * in_units().asDiagonal();
  rank = rank_of(scaled, rank_tolerance);
  const Eigen::JacobiSVD<MatrixXd> svd(scaled, Eigen::ComputeFullV);
  unobservable = svd.matrixV().rightCols(states - rank.rank);
  known_ =
      svd.matrixV().leftCols(rank.rank) * svd.singularValues().head(rank.rank).cwiseInverse().asDiagonal();
}

double Knowledge::outside(const VectorXd& c) const {
  const VectorXd scaled = in_units().asDiagonal() * c;
  return (unobservable.transpose() * scaled).norm() / scaled.norm();
}

double Knowledge::marginal(const VectorXd& c) const {
  if (outside(c) > outside_tolerance) return 0;
  const VectorXd scaled = in_units().asDiagonal() * c;
  return 1 / (known_.transpose() * scaled).squaredNorm();
}

std::vector<Knowledge> course(const Setup& setup) {
  const Linearized steps(setup);
  MatrixXd noise_into = MatrixXd::Zero(states, 2);
  const Vector2d sigmas(setup.noise.sigma_speed_mps, setup.noise.sigma_turn_radps);
  RootInformation filter(states);
  if (setup.sigma_heading_rad)
    filter.measure(VectorXd::Unit(states, heading).transpose(), *setup.sigma_heading_rad);
  std::vector<Knowledge> all;
  for (std::size_t k = 0; k < steps.measurements(); ++k) {
    if (k > 0) {
      noise_into.topRows<3>() = steps.G(k);
      filter.move(with_features(steps.F(k)), noise_into, sigmas);
    }
    filter.measure(steps.H(k), setup.noise.sigma_bearing_rad);
    all.emplace_back(filter.root());
  }
  return all;
}

std::vector<Knowledge> along_the_motion(const Setup& setup) {
  const Linearized steps(setup);
  MatrixXd since_start = MatrixXd::Identity(states, states), rows = MatrixXd::Zero(states, states);
  std::vector<Knowledge> all;
  for (std::size_t k = 0; k < steps.measurements(); ++k) {
    if (k > 0) since_start = with_features(steps.F(k)) * since_start;
    rows = triangle_of(stacked(rows, steps.H(k) * since_start));
    all.emplace_back(rows);
  }
  return all;
}

std::vector<Knowledge> stripped(const Setup& setup) {
  const std::vector<Instant> instants = drive(setup.dt_s);
  MatrixXd rows = MatrixXd::Zero(states, states);
  std::vector<Knowledge> all;
  for (const Instant& i : instants) {
    MatrixXd F = MatrixXd::Zero(states, states);  // (4.14), per second
    F.topLeftCorner<3, 3>() = tangent(i.pose, i.input, 1) - planar::PoseJacobian::Identity();
    const MatrixXd H = bearing_rows(i.pose, setup.features);
    rows = triangle_of(stacked(rows, stacked(H, H * F)));
    all.emplace_back(rows);
  }
  return all;
}

Run::Run(const Setup& s) : setup(s), drive(two_bearings::drive(s.dt_s)), known(course(s)) {}

Direction sum(const std::vector<int>& of) {
  VectorXd c = VectorXd::Zero(states);
  for (const int i : of) c[i] = 1;
  return constantly(c);
}

Direction difference(int i, int j) {
  return constantly(VectorXd::Unit(states, i) - VectorXd::Unit(states, j));
}

Direction distance(int from, int to) {
  return [=](const Run& run, std::size_t measurement) {
    const Vector2d ahead = (position(run, measurement, to) - position(run, measurement, from)).normalized();
    VectorXd c = VectorXd::Zero(states);
    c.segment<2>(from) = -ahead;
    c.segment<2>(to) = ahead;
    return c;
  };
}

std::vector<double> information(const Run& run, const Direction& c) {
  std::vector<double> all;
  for (std::size_t k = 0; k < run.known.size(); ++k) all.push_back(run.known[k].marginal(c(run, k)));
  return all;
}

}  // namespace incognita::two_bearings
