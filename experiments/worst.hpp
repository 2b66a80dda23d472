// The largest difference from the truth, over many cases, of what the thesis prints and of our correction.
#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <string>

#include "experiments/evidence.hpp"

namespace incognita {

struct Worst {
  double printed = 0, ours = 0;

  void take(double of_printed, double of_ours) {
    printed = std::max(printed, of_printed);
    ours = std::max(ours, of_ours);
  }
  /// The largest entries of the differences.
  void take(const Eigen::MatrixXd& as_printed, const Eigen::MatrixXd& as_ours, const Eigen::MatrixXd& truth) {
    take((as_printed - truth).cwiseAbs().maxCoeff(), (as_ours - truth).cwiseAbs().maxCoeff());
  }

  /// `printed 0.3 m, ours below 1e-9`
  std::string text(const std::string& unit = "") const {
    return fmt::format("printed {:.2g}{}{}, ours {}", printed, unit.empty() ? "" : " ", unit, below(ours));
  }
};

/// The claim that what is printed differs by no more than the tolerance; a misprint, if ours does.
inline Claim assessed(std::string id, std::string place, std::string statement, Evidence evidence,
                      const Worst& worst, double tolerance) {
  return assessed(std::move(id), std::move(place), std::move(statement), std::move(evidence),
                  worst.printed <= tolerance, as_corrected(worst.ours <= tolerance));
}

}  // namespace incognita
