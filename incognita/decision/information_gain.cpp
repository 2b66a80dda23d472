#include "incognita/decision/information_gain.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "incognita/math/gaussian.hpp"

namespace incognita {
namespace {

/// Grows the storage and keeps its content. It grows by half more than needed, so that the loop rarely allocates.
void grow_storage(Eigen::MatrixXd& m, Eigen::Index rows, Eigen::Index columns) {
  if (rows <= m.rows() && columns <= m.cols()) return;
  m.conservativeResize(std::max(m.rows(), rows + rows / 2), std::max(m.cols(), columns + columns / 2));
}

double log_det_of_noise(const std::vector<PredictedMeasurement>& measurements) {
  double sum = 0;
  for (const PredictedMeasurement& measurement : measurements) sum += log_det(measurement.R);
  return sum;
}

std::int64_t identity_of(const PredictedMeasurement& measurement) {
  return measurement.of == PredictedMeasurement::Of::mapped ? static_cast<std::int64_t>(measurement.block)
                                                            : measurement.unseen;
}

}  // namespace

void InformationGain::start(const AnyBelief& belief, BlockId vehicle) {
  belief_ = &belief;
  vehicle_ = vehicle;
  begin(belief.chart(vehicle).tangent());
}

void InformationGain::begin(int vehicle_errors) {
  while (!steps_.empty()) {
    spare_.push_back(std::move(steps_.back()));
    steps_.pop_back();
  }
  vehicle_errors_ = vehicle_errors;
  known_.assign(1,
                {PredictedMeasurement::Of::mapped, static_cast<std::int64_t>(vehicle_), 0, vehicle_errors});
  rows_ = 0;
  columns_ = vehicle_errors;
  gain_ = 0;
  grow_storage(P_, columns_, columns_);
  P_.topLeftCorner(columns_, columns_) = covariance(known_[0], known_[0]);
}

BlockMatrix InformationGain::covariance(const Known& a, const Known& b) const {
  const auto row = static_cast<BlockId>(a.id), column = static_cast<BlockId>(b.id);
  return belief_->covariance(row, column);
}

/// First column of the landmark's errors in P_; -1 for an anchor, which has no error.
int InformationGain::column_of(const PredictedMeasurement& measurement) {
  if (measurement.of == PredictedMeasurement::Of::anchor) return -1;
  const std::int64_t id = identity_of(measurement);
  const auto size = static_cast<int>(measurement.Hl.cols());
  const auto at = static_cast<std::size_t>(
      std::find_if(known_.begin() + 1, known_.end(),
                   [&](const Known& k) { return k.of == measurement.of && k.id == id; }) -
      known_.begin());
  if (at == known_.size()) add_landmark_columns(measurement, size);
  const Known& found = known_[at];
  if (found.size != size)
    throw std::invalid_argument("a measurement has " + std::to_string(size) + " columns for a landmark of " +
                                std::to_string(found.size) + " errors");
  return found.column;
}

void InformationGain::add_landmark_columns(const PredictedMeasurement& measurement, int size) {
  const Known added{measurement.of, identity_of(measurement), columns_, size};
  grow_storage(P_, columns_ + size, columns_ + size);
  if (measurement.of == PredictedMeasurement::Of::unseen) {
    P_.block(0, columns_, columns_, size).setZero();
    P_.block(columns_, 0, size, columns_).setZero();
    P_.block(columns_, columns_, size, size) =
        measurement.unseen_var_m2 * Eigen::MatrixXd::Identity(size, size);
  } else {
    for (const Known& k : known_) {
      if (k.of == PredictedMeasurement::Of::unseen) {
        P_.block(k.column, columns_, k.size, size).setZero();
      } else {
        const BlockMatrix cross = covariance(k, added);
        if (cross.cols() != size) throw std::invalid_argument("a measurement does not fit its landmark");
        P_.block(k.column, columns_, k.size, size) = cross;
      }
      P_.block(columns_, k.column, size, k.size) = P_.block(k.column, columns_, k.size, size).transpose();
    }
    P_.block(columns_, columns_, size, size) = covariance(added, added);
  }
  known_.push_back(added);
  columns_ += size;
}

void InformationGain::push(const ImaginedStep& imagined) {
  if (imagined.A.rows() != vehicle_errors_ || imagined.A.cols() != vehicle_errors_ ||
      imagined.N.rows() != vehicle_errors_ || imagined.N.cols() != vehicle_errors_)
    throw std::invalid_argument("an imagined motion must be of the vehicle's " +
                                std::to_string(vehicle_errors_) + " errors");
  Step step;
  if (!spare_.empty()) {
    step = std::move(spare_.back());
    spare_.pop_back();
  }
  step.rows_before = rows_;
  step.columns_before = columns_;
  step.known_before = known_.size();
  step.gain_before = gain_;
  step.A = imagined.A;
  step.A_total = imagined.A;
  step.N_total = imagined.N;
  if (!steps_.empty()) {
    step.A_total = imagined.A * steps_.back().A_total;
    step.N_total += imagined.A * steps_.back().N_total * imagined.A.transpose();
  }
  step.measurements.assign(imagined.measurements.begin(), imagined.measurements.end());
  step.log_det_R = log_det_of_noise(step.measurements);
  apply_measurements(step);
  steps_.push_back(std::move(step));
  fill_rows(steps_.back());
  factorize(steps_.back());
}

/// Stacks the step's Jacobians and maps them to the current vehicle error: rows of Hv_ are Hv * A_total.
void InformationGain::apply_measurements(Step& step) {
  int rows = 0;
  for (const PredictedMeasurement& measurement : step.measurements) rows += measurement.rows();
  step.Hv.resize(rows, vehicle_errors_);
  step.columns.clear();
  grow_storage(Hv_, rows_ + rows, vehicle_errors_);
  int row = 0;
  for (const PredictedMeasurement& measurement : step.measurements) {
    if (measurement.Hv.rows() != measurement.rows() || measurement.Hv.cols() != vehicle_errors_)
      throw std::invalid_argument("a measurement does not fit its vehicle");
    step.Hv.middleRows(row, measurement.rows()) = measurement.Hv;
    step.columns.push_back(column_of(measurement));
    row += measurement.rows();
  }
  Hv_.block(rows_, 0, rows, vehicle_errors_).noalias() = step.Hv * step.A_total;
  rows_ += rows;
}

/// Computes the rows of S_ of the last step's measurements. A measurement depends only on the vehicle and its
/// landmark, so products with all other columns are skipped.
void InformationGain::fill_rows(const Step& step) {
  const int first = step.rows_before, rows = rows_ - first;
  grow_storage(S_, rows_, rows_);
  grow_storage(PH_, columns_, rows);
  grow_storage(PvH_, vehicle_errors_, rows_);
  auto PH = PH_.topLeftCorner(columns_, rows);
  PH.noalias() =
      P_.topLeftCorner(columns_, vehicle_errors_) * Hv_.block(first, 0, rows, vehicle_errors_).transpose();
  int row = 0;
  for (std::size_t i = 0; i < step.measurements.size(); ++i) {
    const PredictedMeasurement& measurement = step.measurements[i];
    if (step.columns[i] >= 0)
      PH.middleCols(row, measurement.rows()) += P_.block(0, step.columns[i], columns_, measurement.Hl.cols())
                                                    .lazyProduct(measurement.Hl.transpose());
    row += measurement.rows();
  }
  PvH_.block(0, first, vehicle_errors_, rows) = PH.topRows(vehicle_errors_);
  S_.block(first, 0, rows, rows_).noalias() =
      PH.topRows(vehicle_errors_).transpose() * Hv_.topLeftCorner(rows_, vehicle_errors_).transpose();
  for (const Step& of : steps_) add_landmarks(of, first, rows);
  add_noise(step);
}

/// Adds the landmark terms of the measurements of step `of` to the rows of S_ from `first` on.
void InformationGain::add_landmarks(const Step& of, int first, int rows) {
  int column = of.rows_before;
  for (std::size_t i = 0; i < of.measurements.size(); ++i) {
    const PredictedMeasurement& measurement = of.measurements[i];
    if (of.columns[i] >= 0)
      S_.block(first, column, rows, measurement.rows()) +=
          PH_.block(of.columns[i], 0, measurement.Hl.cols(), rows)
              .transpose()
              .lazyProduct(measurement.Hl.transpose());
    column += measurement.rows();
  }
}

/// Adds to the last step's rows the motion noise, cov(n_k, n_j) = Phi_(k<-j) N_j, and the measurement noise.
void InformationGain::add_noise(const Step& step) {
  const int first = step.rows_before;
  const auto rows = step.Hv.rows();
  BlockMatrix Phi = BlockMatrix::Identity(vehicle_errors_, vehicle_errors_);
  for (std::size_t j = steps_.size(); j-- > 0;) {
    const Step& before = steps_[j];
    S_.block(first, before.rows_before, rows, before.Hv.rows()) +=
        step.Hv * (Phi * before.N_total) * before.Hv.transpose();
    Phi = (Phi * before.A).eval();
  }
  int row = first;
  for (const PredictedMeasurement& measurement : step.measurements) {
    S_.block(row, row, measurement.rows(), measurement.rows()) += measurement.R;
    row += measurement.rows();
  }
}

/// Extends the Cholesky factor by the step's rows, and the gain by their log-determinant.
void InformationGain::factorize(const Step& step) {
  const int first = step.rows_before, rows = rows_ - first;
  if (rows == 0) return;
  grow_storage(L_, rows_, rows_);
  auto L21 = L_.block(first, 0, rows, first);
  L21 = S_.block(first, 0, rows, first);
  const auto L11 = L_.topLeftCorner(first, first);
  if (first > 0) L11.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(L21);
  auto L22 = L_.block(first, first, rows, rows);
  L22 = S_.block(first, first, rows, rows);
  if (first > 0) L22.noalias() -= L21 * L21.transpose();
  Eigen::Ref<Eigen::MatrixXd> in_place = L22;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(in_place);
  double log_det_L = 0;
  for (int i = 0; i < rows; ++i) log_det_L += std::log(L22(i, i));
  gain_ += llt.info() == Eigen::Success ? log_det_L - 0.5 * step.log_det_R
                                        : std::numeric_limits<double>::quiet_NaN();
}

void InformationGain::pop() {
  if (steps_.empty()) throw std::logic_error("there is no step to take back");
  Step& last = steps_.back();
  rows_ = last.rows_before;
  columns_ = last.columns_before;
  known_.resize(last.known_before, known_.front());
  gain_ = last.gain_before;
  spare_.push_back(std::move(last));
  steps_.pop_back();
}

double InformationGain::of(Metric metric, int position_errors, const BlockMatrix& vehicle_given_map) const {
  switch (metric) {
    case Metric::state:
      return of_state();
    case Metric::position_and_map:
      return of_position_and_map(position_errors, vehicle_given_map);
    case Metric::vehicle:
      return of_vehicle();
    case Metric::fisher:
      return fisher_trace();
    case Metric::fisher_given_state:
      return fisher_trace_given_state();
  }
  return 0;
}

double InformationGain::of_vehicle() const {
  if (steps_.empty() || rows_ == 0) return 0;
  const BlockMatrix P = vehicle_now();
  const BlockMatrix A = steps_.back().A_total;
  Eigen::MatrixXd C =
      PvH_.topLeftCorner(vehicle_errors_, rows_).transpose() * A.transpose();  // cov(z, x at the end)
  BlockMatrix Phi = BlockMatrix::Identity(vehicle_errors_, vehicle_errors_);
  for (std::size_t j = steps_.size(); j-- > 0;) {
    const Step& s = steps_[j];
    C.middleRows(s.rows_before, s.Hv.rows()) += s.Hv * (s.N_total * Phi.transpose());
    Phi = (Phi * s.A).eval();
  }
  // Normalized by the vehicle's sigmas; directions without variance carry no information and are left out
  const Eigen::VectorXd scale =
      P.diagonal().cwiseSqrt().unaryExpr([](double s) { return s > 0 ? 1 / s : 0; });
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> own(scale.asDiagonal() * P * scale.asDiagonal());
  constexpr double as_good_as_known = 1e-12;
  const Eigen::VectorXd inverse =
      own.eigenvalues().unaryExpr([](double x) { return x > as_good_as_known ? 1 / std::sqrt(x) : 0; });
  const Eigen::MatrixXd white = C * scale.asDiagonal() * own.eigenvectors() * inverse.asDiagonal();
  const Eigen::MatrixXd given = S_.topLeftCorner(rows_, rows_).selfadjointView<Eigen::Lower>();
  return 0.5 * (2 * L_.topLeftCorner(rows_, rows_).diagonal().array().log().sum() -
                log_det(given - white * white.transpose()));
}

/// Covariance of the vehicle at the end of the path, before its measurements.
BlockMatrix InformationGain::vehicle_now() const {
  const Step& last = steps_.back();
  return last.A_total * P_.topLeftCorner(vehicle_errors_, vehicle_errors_) * last.A_total.transpose() +
         last.N_total;
}

double InformationGain::of_position_and_map(int kept, const BlockMatrix& vehicle_given_map) const {
  if (steps_.size() > 1) throw std::logic_error("what position and map learn is worked out for one step");
  if (kept < 0 || kept > vehicle_errors_)
    throw std::invalid_argument("of the vehicle's " + std::to_string(vehicle_errors_) + " errors " +
                                std::to_string(kept) + " can not be its position");
  if (steps_.empty() || rows_ == 0) return 0;
  const Step& step = steps_.front();
  const int rest = vehicle_errors_ - kept;
  const BlockMatrix C = step.A * vehicle_given_map * step.A.transpose() + step.N_total;
  BlockMatrix left = C.bottomRightCorner(rest, rest);
  if (kept > 0) {
    const BlockMatrix across = C.bottomLeftCorner(rest, kept);
    left -= across * C.topLeftCorner(kept, kept).ldlt().solve(BlockMatrix(across.transpose()));
  }
  const auto Hv = step.Hv.rightCols(rest);
  Eigen::MatrixXd S = Hv * left * Hv.transpose();
  int row = 0;
  for (const PredictedMeasurement& measurement : step.measurements) {
    S.block(row, row, measurement.rows(), measurement.rows()) += measurement.R;
    row += measurement.rows();
  }
  return gain_ - 0.5 * (log_det(S) - step.log_det_R);
}

namespace {

/// trace(H' W^-1 H) of one measurement.
double trace_of(const PredictedMeasurement& measurement, const MeasurementMatrix& W) {
  MeasurementMatrix HH = measurement.Hv * measurement.Hv.transpose();
  if (measurement.Hl.cols() > 0) HH += measurement.Hl * measurement.Hl.transpose();
  return W.llt().solve(HH).trace();
}

}  // namespace

double InformationGain::fisher_trace() const {
  double sum = 0;
  if (steps_.empty()) return sum;
  int row = steps_.back().rows_before;
  for (const PredictedMeasurement& measurement : steps_.back().measurements) {
    sum += trace_of(measurement, S_.block(row, row, measurement.rows(), measurement.rows()));
    row += measurement.rows();
  }
  return sum;
}

double InformationGain::fisher_trace_given_state() const {
  double sum = 0;
  if (steps_.empty()) return sum;
  for (const PredictedMeasurement& measurement : steps_.back().measurements)
    sum += trace_of(measurement, measurement.R);
  return sum;
}

BlockMatrix vehicle_given_map(const AnyBelief& belief, BlockId vehicle) {
  const Eigen::MatrixXd P = belief.dense_covariance();
  const int first = belief.offset(vehicle), size = belief.chart(vehicle).tangent();
  const auto n = static_cast<int>(P.rows()), others = n - size;
  if (others == 0) return P;
  Eigen::MatrixXd map(others, others), cross(others, size);
  const auto other = [&](int i) { return i < first ? i : i + size; };
  for (int j = 0; j < others; ++j) {
    for (int i = 0; i < others; ++i) map(i, j) = P(other(i), other(j));
    cross.row(j) = P.block(other(j), first, 1, size);
  }
  return P.block(first, first, size, size) - cross.transpose() * map.llt().solve(cross);
}

}  // namespace incognita
