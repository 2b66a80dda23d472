// The belief: a Gaussian over vehicles and landmarks, and what can happen to it. Its blocks and their means
// are in state_layout.hpp; information_belief.hpp has the same in information form.
//
// Blocks keep their ids for life; vehicles come first, landmarks follow. Each block has a chart, so the mean
// is kept on its manifold and the covariance is that of the error in the chart. Only the lower triangle of
// the covariance means anything, and nobody outside this room sees how it is stored.
//
// predict() costs time linear in the state, update() quadratic with one pass over one triangle. Neither
// allocates once the largest state and the largest measurement have been seen.
#pragma once

#include <Eigen/Core>
#include <span>

#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/linearized.hpp"
#include "incognita/belief/state_layout.hpp"
#include "incognita/belief/triangle.hpp"
#include "incognita/belief/update_report.hpp"

namespace incognita {

/// What becomes of the correlations between landmarks.
enum class MapCorrelations {
  full,            ///< as Kalman has it
  block_diagonal,  ///< the map stays block diagonal, thesis (3.28), its blocks inflated by what that takes
};

class Belief : public StateLayout {
 public:
  /// `expected_errors`: how large the covariance is expected to grow; more is allocated when it does. With
  /// `dropped` correlations update() and augment() are linear in the map, not quadratic; memory stays
  /// quadratic. One vehicle only then.
  explicit Belief(int expected_errors = 64, MapCorrelations correlations = MapCorrelations::full);

  // What is in it
  // -------------------------------------------------------------------------------------------------

  MapCorrelations correlations() const { return correlations_; }
  /// Covariance between two blocks' errors.
  BlockMatrix covariance(BlockId row, BlockId column) const;
  BlockMatrix covariance(BlockId id) const { return covariance(id, id); }
  /// A copy of the whole covariance, both triangles: for tests, entropies once a second, and small maps.
  Eigen::MatrixXd dense_covariance() const;

  // What can happen to it
  // ----------------------------------------------------------------------------------------- All throw
  // std::invalid_argument, with the sizes, when sizes do not fit; the belief is unchanged then.

  /// A vehicle, independent of all there is. Throws std::logic_error when there are landmarks already.
  BlockId add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                      const Eigen::Ref<const Eigen::MatrixXd>& covariance);

  /// A block whose error is sum of J_i * (error of block i) + noise: a landmark's birth, thesis
  /// (2.20)-(2.26).
  using Parent = BlockParent;
  BlockId augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                  std::span<const Parent> parents, const Eigen::Ref<const Eigen::MatrixXd>& noise);

  /// The same block in another chart: new error = J * (old error) + noise. It must not grow.
  void replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
               const BlockMatrix& J, const BlockMatrix& noise);

  /// Forgets a block (marginalises it out).
  void drop(BlockId id);

  /// (A.2.1)-(A.2.4). Linear in the size of the state.
  void predict(const LinearizedMotion& motion);

  /// (A.2.5), (A.2.6) with all looks at once: P <- P - W W' with W = P H' L^-T, S = L L', on one triangle.
  /// An S that is not positive definite to rounding comes back as `singular`, and so does a variance of which
  /// rounding would leave nothing, e.g. a prior 1e16 times the variance of a look; update_joseph() still
  /// takes that one. With dropped correlations looks are used one after the other, and one that would leave
  /// nothing of a variance is left out; `singular` then means that all were.
  UpdateReport update(std::span<const LinearizedMeasurement> measurements);

  /// The same with the Joseph form (A.2.7) on dense matrices: slower, allocates, keeps P positive for any
  /// gain. Not for dropped correlations: throws std::logic_error.
  UpdateReport update_joseph(std::span<const LinearizedMeasurement> measurements);

  /// What update() would add to the errors of some blocks, without doing it: `out` has one vector for each.
  /// False when update() would refuse S. Costs nothing that grows with the map. Not for dropped correlations,
  /// whose looks are used one after the other: throws std::logic_error.
  bool correction(std::span<const LinearizedMeasurement> measurements, std::span<const BlockId> blocks,
                  std::span<BlockVector> out);

  /// One block moves and takes all others along, as landmarks told in the frame of a vehicle do:
  /// its error after = A * error before, that of each other block = A_i * its own + B_i * that of the mover.
  /// Whoever is not among `others` stays. Quadratic in the state; allocates. Not for dropped correlations:
  /// throws std::logic_error.
  struct MovedBlock {
    BlockId block = 0;
    BlockVector x_next;  ///< mean after
    BlockMatrix A;       ///< errors x errors
    BlockMatrix B;       ///< errors x errors of the mover
  };
  void change_frame(const LinearizedMotion& frame_motion, std::span<const MovedBlock> others);

  /// Makes the covariance block diagonal, or only the map's part of it (3.28), with the least trace added:
  /// see inflation.hpp. For maps to study: slower than anything else here. The first block is the
  /// vehicle; throws std::logic_error when there is another.
  enum class Scope { everything, map };
  void decorrelate(Scope scope);

  /// Innovation covariance S = H P H' + R of looks, all of them together; sized rows x rows, both triangles.
  /// Costs nothing that grows with the map.
  void innovation_covariance(std::span<const LinearizedMeasurement> measurements, Eigen::MatrixXd& S) const;

 private:
  using Matrix = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  using ConstMatrix = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

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

  /// P with one valid triangle, the lower.
  Matrix P() { return {P_.column(0), errors_, errors_, Eigen::OuterStride<>(P_.stride)}; }
  ConstMatrix P() const { return {P_.column(0), errors_, errors_, Eigen::OuterStride<>(P_.stride)}; }
  double entry(int i, int j) const { return P_.entry(i, j); }
  /// The innovation covariance of so many rows, or its factor, with one valid triangle, the lower.
  Matrix S(int rows) { return {S_.data(), rows, rows, Eigen::OuterStride<>(S_stride_)}; }

  Triangle P_;
  MapCorrelations correlations_ = MapCorrelations::full;

  // Workspace of update(), kept so that it allocates nothing
  int rank_capacity_ = 0;
  int S_stride_ = 0;
  AlignedBuffer S_;       ///< lower triangle of the innovation covariance, then of its Cholesky factor
  AlignedBuffer PHt_;     ///< stride x rank
  AlignedBuffer packed_;  ///< W in the panels of rank_update
  Eigen::VectorXd residual_, delta_;
  Eigen::VectorXd norms_;  ///< of the rows of L; where correlations are dropped also of W's, by block
};

}  // namespace incognita
