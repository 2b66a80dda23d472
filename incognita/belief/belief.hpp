// The belief: a Gaussian over vehicles and landmarks, and what can happen to it.
//
// Blocks keep their ids for life; vehicles come first, landmarks follow. Each block has a chart, so the mean
// is kept on its manifold and the covariance is that of the error in the chart. Only the lower triangle of
// the covariance means anything, and nobody outside this room sees how it is stored.
//
// predict() costs time linear in the state, update() quadratic with one pass over one triangle. Neither
// allocates once the largest state and the largest measurement have been seen.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "incognita/belief/affine.hpp"
#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/trace.hpp"
#include "incognita/math/chart.hpp"

namespace incognita {

struct UpdateReport {
  enum class Outcome {
    updated,
    nothing,   ///< no looks were given
    singular,  ///< the looks cannot be used within rounding; the belief is unchanged
  };
  Outcome outcome = Outcome::nothing;
  double nis = 0;        ///< residual' S^-1 residual
  int rows = 0;          ///< its degrees of freedom
  double log_det_S = 0;  ///< so the update took (log_det_S - log_det_R)/2 nats of entropy: thesis (6.6)
  double log_det_R = 0;
};

/// What becomes of the correlations between landmarks.
enum class MapCorrelations {
  kept,     ///< as Kalman has it
  dropped,  ///< the map stays block diagonal, thesis (3.28), its blocks inflated by what that takes
};

class Belief {
 public:
  /// `expected_errors`: how large the covariance is expected to grow; more is allocated when it does. With
  /// `dropped` correlations update() and augment() are linear in the map, not quadratic; memory stays
  /// quadratic. One vehicle only then.
  explicit Belief(int expected_errors = 64, MapCorrelations correlations = MapCorrelations::kept);

  // What is in it
  // -------------------------------------------------------------------------------------------------

  int errors() const { return errors_; }  ///< size of the covariance
  MapCorrelations correlations() const { return correlations_; }
  int block_count() const { return static_cast<int>(blocks_.size()); }
  bool has(BlockId id) const { return index_of_.size() > id && index_of_[id] >= 0; }
  const Chart& chart(BlockId id) const { return block(id).chart; }
  /// Mean as stored: chart.ambient() numbers. Valid until the next change of the belief.
  Eigen::Map<const Eigen::VectorXd> mean(BlockId id) const;
  /// Covariance between two blocks' errors.
  BlockMatrix covariance(BlockId row, BlockId column) const;
  BlockMatrix covariance(BlockId id) const { return covariance(id, id); }
  /// A copy of the whole covariance, both triangles: for tests, entropies once a second, and small maps.
  Eigen::MatrixXd dense_covariance() const;
  /// First error of a block in dense_covariance().
  int offset(BlockId id) const { return block(id).error; }

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

  /// Sets a mean without touching the covariance, e.g. to stop a vehicle that is lost.
  void set_mean(BlockId id, const Eigen::Ref<const Eigen::VectorXd>& mean);

  /// (A.2.1)-(A.2.4). Linear in the size of the state.
  void predict(const AffineMotion& motion);

  /// (A.2.5), (A.2.6) with all looks at once: P <- P - W W' with W = P H' L^-T, S = L L', on one triangle.
  /// An S that is not positive definite to rounding comes back as `singular`, and so does a variance of which
  /// rounding would leave nothing, e.g. a prior 1e16 times the variance of a look; update_joseph() still
  /// takes that one. With dropped correlations looks are used one after the other, and one that would leave
  /// nothing of a variance is left out; `singular` then means that all were.
  UpdateReport update(std::span<const AffineLook> looks);

  /// The same with the Joseph form (A.2.7) on dense matrices: slower, allocates, keeps P positive for any
  /// gain. Not for dropped correlations: throws std::logic_error.
  UpdateReport update_joseph(std::span<const AffineLook> looks);

  /// What update() would add to the errors of some blocks, without doing it: `out` has one vector for each.
  /// False when update() would refuse S. Costs nothing that grows with the map. Not for dropped correlations,
  /// whose looks are used one after the other: throws std::logic_error.
  bool correction(std::span<const AffineLook> looks, std::span<const BlockId> blocks,
                  std::span<BlockVector> out);

