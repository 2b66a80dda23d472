#include "incognita/control/steering.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "incognita/control/car_linearization.hpp"
#include "incognita/control/feedback_linearization.hpp"
#include "incognita/control/lqg_regulator.hpp"
#include "incognita/control/planar_tracking.hpp"
#include "incognita/control/steering_validation.hpp"
#include "incognita/control/track_reference.hpp"
#include "incognita/messages/unfit_setting.hpp"
#include "incognita/models/motion/heading.hpp"
#include "incognita/models/motion/held_acceleration.hpp"

namespace incognita {
namespace {

SmallVector within(const SmallVector& input, const SmallVector& most) {
  return input.cwiseMax(-most).cwiseMin(most);
}

PlanarLimits planar_limits(const SteeringSettings& s) { return {s.most_input[0], s.most_input[1]}; }

/// The pose of a point ahead of the axle's center.
planar::Pose<double> point_before(const planar::Pose<double>& axle, double forward_m) {
  return {axle[0] + forward_m * std::cos(axle[2]), axle[1] + forward_m * std::sin(axle[2]), axle[2]};
}

planar::Pose<double> axle_of(const planar::Pose<double>& point, const DifferentialDrive& body) {
  const double c = std::cos(point[2]), s = std::sin(point[2]);
  return {point[0] - body.forward_m * c + body.left_m * s, point[1] - body.forward_m * s - body.left_m * c,
          point[2]};
}

struct LinearPlant {
  Eigen::MatrixXd F, G;
};

/// size x size; requires 1 or `size` numbers.
Eigen::MatrixXd diagonal(const std::vector<double>& numbers, Eigen::Index size) {
  if (numbers.size() == 1) return numbers[0] * Eigen::MatrixXd::Identity(size, size);
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), size).asDiagonal();
}

/// Gain L of (5.2).
Eigen::MatrixXd gain_of(const LinearPlant& plant, const SteeringSettings& s) {
  const auto n = plant.F.rows(), m = plant.G.cols();
  const SteadyGain gain =
      steady_gain(plant.F, plant.G, diagonal(s.weight_state, n), diagonal(s.weight_input, m));
  if (gain.outcome != RegulatorOutcome::converged) throw without_gain(gain.reason);
  return gain.L;
}

struct HeldInput final : Steering {
  SmallVector input;
  explicit HeldInput(SmallVector held) : input(std::move(held)) {}
  SmallVector act(const SmallVector&, double) const override { return input; }
};

/// On a line: the reference's speed plus a proportional term.
struct LineTracking final : Steering {
  SteeringSettings s;
  explicit LineTracking(const SteeringSettings& settings) : s(settings) {}
  SmallVector act(const SmallVector& x, double t) const override {
    const Reference r = at(s.path, t);
    const double desired = r.velocity.x() - s.gain_per_s[0] * (x[0] - r.position.x());
    return SmallVector::Constant(1, std::clamp(desired, -s.most_input[0], s.most_input[0]));
  }
};

/// (5.2) on a line, where zero speed holds every position.
struct LineRegulation final : Steering {
  SteeringSettings s;
  double L;
  LineRegulation(const SteeringSettings& settings, double period)
      : s(settings),
        L(gain_of({Eigen::MatrixXd::Identity(1, 1), period * Eigen::MatrixXd::Identity(1, 1)}, settings)(0)) {
  }
  SmallVector act(const SmallVector& x, double t) const override {
    return within(SmallVector::Constant(1, -L * (x[0] - at(s.path, t).position.x())), s.most_input);
  }
};

struct PlanarTracking final : Steering {
  SteeringSettings s;
  DifferentialDrive body;
  PlanarTracking(const SteeringSettings& settings, const DifferentialDrive& b) : s(settings), body(b) {}
  SmallVector act(const SmallVector& x, double t) const override {
    const TrackingGains gains{s.gain_along_per_s, s.gain_across_per_m2, s.gain_heading_per_m};
    return track(axle_of(planar::Pose<double>(x), body), at(s.path, t), gains, planar_limits(s)).input();
  }
};

