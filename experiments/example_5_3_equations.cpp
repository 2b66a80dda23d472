// (5.18) to (5.23): the filter of a team, its control law, and the closed loop.
//
// Experiment: the two robots of Example 5.3. The law without noise and the state known, along exact arcs, for
// two rounds; the filter beside (5.18) and (5.19) written out, 30 s of seed 1; the linearized team, 6 states
// of the robots and 32 of the landmarks, all of which both see, at the last instant of seed 1: the plant at
// the truth, the filter at the truth or at its estimate. Holds: identities to 1e-9, eigenvalues to 1e-6.
#include "experiments/common.hpp"
#include "experiments/example_5_1.hpp"
#include "experiments/example_5_2.hpp"
#include "experiments/example_5_3.hpp"
#include "incognita/analysis/observability/closed_loop.hpp"
#include "incognita/control/feedback_linearization.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita::section_5_3 {
namespace {

using namespace closed_loop;

constexpr double as_good_as_zero = 1e-9;
const Matrix2d K = section_5_2::gain_per_s * Matrix2d::Identity();

/// Mean distance of both robots from where they should be, in the second round, with u = Q_r^-1 (ydot* + sign
/// K (y* - y)).
double mean_error_m(double sign) {
  std::vector<double> errors;
  for (const Robot& robot : two_circles().robots) {
    const Path& path = robot.steering.path;
    const Law law = [&](const Pose& pose, double t) {
      return input_for_velocity(body, pose[2], velocity_towards(at(path, t), sign * K, pose.head<2>()));
    };
    std::ranges::copy(steer(law, robot.start, two_rounds_s).distances_m(path, second_round),
                      std::back_inserter(errors));
  }
  return mean_of(errors).value;
}

Claim law() {
  const Worst worst{mean_error_m(-1), mean_error_m(1)};
  return assessed("5.3-law", "(5.21)",
                  "The control law takes each robot to its path: within 1 cm in the second round",
                  {.printed = "u = Q_r^-1 (y*_(k+1) - Q2 (y* - y))",
                   .measured = {"mean error of the second round, y*_(k+1) taken as the path's velocity: "
                                "printed {:.1f} m, ours {:.1e} m",
                                worst.printed, worst.ours},
                   .number = exactly("mean error of the second round by (5.21)", worst.printed, "m"),
                   .why = "the error has the other sign, y - y*: as printed it drives away from the path"},
                  worst, 0.01);
}

Claim closed_loop_equation() {
  RandomStream random(1, "steps");
  constexpr int places = 200;
  Worst worst;
  for (int i = 0; i < places; ++i) {
    const Pose pose(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-3, 3));
    const Path circle = section_5_2::circle;
    const double t = random.uniform(0, 72);
    const Reference now = at(circle, t);
    const Vector2d v(0.1 * random.normal(), 0.1 * random.normal()), y = pose.head<2>();
    const Vector2d u = input_for_velocity(body, pose[2], velocity_towards(now, K, y));
    const Matrix2d Q_r = point_velocity_by_input(body, pose[2]);
    const Vector2d next = body.f<double>(pose, u + v, period_s).head<2>();  // (3.16)
    const Vector2d ahead = at(circle, t + period_s).position.head<2>(), error = y - now.position.head<2>();
    const Vector2d velocity = now.velocity.head<2>() - K * error + Q_r * v;
    worst.take((ahead - K * error + Q_r * v - next).norm(), (y + period_s * velocity - next).norm());
  }
  return assessed("5.3-closed-loop", "(5.20), (5.22)",
                  "Motion of a robot under the law with plant noise v: against (3.16), to 1e-9 m",
                  {.printed = "y_(k+1) = y*_(k+1) - Q2 (y_k - y*_k) + Q_r v_k",
                   .measured = {"largest difference at {} poses: printed {:.2f} m, ours, in m, {}", places,
                                worst.printed, below(worst.ours)},
                   .number = exactly("largest difference of (5.22)", worst.printed, "m"),
                   .why = "y_(k+1) = y_k + dt (ydot* - Q2 (y_k - y*_k) + Q_r v_k), as (5.20) is the velocity "
                          "and not the next position; y in Q2 (y - y*) is the estimate",
                   .runs = places},
                  worst, as_good_as_zero);
}

