// Information that a running filter gains from its measurements, by its own Jacobians: its information matrix
// without any prior.
//
// A filter's local observability matrix stacks H_0, H_1 Phi_1, H_2 Phi_2, ... at the filter's own estimates.
// Its null space is what the filter cannot observe; truly unobservable directions missing from it receive
// spurious information (Huang, Mourikis, Roumeliotis, IJRR 2010). The monitor maintains the information
// matrix Y of vehicle and landmarks that the same motions, measurements and landmark initializations yield
// without any prior. As long as the motions are invertible, its null space is that of the observability
// matrix transformed to the present. Unlike the Gramian over the initial state, it also weighs the rest:
// motion noise makes the filter forget, which the Gramian leaves out.
//
// Y = V' V + diag(0, L): V has as many rows as the vehicles have errors, and L is the information about the
// landmarks when nothing is known of the vehicles. The motion of one is a motion of all in which the others stay. A motion changes only V, in time linear in the map;
// measurements are reduced to V by orthogonal transformations, and the remaining rows, free of the vehicle,
// are added to L. Information is subtracted only when a landmark is marginalized out, so unobservable
// directions stay zero to rounding.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

#include "incognita/analysis/observability/row_sum.hpp"
#include "incognita/belief/trace.hpp"

namespace incognita {

class StateArchive;

class ObservabilityMonitor {
 public:
  struct Block {
    BlockId id = 0;
    int first = 0;  ///< index of its first error
    int errors = 0;
  };

  /// Why the monitored information is no longer that of the filter.
  enum class Uncovered {
    frame_changed,  ///< all blocks changed together: a map expressed in the vehicle frame
    decorrelated,   ///< correlations were dropped, or variances inflated
    other_block,  ///< a block other than a vehicle moved, or the errors of a vehicle were replaced by fewer or uncertain ones
    not_finite,  ///< a motion or measurement has numbers that are not finite
  };

  /// Treatment of motions.
  enum class Motions {
    followed,
    uninformative,  ///< each motion has infinite noise: information comes from measurements only
  };

  struct Vehicle {
    BlockId block = 0;
    int errors = 0;
  };
  explicit ObservabilityMonitor(const std::vector<Vehicle>& vehicles, Motions motions = Motions::followed);
  ObservabilityMonitor(BlockId vehicle, int errors, Motions motions = Motions::followed)
      : ObservabilityMonitor(std::vector<Vehicle>{{vehicle, errors}}, motions) {}

  /// Takes a block as noise of the measurements that depend on it, independent in each, of this covariance: errors of matches
  /// that last. The information is then more than that of the filter, but about the same directions.
  void treat_as_noise(BlockId block, const BlockMatrix& covariance) { noises_[block] = covariance; }

  /// Processes all recorded operations in order; stops after one that is not covered.
  void follow(const BeliefTrace& trace);
  const std::optional<Uncovered>& uncovered() const { return uncovered_; }

  /// Components of a vehicle that A discards are marginalized out (e.g. the rates of one put at rest, or
  /// everything in the first motion of an unscented filter with an exact start). Their new values are a
  /// prior, which is no information.
  void move(const LinearizedMotion& motion);
  /// Blocks whose initialization was not recorded are added with zero information.
  void add_measurement(const LinearizedMeasurement& measurement);
  /// A landmark initialization is a measurement of the new landmark. Its errors that depend on no parent,
  /// such as the depth of a feature seen once, were assumed and not measured, so they carry no information.
  void augment(const BlockAugmentation& initialization);
  /// Limits the confidence in a new landmark that copies one of the first vehicle's first `position_size` errors,
  /// its position at initialization, to `sigma`. A regularization of fixed size in meters would dominate
  /// large scenes numerically, so it must scale with the scene.
  void set_exact_position(int position_size, double sigma) {
    position_size_ = position_size;
    exact_position_sigma_ = sigma;
  }
  /// Transforms the information about the old block to the new one. If the new one has noise of its own, it
  /// starts with zero information.
  void replace(const BlockReplacement& replacement);
  /// Transforms the information about landmarks to errors that have a part of the vehicle's error added.
  void shear(const BlockShear& shear);
  /// Marginalizes the block out; the information it provided about others remains.
  void drop(BlockId id);

  int errors() const { return static_cast<int>(V_.cols()); }
  /// Number of measurement rows that wait to be absorbed together; at most a few tens, however long nothing moves.
  int waiting_rows() const { return row_count_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const Block* find(BlockId id) const;
  /// Y: errors() x errors(), both triangles, ordered as blocks(): the vehicles, then the landmarks in order of
  /// initialization.
  Eigen::MatrixXd information();
  /// Per error: sum of squares of everything ever added, including what was forgotten; bounds the rounding error.
  Eigen::VectorXd gathered();

  /// Saves or restores: math/saved_state/.
  void state(StateArchive& archive);

 private:
  /// Whitened rows of a measurement with respect to one block.
  struct Part {
    int row;    ///< among the pending rows
    int first;  ///< index of the first error
    MeasurementJacobian H;
    void state(StateArchive& archive);
  };
  int vehicle_errors() const { return vehicle_errors_; }
  bool is_vehicle(const Block& block) const { return block.first < vehicle_errors_; }
  const Block& find_or_add(BlockId id, int errors);
  void add_rows(const std::vector<Part>& parts, const MeasurementMatrix& R);
  void absorb_rows();
  void put_rows(Eigen::MatrixXd rows);
  void apply_motion();
  void replace_vehicle(const Block& block, const BlockReplacement& replacement);
  void put_motion(const Eigen::MatrixXd& before, const Eigen::MatrixXd& F);
  void forget(const Eigen::MatrixXd& directions);
  Eigen::MatrixXd take_rows_of(int first, int count);
  void eliminate(int first, int count);
  void transform_block(int first, int count, const Eigen::MatrixXd& C);
  void remove_columns(int first, int count);
  void shrink(const Block& block, int by);

  Motions motions_;
  int vehicle_errors_ = 0;  ///< of all vehicles, whose blocks come first
  std::vector<Block> blocks_;
  std::unordered_map<BlockId, std::size_t> index_of_;  ///< index in blocks_
  Eigen::MatrixXd V_;                                  ///< errors of the vehicles x errors
  RowSum L_;                                           ///< landmark errors x landmark errors
  Eigen::VectorXd added_;                              ///< total ever added to the diagonal of L
  std::unordered_map<BlockId, BlockMatrix> noises_;    ///< treat_as_noise()
  std::vector<Part> pending_;                          ///< measurements not absorbed yet
  int row_count_ = 0;                                  ///< their rows
  /// A motion of one vehicle that is still to be applied.
  struct Motion {
    bool moved = false;
    BlockMatrix A, N;
    void state(StateArchive& archive);
  };
  std::vector<Motion> moved_;  ///< per vehicle
  int position_size_ = 0;      ///< see set_exact_position()
  double exact_position_sigma_ = 0;
  std::optional<Uncovered> uncovered_;
};

}  // namespace incognita
