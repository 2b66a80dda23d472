#include "incognita/slam/features/consensus.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace incognita {
namespace {

using Block = Eigen::Matrix2d;

/// Squared Mahalanobis distance of match j given match i.
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

/// Inverse of the joint innovation covariance of a group.
Eigen::MatrixXd information_of(const Eigen::MatrixXd& S, const std::vector<int>& group) {
  const int n = static_cast<int>(group.size());
  Eigen::MatrixXd own(2 * n, 2 * n);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) own.block<2, 2>(2 * a, 2 * b) = S.block<2, 2>(2 * group[a], 2 * group[b]);
  return own.llt().solve(Eigen::MatrixXd::Identity(2 * n, 2 * n));
}

/// Removes a member from a group and from the inverse of its covariance, whose remaining blocks then are the inverse of the
/// remaining covariance (Schur complement): quadratic in the group instead of cubic.
void remove_member(std::vector<int>& group, Eigen::MatrixXd& inverse, int member) {
  const Eigen::Index first = 2 * member, after = first + 2, rest = inverse.rows() - after;
  const Eigen::Matrix<double, Eigen::Dynamic, 2> column = inverse.middleCols<2>(first);
  const Block own = column.middleRows<2>(first).inverse();
  inverse.noalias() -= (column * own) * column.transpose();
  inverse.middleRows(first, rest) = inverse.bottomRows(rest).eval();
  inverse.middleCols(first, rest) = inverse.rightCols(rest).eval();
  inverse.conservativeResize(inverse.rows() - 2, inverse.cols() - 2);
  group.erase(group.begin() + member);
}

/// Removes the least consistent member until every one passes. The innovation of a member given the others
/// has covariance ([S^-1]_jj)^-1 and mean ([S^-1]_jj)^-1 [S^-1 r]_j.
void leave_one_out(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S, double gate,
                   std::vector<int>& group) {
  Eigen::MatrixXd inverse = information_of(S, group);
  while (group.size() > 1) {
    Eigen::VectorXd own(inverse.rows());
    for (int a = 0; a < static_cast<int>(group.size()); ++a)
      own.segment<2>(2 * a) = residuals.segment<2>(2 * group[a]);
    const Eigen::VectorXd whitened = inverse * own;
    int worst = -1;
    double worst_distance = gate;
    for (int a = 0; a < static_cast<int>(group.size()); ++a) {
      const Eigen::Vector2d w = whitened.segment<2>(2 * a);
      const double distance = w.dot(inverse.block<2, 2>(2 * a, 2 * a).inverse() * w);
      if (distance > worst_distance) {
        worst_distance = distance;
        worst = a;
      }
    }
    if (worst < 0) return;
    remove_member(group, inverse, worst);
  }
}

/// Largest variance, px^2, of a member's innovation given the others. `inverse` is that of the group's
/// covariance; its diagonal blocks are the inverses of the conditional covariances.
double variance_given_others(const Eigen::MatrixXd& inverse, int member) {
  const Block information = inverse.block<2, 2>(2 * member, 2 * member);
  const double half = information.trace() / 2;
  const double least = half - std::sqrt(std::max(0.0, half * half - information.determinant()));
  return least > 0 ? 1 / least : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<bool> consistent_matches(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& S,
                                     double gate) {
  std::vector<bool> agrees(residuals.size() / 2, false);
  std::vector<int> group = largest_group(residuals, S, gate);
  leave_one_out(residuals, S, gate, group);
  for (const int i : group) agrees[i] = true;
  return agrees;
}

std::vector<bool> unconfirmed_matches(const Eigen::MatrixXd& S, const std::vector<bool>& agrees,
                                      const std::vector<bool>& returning, double max_sigma_px) {
  std::vector<bool> alone(agrees.size(), false);
  std::vector<int> group;
  bool any = false;
  for (int i = 0; i < static_cast<int>(agrees.size()); ++i) {
    if (!agrees[i]) continue;
    group.push_back(i);
    any = any || returning[i];
  }
  if (!any) return alone;
  Eigen::MatrixXd inverse = information_of(S, group);
  while (!group.empty()) {
    int worst = -1;
    double most = max_sigma_px * max_sigma_px;
    for (int a = 0; a < static_cast<int>(group.size()); ++a) {
      if (!returning[group[a]]) continue;
      const double variance = variance_given_others(inverse, a);
      if (variance <= most) continue;
      most = variance;
      worst = a;
    }
    if (worst < 0) break;
    alone[group[worst]] = true;
    remove_member(group, inverse, worst);
  }
  return alone;
}

}  // namespace incognita