Claim error_recursion() {
  RandomStream random(2, "loops");
  constexpr int loops = 100;
  Worst worst;
  for (int i = 0; i < loops; ++i) {
    const LinearSystem s = section_5_1::some_system(random);
    const Index n = s.F.rows();
    const MatrixXd gain = 0.3 * section_5_1::some_matrix(random, n, s.H.rows()), A = s.F - gain * s.H * s.F;
    const auto some_vector = [&](Index size) { return section_5_1::some_matrix(random, size, 1); };
    const VectorXd x = some_vector(n), x_hat = some_vector(n), u = some_vector(s.G.cols()),
                   v = some_vector(s.G.cols()), w = some_vector(s.H.rows());
    const VectorXd x_next = s.F * x + s.G * (u + v), expected = s.F * x_hat + s.G * u,
                   x_hat_next = expected + gain * (s.H * x_next + w - s.H * expected);
    const VectorXd noise = (s.G - gain * s.H * s.G) * v - gain * w;
    const VectorXd error_next = x_next - x_hat_next;
    worst.take((A * x_hat + noise - x_hat_next).norm() / x_hat_next.norm(),
               (A * (x - x_hat) + noise - error_next).norm() / error_next.norm());
  }
  return assessed("5.3-error", "(5.23)",
                  "(F - K H F) x + (G - K H G) v - K w is how the estimate moves on, to 1e-9",
                  {.printed = "x_(k+1|k+1), x_(k|k)",
                   .measured = {"largest relative difference of {} random linear systems: of the estimate "
                                "{:.1f}, of its error {}",
                                loops, worst.printed, below(worst.ours)},
                   .number = exactly("largest relative difference of (5.23)", worst.printed),
                   .why = "of the error of the estimate, with the noise of the measurement after the step; "
                          "the text above it says error, too",
                   .runs = loops},
                  worst, as_good_as_zero);
}

/// Of (2.14), whose Q is that of (2.1): of the noise on the inputs.
Claim prediction() {
  RandomStream random(3, "predictions");
  constexpr int places = 20, draws = 20000;
  const Matrix2d Q = input_sigmas.cwiseAbs2().asDiagonal();
  bool can_be_added = true;
  double off = 0;
  for (int i = 0; i < places; ++i) {
    const Pose pose(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-3, 3));
    const Vector2d u(random.uniform(-1, 1), random.uniform(-1, 1));
    const planar::Step step = body.step(pose, u, period_s);
    Matrix3d drawn = Matrix3d::Zero();
    for (int k = 0; k < draws; ++k) {
      const Vector2d v = input_sigmas.cwiseProduct(Vector2d(random.normal(), random.normal()));
      Vector3d by_noise = body.f<double>(pose, u + v, period_s) - step.x;
      by_noise[2] = wrap_angle(by_noise[2]);
      drawn += by_noise * by_noise.transpose() / draws;
    }
    const Matrix3d ours = step.G * Q * step.G.transpose();
    off = std::max(off, (drawn - ours).norm() / ours.norm());
    can_be_added = can_be_added && Q.rows() == step.F.rows();
  }
  return assessed(
      "5.3-prediction", "(2.14), beside (5.19)",
      "F P F' + Q is the covariance of the predicted state, with Q the covariance of the noise v of "
      "(2.1), which has as many components as the input",
      {.rule = Rule::example,
       .printed = "P_(k+1|k) = F P_(k|k) F' + Q_k",
       .measured = {"of one robot F P F' is 3x3 and Q 2x2: the sum does not exist. What the noise "
                    "adds, by {} draws at each of {} poses, differs from G Q G' by {:.1f} % at "
                    "most",
                    draws, places, 100 * off},
       .number = exactly("covariance by draws against G Q G', largest difference", 100 * off, "%"),
       .why = "F P F' + G Q G', as in (5.19): the noise of the input enters through G. As printed "
              "it is right of noise that is added to the state, as in (A.1.1)"},
      can_be_added, as_corrected(off < 0.05));
}

/// Poses of the robots and positions of the landmarks: where a team is linearized.
struct Point {
  std::vector<Pose> poses;
  std::vector<Vector2d> inputs;
  std::vector<Vector2d> landmarks;
};

ControlledSystem linearized(const Point& at) {
  const auto robots = static_cast<Index>(at.poses.size()),
             landmarks = static_cast<Index>(at.landmarks.size());
  const Index n = 3 * robots + 2 * landmarks;
  ControlledSystem s{MatrixXd::Identity(n, n), MatrixXd::Zero(n, 2 * robots),
                     MatrixXd::Zero(2 * robots * landmarks, n)};
  for (Index r = 0; r < robots; ++r) {
    const auto i = static_cast<std::size_t>(r);
    const planar::Step step = body.step(at.poses[i], at.inputs[i], period_s);
    s.F.block<3, 3>(3 * r, 3 * r) = step.F;
    s.G.block<3, 2>(3 * r, 2 * r) = step.G;
    for (Index l = 0; l < landmarks; ++l) {
      const auto prediction =
          RangeBearing::predict_measurement(at.poses[i], at.landmarks[static_cast<std::size_t>(l)]);
      const Index row = 2 * (r * landmarks + l);
      s.H.block<2, 3>(row, 3 * r) = prediction->Hv;
      s.H.block<2, 2>(row, 3 * robots + 2 * l) = prediction->Hl;
    }
  }
  return s;
}