  /// One block moves and takes all others along, as landmarks told in the frame of a vehicle do:
  /// its error after = A * error before, that of each other block = A_i * its own + B_i * that of the mover.
  /// Whoever is not among `others` stays. Quadratic in the state; allocates. Not for dropped correlations:
  /// throws std::logic_error.
  struct Carried {
    BlockId block = 0;
    BlockVector x_next;  ///< mean after
    BlockMatrix A;       ///< errors x errors
    BlockMatrix B;       ///< errors x errors of the mover
  };
  void carry(const AffineMotion& mover, std::span<const Carried> others);

  /// Makes the covariance block diagonal, or only the map's part of it (3.28), with the least trace added:
  /// see inflation.hpp. For maps to study: slower than anything else here. The first block is the
  /// vehicle; throws std::logic_error when there is another.
  enum class Scope { everything, map };
  void decorrelate(Scope scope);

  /// Innovation covariance S = H P H' + R of looks, all of them together; sized rows x rows, both triangles.
  /// Costs nothing that grows with the map.
  void innovation_covariance(std::span<const AffineLook> looks, Eigen::MatrixXd& S) const;

  // Who watches
  // -------------------------------------------------------------------------------------------------

  /// Notes what is done from now on; else (as at first) nothing is noted, and nothing spent on it.
  void keep_trace(bool keep);
  bool keeps_trace() const { return trace_.has_value(); }
  /// What was done since the trace was last cleared; empty where none is kept.
  const BeliefTrace& trace() const;
  void clear_trace() {
    if (trace_) trace_->clear();
  }

 private:
  struct Block {
    BlockId id;
    Chart chart;
    int mean;   ///< first number in mean_
    int error;  ///< first error in P
  };
  using Matrix = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  using ConstMatrix = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

  const Block& block(BlockId id) const;
  void reserve(int errors);
  void reserve_rank(int rank);
  BlockId append(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean);
  void shift_offsets_after(std::size_t index, int mean_by, int error_by);
  void remove_errors(int first, int count);
  void gather_above(const LookJacobian& H, const Block& b, double* out) const;
  void gather_below(const LookJacobian& H, const Block& b, int first, int last, double* out) const;
  void gather_PHt(std::span<const AffineLook> looks, int rank);
  /// Rows of all looks; throws when a size does not fit.
  int check(std::span<const AffineLook> looks) const;
  LookJacobian times_covariance(const AffineLook& look, const Block& to) const;
  bool compute_delta(int rank);
  bool factorise_innovation(std::span<const AffineLook> looks, UpdateReport& report);
  void shift_mean(std::span<const double> delta);
  UpdateReport update_dropping(std::span<const AffineLook> looks);
  bool leaves_variances(int rank);
  bool take_look(const AffineLook& look, std::span<double> delta);
  void align_columns(const AffineLook& look);
  void shrink_arrow(int rank);
  void shrink_map(int rank, int column);
  void separate_newborn(const Block& newborn);
  void note(std::span<const AffineLook> looks);
  template <class Event>
  void note(const Event& event) {
    if (trace_) trace_->emplace_back(event);
  }
  template <class Destination>
  void fill_innovation_covariance(std::span<const AffineLook> looks, Destination& S) const;

  /// P with one valid triangle, the lower.
  Matrix P() { return {storage_.data(), errors_, errors_, Eigen::OuterStride<>(stride_)}; }
  ConstMatrix P() const { return {storage_.data(), errors_, errors_, Eigen::OuterStride<>(stride_)}; }
  double entry(int i, int j) const {
    return i >= j ? storage_.data()[i + static_cast<long>(j) * stride_]
                  : storage_.data()[j + static_cast<long>(i) * stride_];
  }

  std::vector<Block> blocks_;
  std::vector<int> index_of_;  ///< by id; -1 when dropped
  std::vector<double> mean_;
  int errors_ = 0;
  int vehicles_ = 0;
  int capacity_ = 0;  ///< errors that fit
  int stride_ = 0;    ///< leading dimension of P
  AlignedBuffer storage_;

  MapCorrelations correlations_ = MapCorrelations::kept;
  std::optional<BeliefTrace> trace_;

  // Workspace of update(), kept so that it allocates nothing
  int rank_capacity_ = 0;
  Eigen::MatrixXd S_;     ///< innovation covariance, then its Cholesky factor
  AlignedBuffer PHt_;     ///< stride x rank
  AlignedBuffer packed_;  ///< W in the panels of rank_update
  Eigen::VectorXd residual_, delta_;
  Eigen::VectorXd norms_;  ///< of one column of W, by block: only where correlations are dropped
};

}  // namespace incognita
