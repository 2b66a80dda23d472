#include "incognita/control/held_command.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "incognita/control/format_message.hpp"

namespace incognita {
namespace {

double sinc(double a) { return std::abs(a) < 1e-8 ? 1 : std::sin(a) / a; }

}  // namespace

double gain_bound_per_s(double max_turn_rate_rad_s, double hold_s) {
  const double a = max_turn_rate_rad_s * hold_s / 2;
  return 2 * std::cos(a) / (sinc(a) * hold_s);
}

std::optional<UnfitSetting> gain_refusal(const Eigen::MatrixXd& K, double hold_s,
                                         double max_turn_rate_rad_s) {
  const char *gain = "controller.gain_per_s", *rate = "run.rate_hz",
             *turns = "controller.max_turn_rate_rad_s";
  if (K.rows() != 2 || K.cols() != 2)
    return UnfitSetting({gain}, format_message("the gain is ", K.rows(), "x", K.cols(), ", not 2x2"));
  if (!(hold_s > 0) || !std::isfinite(hold_s))
    return UnfitSetting({rate}, format_message("a command held for ", hold_s, " s"));
  if (!K.allFinite()) return UnfitSetting({gain}, "the gain has an entry that is not finite");
  if (std::abs(K(0, 1) - K(1, 0)) > 1e-12 * K.cwiseAbs().maxCoeff())
    return UnfitSetting({gain}, "the gain is not symmetric");
  const Eigen::Vector2d k = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(K).eigenvalues();
  if (!(k[0] > 0))
    return UnfitSetting({gain},
                        format_message("the gain has the eigenvalue ", k[0], " 1/s, which is not positive"));
  if (!(k[1] * hold_s < 2)) {
    return UnfitSetting(
        {gain, rate},
        format_message("the gain ", k[1], " 1/s held for ", hold_s,
                       " s overshoots by more than it corrects; it must be less than ", 2 / hold_s, " 1/s"));
  }
  const double a = max_turn_rate_rad_s * hold_s / 2;
  if (!(a < std::numbers::pi / 2)) {
    return UnfitSetting(
        {turns, rate},
        format_message("at ", max_turn_rate_rad_s, " rad/s the body may turn by half a turn or more in the ",
                       hold_s, " s for which a command is held"));
  }
  const double mean = (1 / k[0] + 1 / k[1]) / 2, spread = (1 / k[0] - 1 / k[1]) / 2;
  if (std::cos(a) * mean - spread > hold_s * sinc(a) / 2) return std::nullopt;
  return UnfitSetting({gain, turns, rate},
                      format_message("the gain of eigenvalues ", k[0], " and ", k[1], " 1/s held for ",
                                     hold_s, " s may drive the vehicle away while its body turns at ",
                                     max_turn_rate_rad_s, " rad/s; equal eigenvalues must be less than ",
                                     gain_bound_per_s(max_turn_rate_rad_s, hold_s), " 1/s"));
}

std::optional<std::string> acceleration_gain_refusal(double by_error, double by_rate, double hold_s) {
  if (!(by_error > 0 && by_rate > 0) || !std::isfinite(by_error) || !std::isfinite(by_rate))
    return format_message("the gains ", by_error, " 1/s^2 on the error and ", by_rate,
                          " 1/s on its rate must both be positive and finite");
  if (by_error * hold_s / 2 < by_rate && by_rate < 2 / hold_s) return std::nullopt;
  return format_message("the gains ", by_error, " 1/s^2 on the error and ", by_rate,
                        " 1/s on its rate do not settle while commands are held for ", hold_s,
                        " s: the second must be more than ", by_error * hold_s / 2, " and less than ",
                        2 / hold_s);
}

}  // namespace incognita
