// (5.1) to (5.4) for linear systems, before Example 5.1.
//
// Experiment: 100 random systems of two to four states, one or two inputs and measurements, F = 0.6 M + 0.4 I
// with normal M, weights and noises random and definite; expected costs are propagated exactly, nothing is
// drawn beyond the systems. Holds: differences to 1e-8 of what is compared; of costs, that each of ten other
// sets of gains costs more.
#include "experiments/chapter_5_vehicle.hpp"
#include "experiments/common.hpp"
#include "experiments/example_5_1.hpp"
#include "incognita/analysis/observability/closed_loop.hpp"
#include "incognita/control/feedback_linearization.hpp"
#include "incognita/control/lqr.hpp"
#include "incognita/models/motion/monobot.hpp"

namespace incognita::section_5_1 {

MatrixXd some_matrix(RandomStream& random, Index rows, Index columns) {
  return MatrixXd::NullaryExpr(rows, columns, [&] { return random.normal(); });
}

MatrixXd some_weight(RandomStream& random, Index size) {
  const MatrixXd root = some_matrix(random, size, size);
  return root * root.transpose() + 0.1 * MatrixXd::Identity(size, size);
}

LinearSystem some_system(RandomStream& random) {
  const Index n = 2 + random.below(3), m = 1 + random.below(2), p = 1 + random.below(2);
  LinearSystem s;
  s.F = 0.6 * some_matrix(random, n, n) + 0.4 * MatrixXd::Identity(n, n);
  s.G = some_matrix(random, n, m);
  s.H = some_matrix(random, p, n);
  s.Q = some_weight(random, m);
  s.R = some_weight(random, p);
  return s;
}

namespace {

constexpr int systems = 100, steps = 10;
constexpr double as_good_as_equal = 1e-8;
constexpr double dt = 0.1;  // s, on a line

/// A horizon of ten steps that begins with an estimate and its covariance; no cost at the end, as (5.1) has
/// it.
struct Task {
  LinearSystem system;
  MatrixXd Q1, Q2, P0;
  VectorXd estimate;
  std::vector<MatrixXd> L;     ///< (5.3)
  std::vector<MatrixXd> T;     ///< (5.4), T_0 first, one more than steps
  std::vector<MatrixXd> K, P;  ///< Kalman's, and the covariance after each update, P_0 first
};

Task some_task(RandomStream& random) {
  Task t;
  t.system = some_system(random);
  const LinearSystem& s = t.system;
  const Index n = s.F.rows();
  t.Q1 = some_weight(random, n), t.Q2 = some_weight(random, s.G.cols()), t.P0 = some_weight(random, n);
  t.estimate = 3 * some_matrix(random, n, 1);
  const MatrixXd free_end = MatrixXd::Zero(n, n);
  for (int k = 0; k < steps; ++k)
    t.T.push_back(finite_horizon_gains(s.F, s.G, t.Q1, t.Q2, free_end, steps - k).T0);
  t.T.push_back(free_end);
  t.L = finite_horizon_gains(s.F, s.G, t.Q1, t.Q2, free_end, steps).L;
  t.P = {t.P0};
  for (int k = 0; k < steps; ++k) {
    const MatrixXd prior = predicted(s, t.P.back());
    t.K.push_back(kalman_gain(s, prior));
    t.P.push_back(updated(s, prior, t.K.back()));
  }
  return t;
}

struct Cost {
  double whole = 0;     ///< (5.1)
  double estimate = 0;  ///< the same sum of the estimate and the inputs
  double error = 0;     ///< E[e' Q1 e], summed
};

/// (5.1) as it is expected, from the second moments of state and error, which (5.5) moves on.
Cost expected_cost(const Task& t, const std::vector<MatrixXd>& L, const std::vector<MatrixXd>& K) {
  const LinearSystem& s = t.system;
  const ControlledSystem controlled{s.F, s.G, s.H};
  const Index n = s.F.rows(), noises = s.Q.rows() + s.R.rows();
  MatrixXd W = MatrixXd::Zero(noises, noises), S(2 * n, 2 * n), to_estimate(n, 2 * n);
  W.topLeftCorner(s.Q.rows(), s.Q.rows()) = s.Q;
  W.bottomRightCorner(s.R.rows(), s.R.rows()) = s.R;
  to_estimate << MatrixXd::Identity(n, n), -MatrixXd::Identity(n, n);
  S << t.P0 + t.estimate * t.estimate.transpose(), t.P0, t.P0, t.P0;
  Cost cost;
  for (std::size_t k = 0; k < L.size(); ++k) {
    const MatrixXd estimated = to_estimate * S * to_estimate.transpose();
    const double input = (L[k].transpose() * t.Q2 * L[k] * estimated).trace();
    cost.whole += (t.Q1 * S.topLeftCorner(n, n)).trace() + input;
    cost.estimate += (t.Q1 * estimated).trace() + input;
    cost.error += (t.Q1 * S.bottomRightCorner(n, n)).trace();
    const MatrixXd A = closed_loop_matrix(controlled, L[k], K[k]), B = closed_loop_noise(controlled, K[k]);
    S = A * S * A.transpose() + B * W * B.transpose();
  }
  return cost;
}

double relative(double a, double b) { return std::abs(a - b) / std::max(std::abs(a), std::abs(b)); }
double relative(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).norm() / std::max(a.norm(), b.norm());
}

Claim duality() {
  RandomStream random(1, "duality");
  double worst = 0;
  int settled = 0;
  for (int i = 0; i < systems; ++i) {
    const LinearSystem s = some_system(random);
    const RiccatiLimit filter = iterate_riccati(s, MatrixXd::Identity(s.F.rows(), s.F.rows()));
    const SteadyGain dual = steady_gain(s.F.transpose(), s.H.transpose(), s.G * s.Q * s.G.transpose(), s.R);
    if (!filter.settled || dual.outcome != RegulatorOutcome::converged) continue;
    ++settled;
    worst = std::max({worst, relative(dual.T, filter.P), relative(dual.L.transpose(), s.F * filter.K)});
  }
  return assessed(
      "5.1-duality", "Chapter 5, introduction; Section 5.1",
      "LQG regulation is the dual of the Kalman filter: (5.3) and (5.4) for F', H', G Q G' and R give the "
      "filter's covariance and F K, to 1e-8",
      {.measured = {"largest relative difference of {} systems that settle: {}", settled, below(worst)},
       .runs = systems},
      settled >= systems / 2 && worst <= as_good_as_equal);
}

std::vector<MatrixXd> disturbed(RandomStream& random, std::vector<MatrixXd> gains) {
  for (MatrixXd& gain : gains) gain += 0.05 * some_matrix(random, gain.rows(), gain.cols());
  return gains;
}

Claim optimal() {
  RandomStream random(2, "tasks");
  constexpr int others = 10;
  double worst = 0, least_by_L = 1e300, least_by_K = 1e300;
  for (int i = 0; i < systems; ++i) {
    const Task t = some_task(random);
    const Cost cost = expected_cost(t, t.L, t.K);
    double value = (t.T[0] * (t.P0 + t.estimate * t.estimate.transpose())).trace();
    for (std::size_t k = 0; k < t.L.size(); ++k) {
      const MatrixXd weight = t.Q2 + t.system.G.transpose() * t.T[k + 1] * t.system.G;
      value += (t.T[k + 1] * t.system.G * t.system.Q * t.system.G.transpose()).trace() +
               (t.L[k].transpose() * weight * t.L[k] * t.P[k]).trace();
    }
    worst = std::max(worst, relative(value, cost.whole));
    for (int k = 0; k < others; ++k) {
      least_by_L = std::min(least_by_L, expected_cost(t, disturbed(random, t.L), t.K).whole / cost.whole);
      least_by_K = std::min(least_by_K, expected_cost(t, t.L, disturbed(random, t.K)).whole / cost.whole);
    }
  }
  return assessed("5.1-optimal", "Section 5.1, (5.1)-(5.3)",
                  "For a linear system with Gaussian noises and a quadratic cost the optimal solution is the "
                  "LQG: its cost is that of (5.4) (to 1e-8), and other gains cost more",
                  {.measured = {"largest relative difference of the cost from Riccati's {}; {} other gains "
                                "each: of the regulator from {:.6f} times as much, of the filter from {:.6f}",
                                below(worst), others, least_by_L, least_by_K},
                   .number = exactly("cost with other gains over that of the LQG, at least",
                                     std::min(least_by_L, least_by_K)),
                   .runs = systems},
                  worst <= as_good_as_equal && least_by_L > 1 && least_by_K > 1);
}

Claim decomposition() {
  RandomStream random(3, "tasks");
  double with_kalman = 0, by_control = 0, with_another = 0;
  for (int i = 0; i < systems; ++i) {
    const Task t = some_task(random);
    const Cost cost = expected_cost(t, t.L, t.K), lazy = expected_cost(t, disturbed(random, t.L), t.K),
               other = expected_cost(t, t.L, disturbed(random, t.K));
    with_kalman = std::max(with_kalman, relative(cost.whole, cost.estimate + cost.error));
    by_control = std::max(by_control, relative(cost.error, lazy.error));
    with_another = std::max(with_another, relative(other.whole, other.estimate + other.error));
  }
  return assessed(
      "5.1-decomposition", "below (5.1)",
      "(5.1) falls into a term of the estimate and the input and one of the estimation error, which does not "
      "depend on the input; to 1e-8",
      {.measured =
           {"largest relative difference of the sum of the two {}, of the error's term with another control "
            "{}; with another gain of the filter than Kalman's the sum is off by up to {:.0f} %",
            below(with_kalman), below(by_control), 100 * with_another},
       .runs = systems},
      with_kalman <= as_good_as_equal && by_control <= as_good_as_equal);
}

/// x' T x of the trajectory without noise, under gains that may change.
double cost_without_noise(const Task& t, const std::vector<MatrixXd>& L) {
  VectorXd x = t.estimate;
  double cost = 0;
  for (const MatrixXd& gain : L) {
    const VectorXd u = -gain * x;
    cost += x.dot(t.Q1 * x) + u.dot(t.Q2 * u);
    x = t.system.F * x + t.system.G * u;
  }
  return cost;
}

Claim index_of_T() {
  RandomStream random(4, "tasks");
  double worst = 0, least = 1e300, most = 0;
  int compared = 0;
  for (int i = 0; i < systems; ++i) {
    const Task t = some_task(random);
    const SteadyGain same = steady_gain(t.system.F, t.system.G, t.Q1, t.Q2);
    if (same.outcome != RegulatorOutcome::converged) continue;
    ++compared;
    const double best = t.estimate.dot(t.T[0] * t.estimate);
    worst = std::max(worst, relative(best, cost_without_noise(t, t.L)));
    const double ratio = cost_without_noise(t, std::vector<MatrixXd>(steps, same.L)) / best;
    least = std::min(least, ratio), most = std::max(most, ratio);
  }
  return assessed(
      "5.1-index", "(5.3), (5.4)",
      "The gains of (5.3) with (5.4) have the least cost (5.1): no more than the least, to 1e-8",
      {.printed = "L_k = (Q2 + G_k' T_k G_k)^-1 G_k' T_k F_k; T_k = Q1 + L_k' Q2 L_k + (F_k - G_k L_k)' T_k "
                  "(F_k - G_k L_k)",
       .measured = {"over {} steps, {} systems: the same T on both sides costs {:.4f} to {:.3g} times as "
                    "much; with T_(k+1) on the right x_0' T_0 x_0 is the cost, to a relative difference {}",
                    steps, compared, least, most, below(worst)},
       .number = exactly("cost with the same T on both sides over the least, at most", most),
       .why = "T_(k+1) on the right of both: the recursion runs back from the end. The same T on both sides "
              "is where it settles over an infinite horizon",
       .runs = compared},
      most <= 1 + as_good_as_equal, as_corrected(worst <= as_good_as_equal && least >= 1 - as_good_as_equal));
}

Claim to_zero() {
  RandomStream random(5, "tasks");
  double left = 0;
  int regulated = 0;
  for (int i = 0; i < systems; ++i) {
    const Task t = some_task(random);
    const SteadyGain gain = steady_gain(t.system.F, t.system.G, t.Q1, t.Q2);
    if (gain.outcome != RegulatorOutcome::converged) continue;
    ++regulated;
    VectorXd x = t.estimate;
    for (int k = 0; k < 1000; ++k) x = (t.system.F - t.system.G * gain.L) * x;
    left = std::max(left, x.norm() / t.estimate.norm());
  }
  const MatrixXd one = MatrixXd::Identity(1, 1);
  const SteadyGain free = steady_gain(one, dt * one, 0 * one, one);
  const SteadyGain line = steady_gain(one, dt * one, one, one);
  const double a = 1 - dt * line.L(0, 0), sigma_v = 0.1;
  const double var = std::pow(dt * sigma_v, 2) / (1 - a * a);  // of x+ = a x + dt v
  return assessed(
      "5.1-to-zero", "below (5.1)",
      "With Q1 and Q2 positive semi-definite the minimization drives the state to zero",
      {.rule = Rule::example,
       .measured = {"Q1 = 0 on a line, which is psd: {}; Q1 definite, no noise: of {} systems "
                    "the most that is left after 1000 steps {}; on a line disturbed by 0.1 m/s "
                    "at 10 Hz, Q1 = Q2 = 1: {:.1f} mm rms for ever",
                    sentence(free.outcome), regulated, below(left), 1000 * std::sqrt(var)},
       .number = exactly("rms that stays of a line disturbed by 0.1 m/s", 1000 * std::sqrt(var), "mm"),
       .why = "without noise, and if each mode that does not decay by itself costs something in "
              "Q1; with noise it stays about zero",
       .runs = systems},
      free.outcome == RegulatorOutcome::converged && var == 0 && left <= as_good_as_equal,
      on_condition(left <= as_good_as_equal));
}

/// Of an error of 1 m, after 100 steps of the monobot under u = -L x.
double left_on_line(double L) {
  MonobotMotion::State<double> x(1.0);
  for (int k = 0; k < 100; ++k) x = MonobotMotion().f<double>(x, -L * x, dt);
  return std::abs(x[0]);
}

Claim any_gain() {
  const MatrixXd one = MatrixXd::Identity(1, 1);
  const auto in_words = [&](double L) {
    return fmt::format("{} ({:.2g} m)", is_stabilizing(one, dt * one, L * one) ? "stable" : "unstable",
                       left_on_line(L));
  };
  const auto stable = [&](double L) { return is_stabilizing(one, dt * one, L * one) && left_on_line(L) < 1; };
  double least_unstable = 100, largest_stable = 0.1;
  while (least_unstable - largest_stable > 1e-6) {
    const double L = (least_unstable + largest_stable) / 2;
    (is_stabilizing(one, dt * one, L * one) ? largest_stable : least_unstable) = L;
  }
  return assessed(
      "5.1-any-gain", "above Example 5.1",
      "For a fully observable monobot the vehicle part of F - G L is stable for any positive definite L",
      {.rule = Rule::example,
       .measured = {"at 10 Hz, by L in 1/s, with what is left of 1 m after 100 steps: 0.1: {}; 10: {}; 19.9: "
                    "{}; 20.1: {}; 40: {}",
                    in_words(0.1), in_words(10), in_words(19.9), in_words(20.1), in_words(40)},
       .number = exactly("largest stable L at 10 Hz", largest_stable, "1/s"),
       .why = "0 < L < 2/dt: the vehicle part is 1 - L dt. Larger ones overshoot by more than they correct"},
      stable(20.1) && stable(40),
      on_condition(stable(0.1) && stable(10) && stable(19.9) && std::abs(largest_stable * dt - 2) < 1e-6));
}

/// The largest factor of a position's distance by (5.6) in a step without noise, at rest, over headings.
double largest_norm_of_position() {
  double largest = 0;
  for (double heading = -3; heading <= 3; heading += 0.5) {
    const closed_loop::Pose pose(0, 0, heading);
    const Matrix2d A =
        Matrix2d::Identity() - dt * point_velocity_by_input(closed_loop::body, heading) * gain(pose);
    largest = std::max(largest, std::sqrt(stability_of(MatrixXd(A.transpose() * A)).spectral_radius));
  }
  return largest;
}

Claim frozen_eigenvalues() {
  MatrixXd A(2, 2);
  A << 0.5, 2, 0, 0.5;
  const double each = stability_of(A).spectral_radius,
               in_turns = std::sqrt(stability_of(MatrixXd(A.transpose() * A)).spectral_radius),
               norm = largest_norm_of_position();
  return assessed("5.1-frozen", "Figure 5.5 and Figure 5.8, captions; below (5.12)",
                  "Asymptotic stability is guaranteed when the eigenvalues of F - G L, which change with "
                  "every step, are less than one",
                  {.rule = Rule::example,
                   .measured = {"[0.5 2; 0 0.5] and its transpose, both with eigenvalues {:.1f}, in turns: "
                                "an error grows {:.2f} times a step. The distance of the position by (5.6): "
                                "{:.3f} times a step at most, at any heading",
                                each, in_turns, norm},
                   .number = exactly("growth of an error a step, all eigenvalues 0.5", in_turns, "times"),
                   .why = "eigenvalues of a matrix that changes do not determine those of the product: all "
                          "can be below one while the error grows. Enough is that a norm of the error falls "
                          "at every step, as that of the position does here"},
                  each < 1 && in_turns < 1, in_truth(each < 1 && in_turns > 1 && norm < 1));
}

}  // namespace

std::vector<Claim> regulator_claims() {
  return {duality(), optimal(), decomposition(), index_of_T(), to_zero(), any_gain(), frozen_eigenvalues()};
}

}  // namespace incognita::section_5_1
