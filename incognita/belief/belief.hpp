// The belief: a joint Gaussian over vehicles and landmarks. state_layout.hpp has its blocks and their means,
// information_belief.hpp the same in information form.
//
// Block ids never change; vehicles precede landmarks. Each block has a chart: its mean stays on its manifold,
// and the covariance is that of the error in the chart. Only the lower triangle of the covariance is valid,
// and its storage is private to this module.
//
// predict() is linear in the state, update() quadratic with one pass over one triangle. Neither allocates
// once the largest state and the largest measurement have occurred.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/linearized.hpp"
#include "incognita/belief/state_layout.hpp"
#include "incognita/belief/tiled_cholesky.hpp"
#include "incognita/belief/triangle.hpp"
#include "incognita/belief/update_report.hpp"

namespace incognita {

/// Treatment of the correlations between landmarks.
enum class MapCorrelations {
  full,            ///< the exact Kalman filter
  block_diagonal,  ///< block-diagonal map, thesis (3.28); its blocks are inflated to stay conservative
};

class Belief : public StateLayout {
 public:
  /// `expected_errors`: initial size of the covariance, which grows when needed. With a block-diagonal map update()
  /// and augment() are linear in the map instead of quadratic (memory stays quadratic), and one vehicle is allowed.
  explicit Belief(int expected_errors = 64, MapCorrelations correlations = MapCorrelations::full);

  // Contents.

  MapCorrelations correlations() const { return correlations_; }
  /// Cross covariance of two blocks' errors.
  BlockMatrix covariance(BlockId row, BlockId column) const;
  BlockMatrix covariance(BlockId id) const { return covariance(id, id); }
  /// Copy of the whole covariance, both triangles. Slow: for tests and small maps.
  Eigen::MatrixXd dense_covariance() const;
  /// Copies the lower triangle of the covariance of the errors from `first` on, the leading `last` of them ordered last.
  /// Column-major, `stride` >= number of these errors.
  void copy_covariance(int first, int last, double* out, int stride) const;
  /// The same to be factorized in steps.
  void copy_covariance(int first, int last, TiledCholesky& out) const;

  // Operations. All throw std::invalid_argument, with the sizes, when sizes do not fit; the belief is unchanged then.

  /// Adds a vehicle that is independent of all blocks. Throws std::logic_error once there are landmarks, and
  /// for a second vehicle with a block-diagonal map.
  BlockId add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                      const Eigen::Ref<const Eigen::MatrixXd>& covariance);