struct DriveLinearization final : Steering {
  SteeringSettings s;
  FeedbackLinearization law;
  bool on_ground;  // the state is the axle's center, and the control point lies ahead of it
  DriveLinearization(const SteeringSettings& settings, const DifferentialDrive& body, double period,
                     bool ground)
      : s(settings),
        law({body, diagonal(settings.gain_per_s, 2), period, planar_limits(settings)}),
        on_ground(ground) {}
  SmallVector act(const SmallVector& x, double t) const override {
    const planar::Pose<double> pose = x;
    return law.act(on_ground ? point_before(pose, s.control_point_m) : pose, at(s.path, t)).input();
  }
};

struct CarSteering final : Steering {
  SteeringSettings s;
  AckermannCar car;
  CarLinearization law;
  CarSteering(const SteeringSettings& settings, const AckermannCar& c, double period)
      : s(settings),
        car(c),
        law({c, diagonal(settings.gain_per_s, 2), period, {settings.most_input[0], settings.most_input[1]}}) {
  }
  SmallVector act(const SmallVector& x, double t) const override {
    // The limit applies to the measured wheel, which is faster than the axle on the outside of a turn;
    // clamped, the car still follows the same arc
    return within(wheel_input(car, law.act(planar::Pose<double>(x), at(s.path, t))), s.most_input);
  }
};

struct DriveRegulation final : Steering {
  SteeringSettings s;
  PlanarRegulator law;
  DriveRegulation(const SteeringSettings& settings, const DifferentialDrive& body, double period)
      : s(settings),
        law({body, diagonal(settings.weight_state, 2), diagonal(settings.weight_input, 2), period,
             planar_limits(settings)}) {}
  SmallVector act(const SmallVector& x, double t) const override {
    return law.act(planar::Pose<double>(x), at(s.path, t).position.head<2>()).command.input();
  }
};

/// (5.29), with the path's heading as the gaze.
struct BodyLinearization final : Steering {
  SteeringSettings s;
  explicit BodyLinearization(const SteeringSettings& settings) : s(settings) {}
  SmallVector act(const SmallVector& x, double t) const override {
    const Reference r = at(s.path, t);
    // A left turn about z is a turn about -y of a level camera
    const Eigen::Vector3d rate(0, -r.heading_rate, 0), faster(0, -r.heading_acceleration, 0);
    return within(track_reference(x, r.position, r.velocity, r.acceleration, level_gaze(r.heading), rate,
                                  s.camera, faster),
                  s.most_input);
  }
};

/// (5.2) about a pose at rest: errors in the chart of the state, F and G of the motion model at rest with
/// accelerations held over the period, as in plant and filter.
struct BodyRegulation final : Steering {
  FreeCameraMotion::State<double> goal;
  Eigen::MatrixXd L;
  SmallVector most;
  BodyRegulation(const SteeringSettings& s, double period) : most(s.most_input) {
    const Reference r = at(s.path, 0);
    goal << r.position, level_gaze(r.heading), Eigen::Matrix<double, 6, 1>::Zero();
    const auto step = HeldAcceleration().step(goal, FreeCameraMotion::Input<double>::Zero(), period);
    L = gain_of({step.F, step.G}, s);
  }
  SmallVector act(const SmallVector& x, double) const override {
    SmallVector error(FreeCameraMotion::error_size);
    FreeCameraMotion::chart.minus({x.data(), 13}, {goal.data(), 13}, {error.data(), 12});
    return within(-L * error, most);
  }
};

/// Applies the law of a simpler vehicle, whose state is the leading part of this one's.
struct SteeredAs final : Steering {
  std::unique_ptr<Steering> law;
  int size;
  SteeredAs(std::unique_ptr<Steering> of_simpler, int numbers) : law(std::move(of_simpler)), size(numbers) {}
  SmallVector act(const SmallVector& x, double t) const override { return law->act(x.head(size), t); }
};

