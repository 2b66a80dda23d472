#include "incognita/slam/consensus.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace incognita {
namespace {

using Block = Eigen::Matrix2d;

/// Mahalanobis distance squared of match j once match i is taken as right.
double distance_given(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, int j, int i) {
  const Block gain = S.block<2, 2>(2 * j, 2 * i) * S.block<2, 2>(2 * i, 2 * i).inverse();
  const Eigen::Vector2d r = residuals.segment<2>(2 * j) - gain * residuals.segment<2>(2 * i);
  const Block cov = S.block<2, 2>(2 * j, 2 * j) - gain * S.block<2, 2>(2 * i, 2 * j);
  return r.dot(cov.inverse() * r);
}

std::vector<int> largest_group(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, double gate) {
  const int n = static_cast<int>(residuals.size() / 2);
  std::vector<int> best;
  double best_spread = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector2d own = residuals.segment<2>(2 * i);
    if (own.dot(S.block<2, 2>(2 * i, 2 * i).inverse() * own) > gate) continue;
    std::vector<int> group{i};
    double spread = 0;
    for (int j = 0; j < n; ++j) {
      if (j == i) continue;
      const double distance = distance_given(residuals, S, j, i);
      if (!(distance <= gate)) continue;
      group.push_back(j);
      spread += distance;
    }
    if (group.size() > best.size() || (group.size() == best.size() && spread < best_spread)) {
      best = group;
      best_spread = spread;
    }
  }
  return best;
}

struct Selected {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd S;
};

Selected select(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, const std::vector<int>& group) {
  const int n = static_cast<int>(group.size());
  Selected s{Eigen::VectorXd(2 * n), Eigen::MatrixXd(2 * n, 2 * n)};
  for (int a = 0; a < n; ++a) {
    s.residuals.segment<2>(2 * a) = residuals.segment<2>(2 * group[a]);
    for (int b = 0; b < n; ++b) s.S.block<2, 2>(2 * a, 2 * b) = S.block<2, 2>(2 * group[a], 2 * group[b]);
  }
  return s;
}

/// Of a group all together: covariance^-1 and covariance^-1 r. The innovation of member j given the others
/// has covariance ([S^-1]_jj)^-1 and mean ([S^-1]_jj)^-1 [S^-1 r]_j.
struct Together {
  Eigen::MatrixXd inverse;
  Eigen::VectorXd whitened;
  Together(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, const std::vector<int>& group) {
    const Selected s = select(residuals, S, group);
    inverse = s.S.llt().solve(Eigen::MatrixXd::Identity(s.S.rows(), s.S.cols()));
    whitened = inverse * s.residuals;
  }
  /// Mahalanobis distance squared of a member given the others.
  double distance(int member) const {
    const Eigen::Vector2d w = whitened.segment<2>(2 * member);
    return w.dot(inverse.block<2, 2>(2 * member, 2 * member).inverse() * w);
  }
  /// px^2, along the axis where the others say least: the inverse of the smaller eigenvalue.
  double variance(int member) const {
    const Block information = inverse.block<2, 2>(2 * member, 2 * member);
    const double half = information.trace() / 2;
    return 1 / (half - std::sqrt(std::max(0.0, half * half - information.determinant())));
  }
};

/// Drops the member for which `measure` of it given the others is greatest and above `limit`, until there is
/// none.
template <class Measure>
void drop_worst(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, double limit, Measure measure,
                std::vector<int>& group, std::size_t least) {
  while (group.size() > least) {
    const Together together(residuals, S, group);
    int worst = -1;
    double most = limit;
    for (int a = 0; a < static_cast<int>(group.size()); ++a) {
      const double of_a = measure(together, a);
      if (!(of_a > most)) continue;
      most = of_a;
      worst = a;
    }
    if (worst < 0) return;
    group.erase(group.begin() + worst);
  }
}

}  // namespace

std::vector<bool> agreeing_matches(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, double gate,
                                   double max_alone_sigma_px) {
  std::vector<bool> agrees(residuals.size() / 2, false);
  std::vector<int> group = largest_group(residuals, S, gate);
  drop_worst(
      residuals, S, gate, [](const Together& t, int member) { return t.distance(member); }, group, 1);
  if (std::isfinite(max_alone_sigma_px))
    drop_worst(
        residuals, S, max_alone_sigma_px * max_alone_sigma_px,
        [](const Together& t, int member) { return t.variance(member); }, group, 0);
  for (const int i : group) agrees[i] = true;
  return agrees;
}

}  // namespace incognita
