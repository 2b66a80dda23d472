// (5.18) and (5.19) as an estimate, and what of a team and its map can be observed: Sections 5.2.1 and 5.3.
//
// Experiment: 200 random poses known to 0.5 m and 20 degrees, or to 0.05 m and half a degree, that measure
// three known landmarks with the noises of closed_loop_run.hpp; the least squares are found by Gauss and
// Newton, started from the truth and from (5.18), the better of the two. Ranks: measurements of all landmarks
// every 2 s along the true path of seed 1, of the regulator, round the circle, and of the team; singular
// values above 1e-9 of the largest count, with a gap of 1000 to the next.
#include "experiments/common.hpp"
#include "experiments/example_5_2.hpp"
#include "experiments/example_5_3.hpp"
#include "incognita/analysis/observability/linear_system.hpp"
#include "incognita/models/motion/planar_frame.hpp"
#include "incognita/models/sensors/range_bearing.hpp"

namespace incognita::section_5_3 {
namespace {

using namespace closed_loop;

/// A pose with a prior, and measurements of known landmarks.
struct Problem {
  Pose truth, prior;
  Matrix3d P;
  std::vector<Vector2d> landmarks, measurements;
};

Vector3d difference(const Pose& a, const Pose& b) {
  Vector3d d = a - b;
  d[2] = wrap_angle(d[2]);
  return d;
}

Problem some_problem(RandomStream& random, const Vector3d& sigmas) {
  Problem p;
  p.prior << random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-3, 3);
  p.P = sigmas.cwiseAbs2().asDiagonal();
  p.truth = p.prior;
  for (int i = 0; i < 3; ++i) p.truth[i] += sigmas[i] * random.normal();
  while (p.landmarks.size() < 3) {
    const Vector2d at(random.uniform(-10, 10), random.uniform(-10, 10));
    if ((at - p.truth.head<2>()).norm() < 2) continue;
    p.landmarks.push_back(at);
    Vector2d z = RangeBearing::h<double>(p.truth, at);
    for (int i = 0; i < 2; ++i) z[i] += measurement_sigmas[i] * random.normal();
    p.measurements.push_back(z);
  }
  return p;
}

/// All measurements, linearized at a pose.
struct Measurements {
  MatrixXd H = MatrixXd(6, 3);
  VectorXd residual = VectorXd(6);
};

Measurements measurements_at(const Problem& p, const Pose& pose) {
  Measurements out;
  for (Index l = 0; l < 3; ++l) {
    const auto i = static_cast<std::size_t>(l);
    const auto prediction = RangeBearing::predict_measurement(pose, p.landmarks[i]);
    out.H.middleRows(2 * l, 2) = prediction->Hv;
    out.residual[2 * l] = p.measurements[i][0] - prediction->z[0];
    out.residual[2 * l + 1] = wrap_angle(p.measurements[i][1] - prediction->z[1]);
  }
  return out;
}

MatrixXd measurement_noise() { return measurement_sigmas.cwiseAbs2().replicate(3, 1).asDiagonal(); }

/// What least squares minimize.
double squares(const Problem& p, const Pose& pose) {
  const Vector3d e = difference(pose, p.prior);
  const VectorXd r = measurements_at(p, pose).residual;
  return e.dot(p.P.inverse() * e) + r.dot(measurement_noise().inverse() * r);
}

Pose least_squares(const Problem& p, Pose pose) {
  const MatrixXd weight = measurement_noise().inverse();
  for (int i = 0; i < 50; ++i) {
    const Measurements at = measurements_at(p, pose);
    const Matrix3d A = p.P.inverse() + at.H.transpose() * weight * at.H;
    const Vector3d b = at.H.transpose() * weight * at.residual - p.P.inverse() * difference(pose, p.prior);
    pose += A.llt().solve(b);
  }
  return pose;
}

/// Largest and median excess of (5.18) over the least squares; largest relative difference of (5.19) from
/// (A.2.7).
struct Excess {
  double median = 0, largest = 0, covariance = 0;
};

Excess excess(const Vector3d& sigmas, int problems) {
  RandomStream random(1, "problems");
  std::vector<double> all;
  Excess out;
  for (int i = 0; i < problems; ++i) {
    const Problem p = some_problem(random, sigmas);
    const Measurements at = measurements_at(p, p.prior);
    const MatrixXd S = at.H * p.P * at.H.transpose() + measurement_noise(),
                   K = p.P * at.H.transpose() * S.inverse();
    const Pose ekf = p.prior + K * at.residual;
    const double best = std::min(squares(p, least_squares(p, p.truth)), squares(p, least_squares(p, ekf)));
    all.push_back(squares(p, ekf) - best);
    const Matrix3d rest = Matrix3d::Identity() - K * at.H, printed = p.P - K * S * K.transpose(),
                   joseph = rest * p.P * rest.transpose() + K * measurement_noise() * K.transpose();
    out.covariance = std::max(out.covariance, (printed - joseph).norm() / joseph.norm());
  }
  std::ranges::sort(all);
  out.median = all[all.size() / 2], out.largest = all.back();
  return out;
}

/// Largest relative difference of K times the residual from the least squares, of measurements that are linear in
/// the pose.
double excess_when_linear(int problems) {
  RandomStream random(2, "linear");
  double worst = 0;
  for (int i = 0; i < problems; ++i) {
    const MatrixXd H = MatrixXd::NullaryExpr(6, 3, [&] { return random.normal(); }), R = measurement_noise();
    const VectorXd residual = VectorXd::NullaryExpr(6, [&] { return random.normal(); });
    const Matrix3d P = start_sigmas.cwiseAbs2().asDiagonal();
    const Vector3d ekf = P * H.transpose() * (H * P * H.transpose() + R).inverse() * residual;
    const Vector3d best =
        (P.inverse() + H.transpose() * R.inverse() * H).llt().solve(H.transpose() * R.inverse() * residual);
    worst = std::max(worst, (ekf - best).norm() / best.norm());
  }
  return worst;
}

Claim optimal_estimate() {
  constexpr int problems = 200;
  const Excess vague = excess({0.5, 0.5, radians(20)}, problems), usual = excess(start_sigmas, problems);
  const double linear = excess_when_linear(problems);
  return assessed(
      "5.3-least-squares", "(5.18), (5.19)",
      "(5.18) is the optimal estimate in the sense of least squares: no other pose has a lower sum, to 1e-6; "
      "(5.19) is its covariance to first order, the same as (A.2.7), to 1e-9",
      {.measured =
           {"sum of squares in excess of the least, median and largest of {}: {:.2g} and {:.2g} from poses "
            "known to 0.5 m and 20 deg, {:.1e} and {:.1e} to 0.05 m and 0.5 deg; of linear measurements "
            "(5.18) differs from the least squares {}; (5.19) from (A.2.7) {}",
            problems, vague.median, vague.largest, usual.median, usual.largest, below(linear),
            below(std::max(vague.covariance, usual.covariance))},
       .number =
           exactly("sum of squares in excess of the least, from 0.5 m and 20 degrees, median", vague.median),
       .why = "if the measurements are linear. Of ranges and bearings it is the closer to optimal the less "
              "is unknown",
       .runs = problems},
      vague.largest <= 1e-6 && usual.largest <= 1e-6,
      on_condition(linear <= 1e-9 && vague.median > usual.median &&
                   std::max(vague.covariance, usual.covariance) <= 1e-9));
}

/// Directions of robots and map on which no measurement along the path depends. The first `anchors` landmarks
/// are known.
struct Unseen {
  int directions = 0;
  double gap = 0;
};

Unseen unseen(const Setup& setup, int anchors) {
  const Run run = drive(setup, 1);
  const auto robots = static_cast<Index>(setup.robots.size());
  const Index landmarks = static_cast<Index>(setup.place.size()) - anchors, n = 3 * robots + 2 * landmarks;
  std::vector<Eigen::RowVectorXd> rows;
  for (std::size_t k = 0; k < run.instants.size(); k += 20)
    for (Index r = 0; r < robots; ++r)
      for (const auto& [identity, point] : setup.place) {
        const auto i = static_cast<std::size_t>(r);
        const Pose &first = run.instants[0].robots[i].truth, &now = run.instants[k].robots[i].truth;
        const auto prediction = RangeBearing::predict_measurement(now, Vector2d(point));
        MatrixXd H = MatrixXd::Zero(2, n);
        H.middleCols<3>(3 * r) = prediction->Hv * planar::jacobian_between(first, now);
        if (identity >= anchors) H.middleCols<2>(3 * robots + 2 * (identity - anchors)) = prediction->Hl;
        rows.emplace_back(H.row(0)), rows.emplace_back(H.row(1));
      }
  MatrixXd M(static_cast<Index>(rows.size()), n);
  for (std::size_t i = 0; i < rows.size(); ++i) M.row(static_cast<Index>(i)) = rows[i];
  const Rank rank = rank_of(M, 1e-9);
  return {static_cast<int>(n) - rank.rank, rank.gap};
}

Claim observability() {
  const Setup to_goal{.robots = {robot({-7, 0, 0}, ControlLaw::lqg, PointPath{{10, 10, 0}})},
                      .duration_s = 80},
      round{.robots = {section_5_2::robot({-7, 0, pi}, section_5_2::circle)}, .duration_s = 80};
  Cases none_gained;
  bool all_with_two = true;
  int most = 0;
  for (const auto& [name, setup] : {std::pair("regulator", to_goal), std::pair("circle", round),
                                    std::pair("two robots", two_circles())}) {
    const Unseen free = unseen(setup, 0), two = unseen(setup, 2);
    all_with_two = all_with_two && two.directions == 0 && two.gap >= 1000;
    most = std::max(most, free.directions);
    none_gained.add(
        {fmt::format("{}: {}, with two known landmarks {}", name, free.directions, two.directions),
         free.directions == 3 && free.gap >= 1000});
  }
  return assessed(
      "5.3-observability", "Section 5.3; below (5.23)",
      "A low-level control law does not gain observability: along all these paths, of one robot and of two, "
      "position and heading of the whole stay unobservable, and two known landmarks make all observable",
      {.rule = Rule::dimension,
       .measured = "unobservable directions along the path: " + none_gained.text(),
       .number = exactly("unobservable directions along these paths", most)},
      none_gained.hold() && all_with_two);
}

}  // namespace

std::vector<Claim> estimation_claims() { return {optimal_estimate(), observability()}; }

}  // namespace incognita::section_5_3