/// L of the team: each robot's Q_r^-1 Q2 on its own position.
MatrixXd gain_of(const Point& at, Index states) {
  MatrixXd L = MatrixXd::Zero(2 * static_cast<Index>(at.poses.size()), states);
  for (std::size_t i = 0; i < at.poses.size(); ++i) {
    const auto r = static_cast<Index>(i);
    L.block<2, 2>(2 * r, 3 * r) = section_5_2::gain(at.poses[i]);
  }
  return L;
}

/// A block for each robot.
template <class Block>
MatrixXd block_diagonal(const Point& at, const Block& of) {
  const auto robots = static_cast<Index>(at.poses.size());
  MatrixXd M = MatrixXd::Zero(2 * robots, 2 * robots);
  for (Index r = 0; r < robots; ++r) M.block<2, 2>(2 * r, 2 * r) = of(at.poses[static_cast<std::size_t>(r)]);
  return M;
}

/// Kalman's, for a covariance of the sizes that the runs have.
MatrixXd kalman(const ControlledSystem& s) {
  const MatrixXd P = 0.01 * MatrixXd::Identity(s.F.rows(), s.F.rows());
  MatrixXd S = s.H * P * s.H.transpose();
  for (Index i = 0; i < S.rows(); ++i) S(i, i) += std::pow(i % 2 == 0 ? 0.1 : radians(1), 2);
  return S.llt().solve(s.H * P).transpose();
}

std::vector<Claim> separable() {
  const Run run = drive(two_circles(), 1);
  Point truth, belief;
  for (const RobotInstant& r : run.instants.back().robots) {
    truth.poses.push_back(r.truth), truth.inputs.push_back(r.input);
    belief.poses.push_back(r.mean), belief.inputs.push_back(r.input);
  }
  for (const MappedLandmark& l : run.map)
    truth.landmarks.push_back(l.truth), belief.landmarks.push_back(l.mean);
  const ControlledSystem plant = linearized(truth), filter = linearized(belief);
  const MatrixXd L = gain_of(belief, plant.F.rows()), gain = kalman(filter);
  const Separation same = separation(filter, filter, L, gain), apart = separation(plant, filter, L, gain);

  const MatrixXd Q_r = block_diagonal(
      belief, [](const Pose& pose) -> Matrix2d { return point_velocity_by_input(body, pose[2]); });
  const MatrixXd positions = block_diagonal(belief, [](const Pose& pose) -> Matrix2d {
    return Matrix2d::Identity() - period_s * point_velocity_by_input(body, pose[2]) * section_5_2::gain(pose);
  });
  const auto in_loop = [&](const MatrixXd& part) {
    double farthest = 0;
    for (const std::complex<double>& value : stability_of(part).eigenvalues)
      farthest = std::max(farthest, (same.whole.eigenvalues.array() - value).abs().minCoeff());
    return farthest;
  };
  const double of_Q_r = in_loop(Q_r), of_control = in_loop(positions.topLeftCorner<2, 2>());
  return {
      assessed(
          "5.3-separable", "below (5.23)",
          "Estimation and control of the team are separable: the eigenvalues of the closed loop, linearized, "
          "are those of F - G L together with those of F - K H F, to 1e-6, the filter at its estimate",
          {.measured = {"{} states of plant and filter: distance of the eigenvalues {} where the filter is "
                        "linearized where the plant is, {:.1e} where it is linearized at its estimate; "
                        "coupling of the state into the error: {} and {:.1e} of the whole",
                        same.whole.eigenvalues.size(), below(same.spectral_distance), apart.spectral_distance,
                        below(same.coupling), apart.coupling},
           .number = exactly("coupling of the state into the error, of the whole", apart.coupling),
           .why = "where the Jacobians of the filter are those of the plant; taken at the estimate they are "
                  "not quite"},
          apart.holds && apart.coupling <= as_good_as_zero,
          on_condition(same.holds && same.coupling <= as_good_as_zero)),
      assessed("5.3-eigenvalues", "below (5.23)",
               "The eigenvalues of the feedback dynamics are among those of the closed loop, to 1e-6",
               {.printed = "those of Q_r(y_k)",
                .measured = {"farthest from any eigenvalue of the loop: of Q_r {:.3f}, of I - Q2 dt {}; "
                             "|eigenvalues| of Q_r {:.3f}, whatever Q2 is",
                             of_Q_r, below(of_control), stability_of(Q_r).spectral_radius},
                .number = exactly("distance of an eigenvalue of Q_r from those of the loop, at most", of_Q_r),
                .why = "those of I - Q2 dt are, for the positions. Q_r is how inputs move the control point, "
                       "and its eigenvalues are not those of the feedback"},
               of_Q_r <= 1e-6, in_truth(of_control <= 1e-6))};
}

}  // namespace

std::vector<Claim> equation_claims() {
  return concatenated({prediction(), law(), closed_loop_equation(), error_recursion(), separable()});
}

}  // namespace incognita::section_5_3
