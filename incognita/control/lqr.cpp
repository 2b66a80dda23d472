#include "incognita/control/lqr.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <complex>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "incognita/analysis/observability/closed_loop.hpp"
#include "incognita/math/expect_size.hpp"

namespace incognita {
namespace {

using Eigen::MatrixXd;

constexpr double rounding = 1e-12;         // relative tolerance of symmetry and semi-definiteness
constexpr double mode_margin = 1e-7;       // square root of the rounding: see the header
constexpr double largest_residual = 1e-8;  // relative
constexpr double least = std::numeric_limits<double>::min();

template <class... Parts>
std::string format_message(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

template <class Answer>
Answer refused(Answer answer, RegulatorOutcome outcome, const std::string& why) {
  answer.outcome = outcome;
  answer.reason = format_message(sentence(outcome), ": ", why);
  return answer;
}

void expect_finite(const char* name, const MatrixXd& M) {
  if (!M.allFinite()) throw std::invalid_argument(format_message(name, " has an entry that is not finite"));
}

void check_sizes(const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q1, const MatrixXd& Q2) {
  const Eigen::Index n = F.rows(), m = G.cols();
  if (n == 0 || m == 0)
    throw std::invalid_argument(format_message("a system of ", n, " states and ", m, " inputs"));
  expect_size("F", F, n, n);
  expect_size("G", G, n, m);
  expect_size("Q1", Q1, n, n);
  expect_size("Q2", Q2, m, m);
  expect_finite("F", F);
  expect_finite("G", G);
  expect_finite("Q1", Q1);
  expect_finite("Q2", Q2);
}

/// Reason why M is not symmetric and positive (semi-)definite.
std::optional<std::string> not_definite(const char* name, const MatrixXd& M, bool strictly) {
  const double size = M.cwiseAbs().maxCoeff(), skew = (M - M.transpose()).cwiseAbs().maxCoeff();
  if (skew > rounding * size) return format_message(name, " is not symmetric, by ", skew);
  const double lowest = Eigen::SelfAdjointEigenSolver<MatrixXd>(M, Eigen::EigenvaluesOnly).eigenvalues()[0];
  if (strictly && !(lowest > 0))
    return format_message(name, " has the eigenvalue ", lowest, ", which is not positive");
  if (lowest < -rounding * size) return format_message(name, " has the negative eigenvalue ", lowest);
  return std::nullopt;
}

/// A mode on or outside the unit circle that is unreachable by B: [F - lambda I | B] loses rank there (Popov,
/// Belevitch and Hautus). B is scaled to the size of F, so its units do not matter.
std::optional<std::complex<double>> unreached_mode(const MatrixXd& F, const MatrixXd& B,
                                                   const Eigen::VectorXcd& eigenvalues) {
  const Eigen::Index n = F.rows();
  const double size = std::max(F.norm(), 1.0), reach = B.norm();
  Eigen::MatrixXcd pencil(n, n + B.cols());
  pencil.rightCols(B.cols()) = (B * (reach > 0 ? size / reach : 0)).cast<std::complex<double>>();
  for (const std::complex<double>& lambda : eigenvalues) {
    if (std::abs(lambda) < 1 - mode_margin) continue;
    pencil.leftCols(n) = F.cast<std::complex<double>>();
    pencil.leftCols(n).diagonal().array() -= lambda;
    const double last = Eigen::JacobiSVD<Eigen::MatrixXcd>(pencil).singularValues()[n - 1];
    if (last <= mode_margin * size) return lambda;
  }
  return std::nullopt;
}

std::string named(std::complex<double> mode) {
  const std::string at =
      std::abs(mode.imag()) > mode_margin
          ? format_message(mode.real(), mode.imag() < 0 ? " - " : " + ", std::abs(mode.imag()), "i")
          : format_message(mode.real());
  return format_message("the mode ", at, ", of magnitude ", std::abs(mode));
}

/// (5.3); empty if Q2 + G' T G is not definite.
std::optional<MatrixXd> gain(const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q2, const MatrixXd& T) {
  const Eigen::LLT<MatrixXd> weight(Q2 + G.transpose() * T * G);
  if (weight.info() != Eigen::Success) return std::nullopt;
  return weight.solve(G.transpose() * T * F);
}

/// (5.4) as a sum of squares, so it is semi-definite whatever the rounding of L.
MatrixXd cost_before(const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q1, const MatrixXd& Q2,
                     const MatrixXd& L, const MatrixXd& T) {
  const MatrixXd A = F - G * L;
  const MatrixXd cost = Q1 + L.transpose() * Q2 * L + A.transpose() * T * A;
  return 0.5 * (cost + cost.transpose());
}

double change(const MatrixXd& before, const MatrixXd& after) {
  return (after - before).cwiseAbs().maxCoeff() / std::max(after.cwiseAbs().maxCoeff(), least);
}

/// Doubling: after k rounds T equals 2^k steps of (5.4) from a free end (Chu, Fan, Lin and Wang, Int. J.
/// Control 77, 2004). A is the state transition and B the effect of the inputs over that many steps. Where
/// plain (5.4) takes a million steps, this takes twenty rounds.
struct Doubling {
  MatrixXd A, B, T;

  void next() {
    const Eigen::Index n = A.rows();
    const Eigen::PartialPivLU<MatrixXd> W(MatrixXd::Identity(n, n) + B * T);
    const MatrixXd WA = W.solve(A), WB = W.solve(B);
    T = (T + WA.transpose() * T * A).eval();
    B = (B + A * WB * A.transpose()).eval();
    A = (A * WA).eval();
    T = (0.5 * (T + T.transpose())).eval();
    B = (0.5 * (B + B.transpose())).eval();
  }
};

std::optional<SteadyGain> refusal_before_start(const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q1,
                                               const MatrixXd& Q2) {
  using enum RegulatorOutcome;
  if (const auto why = not_definite("Q1", Q1, false)) return refused(SteadyGain{}, cost_not_definite, *why);
  if (const auto why = not_definite("Q2", Q2, true)) return refused(SteadyGain{}, cost_not_definite, *why);
  const Eigen::VectorXcd modes = stability_of(F).eigenvalues;
  if (!modes.allFinite()) return refused(SteadyGain{}, not_converged, "the eigenvalues of F were not found");
  if (const auto mode = unreached_mode(F, G, modes))
    return refused(SteadyGain{}, not_stabilizable, named(*mode));
  if (const auto mode = unreached_mode(F.transpose(), Q1, modes))
    return refused(SteadyGain{}, not_detectable, named(*mode));
  return std::nullopt;
}

/// Accepts a result only if it solves (5.4) and stabilizes.
SteadyGain verified(SteadyGain answer, const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q1,
                    const MatrixXd& Q2) {
  const auto L = gain(F, G, Q2, answer.T);
  if (!L) return refused(SteadyGain{}, RegulatorOutcome::not_converged, "Q2 + G' T G is not definite");
  const MatrixXd uncontrolled = F.transpose() * answer.T * F;
  const double terms = std::max({answer.T.norm(), uncontrolled.norm(), least});
  answer.L = *L;
  answer.residual = (answer.T - cost_before(F, G, Q1, Q2, *L, answer.T)).norm() / terms;
  const double radius = is_stabilizing(F, G, *L).spectral_radius;
  if (!(answer.residual <= largest_residual) || !(radius < 1)) {
    answer.L = answer.T = MatrixXd();
    return refused(answer, RegulatorOutcome::not_converged,
                   format_message("what was found misses (5.4) by ", answer.residual,
                                  " and has spectral radius ", radius));
  }
  answer.outcome = RegulatorOutcome::converged;
  answer.reason = format_message(sentence(answer.outcome), ": ", answer.iterations,
                                 " doublings, spectral radius ", radius);
  return answer;
}

}  // namespace

std::string_view sentence(RegulatorOutcome outcome) {
  switch (outcome) {
    case RegulatorOutcome::converged:
      return "the regulator is found";
    case RegulatorOutcome::cost_not_definite:
      return "the cost is not one: Q1 must be symmetric and positive semi-definite, Q2 definite";
    case RegulatorOutcome::not_stabilizable:
      return "no gain stabilizes: the inputs do not reach a mode that does not die out by itself";
    case RegulatorOutcome::not_detectable:
      return "the cheapest gain would not stabilize: a mode that does not die out by itself costs nothing";
    case RegulatorOutcome::not_converged:
      return "the recursion (5.4) did not settle";
  }
  return "unknown";
}

HorizonGains finite_horizon_gains(const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q1,
                                  const MatrixXd& Q2, const MatrixXd& T_end, int steps) {
  check_sizes(F, G, Q1, Q2);
  expect_size("T_end", T_end, F.rows(), F.rows());
  expect_finite("T_end", T_end);
  if (steps < 0) throw std::invalid_argument(format_message("a way of ", steps, " steps"));
  using enum RegulatorOutcome;
  for (const auto& why :
       {not_definite("Q1", Q1, false), not_definite("Q2", Q2, false), not_definite("T_end", T_end, false)}) {
    if (why) return refused(HorizonGains{}, cost_not_definite, *why);
  }
  HorizonGains answer;
  answer.T0 = T_end;
  for (int k = steps - 1; k >= 0; --k) {
    const auto L = gain(F, G, Q2, answer.T0);
    if (!L) return refused(HorizonGains{}, cost_not_definite, format_message("Q2 + G' T G of step ", k));
    answer.T0 = cost_before(F, G, Q1, Q2, *L, answer.T0);
    if (!answer.T0.allFinite())
      return refused(HorizonGains{}, not_converged, format_message("not finite at step ", k));
    answer.L.push_back(*L);
  }
  std::reverse(answer.L.begin(), answer.L.end());
  answer.outcome = converged;
  answer.reason = format_message(sentence(converged), ": ", steps, " steps");
  return answer;
}

SteadyGain steady_gain(const MatrixXd& F, const MatrixXd& G, const MatrixXd& Q1, const MatrixXd& Q2,
                       const RegulatorSettings& settings) {
  check_sizes(F, G, Q1, Q2);
  if (auto refusal = refusal_before_start(F, G, Q1, Q2)) return *refusal;
  Doubling doubling{F, G * Q2.llt().solve(G.transpose()), Q1};
  SteadyGain answer;
  double changed = std::numeric_limits<double>::infinity();
  while (!(changed <= settings.tolerance)) {
    if (answer.iterations >= settings.max_iterations) {
      return refused(answer, RegulatorOutcome::not_converged,
                     format_message("T still changes by ", changed, " of its largest entry after ",
                                    settings.max_iterations, " doublings, the cap"));
    }
    const MatrixXd before = doubling.T;
    doubling.next();
    ++answer.iterations;
    if (!doubling.T.allFinite()) {
      return refused(answer, RegulatorOutcome::not_converged,
                     format_message("T is not finite after ", answer.iterations, " doublings"));
    }
    changed = change(before, doubling.T);
  }
  answer.T = doubling.T;
  return verified(std::move(answer), F, G, Q1, Q2);
}

}  // namespace incognita
