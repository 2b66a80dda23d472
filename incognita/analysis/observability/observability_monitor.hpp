// What the looks of a running filter have told it, by its own Jacobians: the information it would have had it
// started knowing nothing.
//
// A filter's local observability matrix stacks H_0, H_1 Phi_1, H_2 Phi_2, ... at the filter's own estimates;
// what its null space holds the filter cannot learn, and what it should hold and does not the filter believes
// without having seen it (Huang, Mourikis, Roumeliotis, IJRR 2010). Followed here is the information matrix Y
// of vehicle and landmarks that the same motions, looks and births give without any prior. As long as the
// motions can be undone its null space is that of the observability matrix carried to the present, and unlike
// the Gramian over the initial state it says how much the rest weighs: motion noise makes the filter forget,
// which the Gramian leaves out.
//
// Y = V' V + diag(0, L): the rows V of the vehicle, as many as its errors, and L, what is known of the
// landmarks when nothing is known of the vehicle. A motion touches V alone, time linear in the map; looks are
// turned into V by orthogonal transformations, and what is left of them, free of the vehicle, adds to L. No
// information is ever subtracted but when a landmark is forgotten, so that what is not seen stays zero to
// rounding.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <vector>

#include "incognita/analysis/observability/row_sum.hpp"
#include "incognita/belief/trace.hpp"

namespace incognita {

class ObservabilityMonitor {
 public:
  struct Block {
    BlockId id = 0;
    int first = 0;  ///< error
    int errors = 0;
  };

  /// Why what follows is not the filter's information any more.
  enum class Uncovered {
    frame_changed,  ///< all blocks moved with one: a map told in the frame of its vehicle
    decorrelated,   ///< correlations were dropped, variances inflated
    other_block,    ///< another block than the vehicle moved
    not_finite,     ///< a motion or a look has numbers that are not finite
  };

  /// What becomes of motions.
  enum class Motions {
    followed,
    uninformative,  ///< after each the vehicle may be anywhere: what is gained is gained by looks alone
  };

  ObservabilityMonitor(BlockId vehicle, int vehicle_errors, Motions motions = Motions::followed);

  /// Everything that was done, in order. After something that is not covered nothing is followed any more.
  void follow(const BeliefTrace& trace);
  const std::optional<Uncovered>& uncovered() const { return uncovered_; }

  /// What A forgets of the vehicle (as the rates of one that is put at rest, or all of it in the first motion
  /// of an unscented filter that starts exactly) is marginalised out. What the motion puts in its place is a
  /// prior, and no information.
  void move(const LinearizedMotion& motion);
  /// Blocks that were not seen to be born are new, and nothing is known of them.
  void add_measurement(const LinearizedMeasurement& measurement);
  /// A birth is a look at the newborn. Of its errors those that do not depend on any parent were not measured
  /// but assumed, as the depth of a feature seen once: such a guess is no information.
  void augment(const BlockAugmentation& initialization);
  /// A newborn that copies one of the vehicle's first `position_size` errors, its place of birth, is taken to be
  /// sure of it to `sigma` at best: a hair of noise in metres that stands for none would weigh the more the
  /// longer the scene is in metres, until nothing but rounding is left of the rest.
  void set_exact_position(int position_size, double sigma) {
    position_size_ = position_size;
    exact_position_sigma_ = sigma;
  }
  /// What is known of the old block, told of the new one. Where the new one has noise of its own nothing is
  /// taken to be known of it.
  void replace(const BlockReplacement& replacement);
  /// What was learnt through the block about others stays.
  void drop(BlockId id);

  int errors() const { return static_cast<int>(V_.cols()); }
  /// The vehicle, then the landmarks in the order of their births.
  /// Rows of looks that are kept to be taken in together: a few tens at most, however long nothing moves.
  int waiting_rows() const { return row_count_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const Block* find(BlockId id) const;
  /// Y: errors() x errors(), both triangles.
  Eigen::MatrixXd information();
  /// By error: the sum of squares of all that was ever added for it, also of what is forgotten by now. That
  /// much was rounded.
  Eigen::VectorXd gathered();

 private:
  /// So many rows of a look, whitened, at so many errors.
  struct Part {
    int row;    ///< among those that wait
    int first;  ///< error
    MeasurementJacobian H;
  };
  int vehicle_errors() const { return blocks_.front().errors; }
  const Block& find_or_add(BlockId id, int errors);
  void add_rows(const std::vector<Part>& parts, const MeasurementMatrix& R);
  void absorb_rows();
  void put_rows(Eigen::MatrixXd rows);
  void apply_motion();
  void put_motion(const Eigen::MatrixXd& before, const Eigen::MatrixXd& F);
  void forget(const Eigen::MatrixXd& directions);
  Eigen::MatrixXd take_rows_of(int first, int count);
  void eliminate(int first, int count);
  void transform_block(int first, int count, const Eigen::MatrixXd& C);
  void remove_columns(int first, int count);
  void shrink(const Block& block, int by);

  Motions motions_;
  std::vector<Block> blocks_;
  std::unordered_map<BlockId, std::size_t> index_of_;  ///< of the blocks there are
  Eigen::MatrixXd V_;                                  ///< vehicle errors x errors
  RowSum L_;                                           ///< landmark errors x landmark errors
  Eigen::VectorXd added_;                              ///< to the diagonal of L, ever
  std::vector<Part> pending_;                          ///< looks that wait to be absorbed
  int row_count_ = 0;                                  ///< their rows
  bool moved_ = false;                                 ///< A_ and N_ are to be applied
  BlockMatrix A_, N_;
  int position_size_ = 0;  ///< see set_exact_position()
  double exact_position_sigma_ = 0;
  std::optional<Uncovered> uncovered_;
};

}  // namespace incognita