  /// Adds a block whose error is sum of J_i * (error of parent i) + noise: landmark initialization, thesis
  /// (2.20)-(2.26).
  using Parent = BlockParent;
  BlockId augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                  std::span<const Parent> parents, const Eigen::Ref<const Eigen::MatrixXd>& noise);

  /// Reparametrizes a block: new error = J * (old error) + noise. The number of errors must not grow.
  void replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
               const BlockMatrix& J, const BlockMatrix& noise);

  /// Marginalizes a block out.
  void drop(BlockId id);

  /// EKF prediction (A.2.1)-(A.2.4), linear in the size of the state.
  void predict(const LinearizedMotion& motion);

  /// Sets mean and covariance of a block as they were before predictions with A = 1, and shortens the trace to what it was
  /// (`trace_size`): AnyBelief::take_noise_back().
  void restore(BlockId id, const BlockVector& mean, const BlockMatrix& covariance, std::size_t trace_size);

  /// EKF update (A.2.5), (A.2.6) with all measurements at once: P <- P - W W' with W = P H' L^-T, S = L L',
  /// on one triangle. Returns `singular` when S is not positive definite within rounding, or when a posterior
  /// variance would be lost to rounding (e.g. a prior 1e16 times the variance of a measurement;
  /// update_joseph() still accepts that one). With a block-diagonal map measurements are applied
  /// sequentially, and those that would lose a variance are skipped; `singular` then means that all were.
  UpdateReport update(std::span<const LinearizedMeasurement> measurements);

  /// The same in Joseph form (A.2.7) on dense matrices: slower, allocates, keeps P positive for any gain.
  /// Throws std::logic_error with a block-diagonal map.
  UpdateReport update_joseph(std::span<const LinearizedMeasurement> measurements);

  /// The correction that update() would add to the errors of `blocks`, one vector each in `out`, without applying it.
  /// False without measurements and when update() would reject S. The cost does not depend on the size of the map.
  /// Throws std::logic_error with a block-diagonal map, whose measurements are applied sequentially.
  bool correction(std::span<const LinearizedMeasurement> measurements, std::span<const BlockId> blocks,
                  std::span<BlockVector> out);

  /// Re-expresses blocks in a frame that moves with another block, e.g. landmarks in the vehicle frame. The
  /// error of the moving block becomes A * error + noise N, that of each block in `others` A_i * its own +
  /// B_i * that of the moving block; all remaining blocks keep theirs. Quadratic in the state; allocates.
  /// Throws std::logic_error with a block-diagonal map.
  struct MovedBlock {
    BlockId block = 0;
    BlockVector x_next;  ///< mean afterwards
    BlockMatrix A;       ///< errors x errors
    BlockMatrix B;       ///< errors x errors of the moving block
  };
  void change_frame(const LinearizedMotion& frame_motion, std::span<const MovedBlock> others);

  /// Adds to the error of each landmark its B times the errors of the vehicle from `first` on: P <- T P T'. Means stay.
  /// Quadratic in the state, one pass over one triangle. Throws std::logic_error with a block-diagonal map.
  void shear(BlockId vehicle, int first, std::span<const ErrorShear> landmarks);

  /// Makes the covariance, or only its map part (3.28), block diagonal with the least additional trace: see
  /// inflation.hpp. Slow, for studies. The first block is the vehicle; throws std::logic_error when there is
  /// another vehicle.
  enum class Scope { everything, map };
  void decorrelate(Scope scope);

  /// Joint innovation covariance S = H P H' + R of all measurements: rows x rows, both triangles. The cost
  /// does not depend on the size of the map.
  void innovation_covariance(std::span<const LinearizedMeasurement> measurements, Eigen::MatrixXd& S) const;

  /// Saves or restores all but the trace: math/saved_state/.
  void state(StateArchive& archive);

 private:
  using Matrix = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  using ConstMatrix = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

  template <class SetColumn, class Set>
  void copy_ordered(int first, int last, const SetColumn& set_column, const Set& set) const;
  void reserve(int errors);
  void reserve_rank(int rank);
  void gather_above(const MeasurementJacobian& H, const Block& b, int first, int last, double* out) const;
  void gather_below(const MeasurementJacobian& H, const Block& b, int first, int last, double* out) const;
  void gather_PHt(std::span<const LinearizedMeasurement> measurements, int rank);
  MeasurementJacobian times_covariance(const LinearizedMeasurement& measurement, const Block& to) const;
  bool compute_delta(int rank);
  void innovation_from_PHt(std::span<const LinearizedMeasurement> measurements);
  bool factorize_innovation(std::span<const LinearizedMeasurement> measurements, UpdateReport& report);
  bool factorize_filled(std::span<const LinearizedMeasurement> measurements, UpdateReport& report);
  UpdateReport update_block_diagonal(std::span<const LinearizedMeasurement> measurements);
  bool leaves_variances(int rank);
  bool apply_measurement(const LinearizedMeasurement& measurement, std::span<double> delta);
  void align_columns(const LinearizedMeasurement& measurement);
  void shrink_arrow(int rank);
  void shrink_map(int rank, int column);
  void separate_new_block(const Block& new_block);
  template <class Destination>
  void fill_innovation_covariance(std::span<const LinearizedMeasurement> measurements, Destination& S) const;

  /// P; only the lower triangle is valid.
  Matrix P() { return {P_.column(0), errors_, errors_, Eigen::OuterStride<>(P_.stride)}; }
  ConstMatrix P() const { return {P_.column(0), errors_, errors_, Eigen::OuterStride<>(P_.stride)}; }
  double entry(int i, int j) const { return P_.entry(i, j); }
  /// The rows x rows innovation covariance, or its factor; only the lower triangle is valid.
  Matrix S(int rows) { return {S_.data(), rows, rows, Eigen::OuterStride<>(S_stride_)}; }

  Triangle P_;
  MapCorrelations correlations_ = MapCorrelations::full;

  // Workspace of update(), kept to avoid allocation
  int rank_capacity_ = 0;
  int S_stride_ = 0;
  AlignedBuffer S_;       ///< lower triangle of the innovation covariance, then its Cholesky factor
  AlignedBuffer PHt_;     ///< stride x rank
  AlignedBuffer packed_;  ///< W in the panel layout of rank_update
  Eigen::VectorXd residual_, delta_;
  Eigen::VectorXd
      norms_;  ///< squared, of the rows of L; with a block-diagonal map also norms of the blocks of W
};

}  // namespace incognita
