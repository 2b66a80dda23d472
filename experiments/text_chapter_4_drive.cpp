#include "experiments/text_chapter_4_drive.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "experiments/example_4_6_filter.hpp"
#include "incognita/belief/belief.hpp"
#include "incognita/math/random.hpp"
#include "incognita/models/motion/planar_frame.hpp"
#include "incognita/models/sensors/bearing.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita::bearing_drive {
namespace {

using Eigen::Vector2d, Eigen::Vector3d, Eigen::VectorXd, Eigen::MatrixXd;
using Pose = planar::Pose<double>;

double bearing_of(const Pose& pose, const Vector2d& point) { return Bearing::h<double>(pose, point)[0]; }

class MappingVehicle {
 public:
  MappingVehicle(const Drive& settings, std::uint64_t seed)
      : settings_(settings), random_(seed, "bearing drive") {
    const Unknowns& u = settings.unknowns;
    const Vector3d sigmas(u.sigma_position_m, u.sigma_position_m, u.sigma_heading_rad);
    first_pose_ = estimated(Pose(sigmas.cwiseProduct(three_normals())), truth_);
    vehicle_ =
        belief_.add_vehicle(planar::pose_chart, first_pose_, sigmas.cwiseAbs2().asDiagonal().toDenseMatrix());
    for (const Vector2d& feature : settings.features) place(feature);
    measure();
  }

  void step(const Vector2d& input) {
    const Noise& n = settings_.noise;
    const Vector2d sigmas = (input.isZero() ? 0 : 1) * Vector2d(n.sigma_speed_mps, n.sigma_turn_radps);
    const Vector2d true_input = input + sigmas.cwiseProduct(two_normals());
    const Pose before = pose();
    truth_ = arc(truth_, true_input).x;
    const planar::Step moved = arc(before, at_truth() ? true_input : input);
    const Pose from = settings_.linearized == Linearized::at_first_estimates ? first_pose_ : before;
    first_pose_ = moved.x;
    LinearizedMotion motion;
    motion.block = vehicle_;
    motion.x_next = moved.x;
    motion.A = planar::jacobian_between(from, moved.x);
    motion.N = moved.G * sigmas.cwiseAbs2().asDiagonal() * moved.G.transpose();
    belief_.predict(motion);
    measure();
  }

  Moment now(double t_s) const {
    Moment m{t_s, truth_, VectorXd(belief_.errors()), belief_.dense_covariance()};
    m.error.head<3>() = truth_ - pose();
    m.error[2] = wrap_angle(m.error[2]);
    for (std::size_t i = 0; i < ids_.size(); ++i)
      m.error.segment<2>(belief_.offset(ids_[i])) = settings_.features[i] - belief_.mean(ids_[i]);
    return m;
  }

 private:
  bool at_truth() const { return settings_.linearized == Linearized::at_truth; }
  template <class T>
  T estimated(const T& estimate, const T& truth) const {
    return at_truth() ? truth : estimate;
  }
  Vector2d two_normals() {
    const double first = random_.normal();
    return {first, random_.normal()};
  }
  Vector3d three_normals() {
    const Vector2d two = two_normals();
    return {two[0], two[1], random_.normal()};
  }
  Pose pose() const { return belief_.mean(vehicle_); }
  planar::Step arc(const Pose& from, const Vector2d& input) const {
    return two_bearings::arc(from, input, settings_.dt_s);
  }

  /// By its first bearing, and a first distance that is drawn.
  void place(const Vector2d& feature) {
    const Vector2d sigmas(settings_.unknowns.sigma_distance_m, settings_.noise.sigma_bearing_rad);
    const Vector2d exact = RangeBearing::h<double>(truth_, feature);
    const Vector2d first = estimated(Vector2d(exact + sigmas.cwiseProduct(two_normals())), exact);
    const auto placed = RangeBearing::initialize(pose(), first);
    const BlockParent parent{vehicle_, placed.Jv};
    ids_.push_back(belief_.augment(RangeBearing::landmark_chart, placed.landmark, {&parent, 1},
                                   placed.Jz * sigmas.cwiseAbs2().asDiagonal() * placed.Jz.transpose()));
    first_features_.push_back(placed.landmark);
  }

  LinearizedMeasurement measured(const Vector2d& point, const Vector2d& estimate) {
    const double sigma = settings_.noise.sigma_bearing_rad;
    const double z = bearing_of(truth_, point) + sigma * random_.normal();
    LinearizedMeasurement m;
    m.residual = Bearing::Scalar(at_truth() ? 0 : wrap_angle(z - bearing_of(pose(), estimate)));
    m.R = Bearing::Scalar(sigma * sigma);
    return m;
  }

  void measure() {
    const bool first = settings_.linearized == Linearized::at_first_estimates;
    const Pose at = first ? first_pose_ : pose();
    std::vector<LinearizedMeasurement> all;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const Vector2d estimate = belief_.mean(ids_[i]);
      all.push_back(measured(settings_.features[i], estimate));
      const auto by = Bearing::predict_measurement(at, first ? first_features_[i] : estimate).value();
      all.back().add(vehicle_, by.Hv);
      all.back().add(ids_[i], by.Hl);
    }
    for (const Vector2d& anchor : settings_.anchors) {
      all.push_back(measured(anchor, anchor));
      all.back().add(vehicle_, Bearing::predict_measurement(at, anchor).value().Hv);
    }
    belief_.update(all);
  }

  const Drive& settings_;
  RandomStream random_;
  Pose truth_ = Pose::Zero(), first_pose_;
  Belief belief_;
  BlockId vehicle_ = 0;
  std::vector<BlockId> ids_;
  std::vector<Vector2d> first_features_;
};

}  // namespace

double Moment::nees() const {
  return error.dot(covariance.ldlt().solve(error)) / static_cast<double>(error.size());
}

std::vector<Moment> drive(const Drive& settings, const std::vector<double>& times_s, std::uint64_t seed) {
  MappingVehicle vehicle(settings, seed);
  std::vector<Moment> moments;
  long step = 0;
  for (const double t_s : times_s) {
    const long last = std::lround(t_s / settings.dt_s);
    for (; step < last; ++step)
      vehicle.step(settings.input((static_cast<double>(step) + 0.5) * settings.dt_s));
    moments.push_back(vehicle.now(t_s));
  }
  return moments;
}

VectorXd away(const Drive& settings, const Moment& at, int feature) {
  const Vector2d ahead =
      (settings.features[static_cast<std::size_t>(feature)] - at.pose.head<2>()).normalized();
  VectorXd c = VectorXd::Zero(at.error.size());
  c.head<2>() = -ahead;
  c.segment<2>(3 + 2 * feature) = ahead;
  return c;
}

}  // namespace incognita::bearing_drive
