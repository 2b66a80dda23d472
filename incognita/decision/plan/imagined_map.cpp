#include "incognita/decision/plan/imagined_map.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "incognita/math/quaternion.hpp"

namespace incognita {
namespace {

constexpr int pose_errors = 6;  // position, orientation
constexpr double most_moved_m = 0.03;

/// log |P + r^2 I|.
double log_det_to(const Eigen::Matrix3d& P, double resolution_m) {
  const Eigen::Matrix3d with_floor = P + resolution_m * resolution_m * Eigen::Matrix3d::Identity();
  return std::log(with_floor.determinant());
}

}  // namespace

void PlannedMap::take(const Estimate& estimate, const Landmark& landmark, double weight) {
  const auto position = position_of(landmark.form, estimate.belief.mean(landmark.block));
  if (!position || position->position.size() != 3) return;
  const int errors = estimate.belief.chart(landmark.block).tangent();
  taken_.push_back({landmark.block, rows(), errors, position->J, position->position, false, weight});
}

void PlannedMap::start(const Estimate& estimate, std::size_t body, std::span<const BlockId> landmarks,
                       double expected_var_m2, int others) {
  const AnyBelief& belief = estimate.belief;
  const BlockId of_body = estimate.bodies[body].block;
  body_errors_ = belief.chart(of_body).tangent();
  expected_var_m2_ = expected_var_m2;
  taken_.clear();
  std::vector<const Landmark*> rest;
  for (const auto& [id, landmark] : estimate.landmarks) {
    if (landmark.fixed) continue;
    if (std::ranges::find(landmarks, landmark.block) != landmarks.end())
      take(estimate, landmark, 1);
    else if (landmark.form.kind == LandmarkParametrization::Kind::point)
      rest.push_back(&landmark);
  }
  const std::size_t count = std::min(rest.size(), static_cast<std::size_t>(others));
  for (std::size_t i = 0; i < count; ++i)
    take(estimate, *rest[i * rest.size() / count],
         static_cast<double>(rest.size()) / static_cast<double>(count));
  covariance_.resize(rows(), rows());
  covariance_.topLeftCorner(body_errors_, body_errors_) = belief.covariance(of_body);
  for (std::size_t i = 0; i < taken_.size(); ++i) {
    const Taken& a = taken_[i];
    covariance_.block(a.row, 0, a.errors, body_errors_) = belief.covariance(a.block, of_body);
    covariance_.block(0, a.row, body_errors_, a.errors) =
        covariance_.block(a.row, 0, a.errors, body_errors_).transpose();
    for (std::size_t j = 0; j <= i; ++j) {
      const Taken& b = taken_[j];
      covariance_.block(a.row, b.row, a.errors, b.errors) = belief.covariance(a.block, b.block);
      covariance_.block(b.row, a.row, b.errors, a.errors) =
          covariance_.block(a.row, b.row, a.errors, b.errors).transpose();
    }
  }
}

void PlannedMap::leave_out_moved(const Estimate& estimate) {
  for (const auto& [id, landmark] : estimate.landmarks) {
    const auto taken = std::ranges::find(taken_, landmark.block, &Taken::block);
    if (landmark.fixed || taken == taken_.end()) continue;
    taken->moved |= estimate.belief.chart(landmark.block).tangent() != taken->errors;  // a point by now
    const auto now = position_of(landmark.form, estimate.belief.mean(landmark.block));
    taken->moved |= !now || (now->position - taken->position).norm() > most_moved_m;
  }
}

int PlannedMap::row_of(BlockId block) const {
  const auto found = std::ranges::find(taken_, block, &Taken::block);
  return found == taken_.end() || found->moved ? -1 : found->row;
}

ImaginedMap::ImaginedMap(const PlannedMap& map) : P_(map.covariance()) {}

void ImaginedMap::predict(const BlockMatrix& A, const BlockMatrix& N) {
  const Eigen::Index v = A.rows(), rest = P_.rows() - v;
  P_.topLeftCorner(v, v) = (A * P_.topLeftCorner(v, v) * A.transpose() + N).eval();
  P_.topRightCorner(v, rest) = (A * P_.topRightCorner(v, rest)).eval();
  P_.bottomLeftCorner(rest, v) = P_.topRightCorner(v, rest).transpose();
}

void ImaginedMap::update(const PlannedMap& map, std::span<const PredictedMeasurement> measurements) {
  update_known(map, measurements);
  for (const PredictedMeasurement& m : measurements)
    if (m.of == PredictedMeasurement::Of::unseen) update_expected(m, map.expected_var_m2());
}

void ImaginedMap::update_known(const PlannedMap& map, std::span<const PredictedMeasurement> measurements) {
  const int v = map.body_errors();
  struct Row {
    const PredictedMeasurement* measurement;
    int landmark;  ///< first row in P_; -1: an anchor
  };
  std::vector<Row> used;
  int rows = 0;
  for (const PredictedMeasurement& m : measurements) {
    if (m.of == PredictedMeasurement::Of::unseen) continue;
    const int at = m.of == PredictedMeasurement::Of::mapped ? map.row_of(m.block) : -1;
    if (m.of == PredictedMeasurement::Of::mapped && at < 0) continue;
    used.push_back({&m, at});
    rows += m.rows();
  }
  if (rows == 0) return;
  Eigen::MatrixXd PH(P_.rows(), rows), S(rows, rows);
  int column = 0;
  for (const Row& r : used) {
    const int n = r.measurement->rows();
    PH.middleCols(column, n).noalias() = P_.leftCols(v) * r.measurement->Hv.transpose();
    if (r.landmark >= 0)
      PH.middleCols(column, n).noalias() +=
          P_.middleCols(r.landmark, r.measurement->Hl.cols()) * r.measurement->Hl.transpose();
    column += n;
  }
  int row = 0;
  for (const Row& r : used) {
    const int n = r.measurement->rows();
    S.middleRows(row, n).noalias() = r.measurement->Hv * PH.topRows(v);
    if (r.landmark >= 0)
      S.middleRows(row, n).noalias() +=
          r.measurement->Hl * PH.middleRows(r.landmark, r.measurement->Hl.cols());
    S.block(row, row, n, n) += r.measurement->R;
    row += n;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(S);
  if (factor.info() != Eigen::Success) return;
  const Eigen::MatrixXd W = factor.matrixL().solve(PH.transpose());
  P_.noalias() -= W.transpose() * W;
}

/// z = Hv * body + Hl * landmark + noise, where the landmark is independent of the body.
void ImaginedMap::update_expected(const PredictedMeasurement& m, double var_m2) {
  auto found = std::ranges::find(expected_, m.unseen, &Expected::index);
  if (found == expected_.end()) {
    expected_.push_back({m.unseen, var_m2 * Eigen::Matrix3d::Identity()});
    found = expected_.end() - 1;
  }
  const Eigen::Index v = m.Hv.cols();
  const Eigen::Matrix3Xd PH = found->P * m.Hl.transpose();
  const Eigen::MatrixXd S = m.Hl * PH + m.Hv * P_.topLeftCorner(v, v) * m.Hv.transpose() + m.R;
  found->P -= (PH * S.llt().solve(PH.transpose())).eval();
}

double ImaginedMap::about_map(const PlannedMap& map, const Resolution& resolution) const {
  double nats = 0;
  const Eigen::MatrixXd& before = map.covariance();
  for (const PlannedMap::Taken& l : map.taken()) {
    const Eigen::Matrix3d was = l.J * before.block(l.row, l.row, l.errors, l.errors) * l.J.transpose(),
                          is = l.J * P_.block(l.row, l.row, l.errors, l.errors) * l.J.transpose();
    nats += l.weight * (log_det_to(was, resolution.position_m) - log_det_to(is, resolution.position_m)) / 2;
  }
  return nats;
}

double ImaginedMap::about_expected(const PlannedMap& map, std::span<const ExpectedLandmark> expected,
                                   const Resolution& resolution) const {
  const double before =
      log_det_to(map.expected_var_m2() * Eigen::Matrix3d::Identity(), resolution.position_m);
  double nats = 0;
  for (const Expected& e : expected_) {
    const auto found = std::ranges::find(expected, e.index, &ExpectedLandmark::index);
    if (found == expected.end()) continue;
    nats += found->probability * (before - log_det_to(e.P, resolution.position_m)) / 2;
  }
  return nats;
}

double ImaginedMap::missing_about(const PlannedMap& map, int expected_index, const Eigen::Vector3d& way,
                                  const Eigen::Matrix3d& R, const Resolution& resolution) const {
  const auto found = std::ranges::find(expected_, expected_index, &Expected::index);
  const Eigen::Matrix3d P =
      found == expected_.end() ? map.expected_var_m2() * Eigen::Matrix3d::Identity() : found->P;
  Eigen::Matrix<double, 3, pose_errors> J;
  J << Eigen::Matrix3d::Identity(), -skew(way) * R;
  const Eigen::Matrix3d of_body = J * P_.topLeftCorner<pose_errors, pose_errors>() * J.transpose();
  return std::max(0.0,
                  (log_det_to(P, resolution.position_m) - log_det_to(of_body, resolution.position_m)) / 2);
}

double ImaginedMap::entropy_of_pose(const Resolution& resolution) const {
  Eigen::Matrix<double, pose_errors, pose_errors> P = P_.topLeftCorner<pose_errors, pose_errors>();
  P.diagonal().head<3>().array() += std::pow(resolution.position_m, 2);
  P.diagonal().tail<3>().array() += std::pow(resolution.angle_rad, 2);
  const Eigen::LLT<Eigen::Matrix<double, pose_errors, pose_errors>> factor(P);
  return factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace incognita