/// The laws of each motion.
struct SteeringFactory {
  const SteeringSettings& s;
  double period;

  std::unique_ptr<Steering> operator()(const MonobotMotion&) const {
    switch (s.law) {
      case ControlLaw::lqg:
        return std::make_unique<LineRegulation>(s, period);
      case ControlLaw::tracking:
      case ControlLaw::feedback_linearization:
        return std::make_unique<LineTracking>(s);
      case ControlLaw::none:
      case ControlLaw::active:
        break;
    }
    return none();
  }
  std::unique_ptr<Steering> operator()(const DifferentialDrive& body) const {
    switch (s.law) {
      case ControlLaw::lqg:
        return std::make_unique<DriveRegulation>(s, body, period);
      case ControlLaw::tracking:
        return std::make_unique<PlanarTracking>(s, body);
      case ControlLaw::feedback_linearization:
        return std::make_unique<DriveLinearization>(s, body, period, false);
      case ControlLaw::none:
      case ControlLaw::active:
        break;
    }
    return none();
  }
  std::unique_ptr<Steering> operator()(const AckermannCar& car) const {
    switch (s.law) {
      case ControlLaw::feedback_linearization:
        return std::make_unique<CarSteering>(s, car, period);
      case ControlLaw::none:
      case ControlLaw::tracking:
      case ControlLaw::lqg:
      case ControlLaw::active:
        break;
    }
    return none();
  }
  std::unique_ptr<Steering> operator()(const TerrainVehicle&) const {
    switch (s.law) {
      case ControlLaw::tracking:
        return std::make_unique<PlanarTracking>(s, DifferentialDrive{0, 0});
      case ControlLaw::feedback_linearization:
        return std::make_unique<DriveLinearization>(s, DifferentialDrive{s.control_point_m, 0}, period, true);
      case ControlLaw::none:
      case ControlLaw::lqg:
      case ControlLaw::active:
        break;
    }
    return none();
  }
  std::unique_ptr<Steering> operator()(const FreeCameraMotion&) const {
    switch (s.law) {
      case ControlLaw::lqg:
        return std::make_unique<BodyRegulation>(s, period);
      case ControlLaw::tracking:
      case ControlLaw::feedback_linearization:
        return std::make_unique<BodyLinearization>(s);
      case ControlLaw::none:
      case ControlLaw::active:
        break;
    }
    return none();
  }
  /// check_steering() gives the reason before.
  [[noreturn]] static std::unique_ptr<Steering> none() {
    throw std::logic_error("a law that does not steer the motion");
  }
  template <class Model>
  std::unique_ptr<Steering> operator()(const Model& model) const {
    if constexpr (requires { model.steered_as(); }) {
      const auto simpler = model.steered_as();
      return std::make_unique<SteeredAs>((*this)(simpler), simpler.state_size);
    }
    throw std::logic_error("a motion that no law steers");
  }
};

}  // namespace

ControlLaw law_of(const AnyMotion& motion, ControlLaw law) {
  if (law != ControlLaw::active) return law;
  return traits_of(motion).on_line() ? ControlLaw::tracking : ControlLaw::feedback_linearization;
}

std::unique_ptr<Steering> make_steering(const AnyMotion& motion, const SteeringSettings& settings,
                                        double period_s) {
  SteeringSettings s = settings;
  s.law = law_of(motion, settings.law);
  try {
    check_steering(motion, s, period_s);
    if (s.law == ControlLaw::none) return std::make_unique<HeldInput>(s.input);
    return std::visit(SteeringFactory{s, period_s}, motion);
  } catch (UnfitSetting& unfit) {
    unfit.keys.emplace_back("controller.law");  // another law may fit
    throw;
  }
}

}  // namespace incognita
