// The belief in information form: the inverse of the covariance over the same blocks, with the interface of
// belief.hpp and the same results.
//
// The stored quantities are the information matrix and the means. The information vector about the means is 0
// between updates: an update adds H' R^-1 residual, solves for the errors and applies them to the means in
// their charts. A measurement costs only its own blocks; one Cholesky factorization per update, cubic in the
// state, then gives means and covariances. predict(), drop() and replace() marginalize, quadratic in the
// state. A zero-variance error has infinite information and cannot be represented in this form.
//
// Covariances are computed on first access and cached until the next change: concurrent reads of one belief
// are not thread-safe.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "incognita/belief/aligned_buffer.hpp"
#include "incognita/belief/linearized.hpp"
#include "incognita/belief/reverse_factor.hpp"
#include "incognita/belief/state_layout.hpp"
#include "incognita/belief/triangle.hpp"
#include "incognita/belief/update_report.hpp"

namespace incognita {

class InformationBelief : public StateLayout {
 public:
  /// Cross covariance of two blocks' errors; NaN when the information is not positive definite within rounding.
  BlockMatrix covariance(BlockId row, BlockId column) const;
  BlockMatrix covariance(BlockId id) const { return covariance(id, id); }
  Eigen::MatrixXd dense_covariance() const;
  Eigen::MatrixXd dense_information() const;

  /// Log-determinants of the covariance: of its first errors, of the others, of all. NaN when the information
  /// is not positive definite within rounding.
  struct LogDeterminants {
    double first = 0, others = 0, all = 0;
  };
  LogDeterminants log_determinants(int first) const;

  // Operations, as in belief.hpp. All throw std::invalid_argument when sizes do not fit (with the sizes) or
  // when the information would be infinite (with the reason); the belief is unchanged then.

  /// The covariance must be positive definite. Throws std::logic_error once there are landmarks.
  BlockId add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                      const Eigen::Ref<const Eigen::MatrixXd>& covariance);
  /// The noise must be positive definite.
  BlockId augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                  std::span<const BlockParent> parents, const Eigen::Ref<const Eigen::MatrixXd>& noise);
  /// J J' + noise must be positive definite; the noise alone need not be.
  void replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
               const BlockMatrix& J, const BlockMatrix& noise);
  void drop(BlockId id);
  /// A A' + N must be positive definite; N alone need not be.
  void predict(const LinearizedMotion& motion);
  UpdateReport update(std::span<const LinearizedMeasurement> measurements);
  bool correction(std::span<const LinearizedMeasurement> measurements, std::span<const BlockId> blocks,
                  std::span<BlockVector> out);
  void innovation_covariance(std::span<const LinearizedMeasurement> measurements, Eigen::MatrixXd& S) const;

  /// Saves or restores all but the trace: math/saved_state/.
  void state(StateArchive& archive);

 private:
  void reserve(int errors);
  void size_workspace();
  BlockId append_independent(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                             const BlockMatrix& own, bool vehicle);
  BlockMatrix own_information(const Block& b) const;
  void transform(const Block& b, const BlockMatrix& J, const BlockMatrix& noise);
  template <class Cross>
  void fill_cross(const Block& b, int columns, const Cross& cross);
  void marginalize(const BlockMatrix& own);
  bool whiten_measurements(std::span<const LinearizedMeasurement> measurements, UpdateReport& report);
  bool solve(std::span<const LinearizedMeasurement> measurements, UpdateReport& report);
  template <class Add>
  void add_measurements(const Add& add) const;
  const ReverseFactor* factor() const;
  void changed() { factor_known_ = false; }

  Triangle information_;

  mutable ReverseFactor factor_;  ///< of information_
  mutable bool factor_known_ = false, factor_positive_ = false;

  // Workspace
  ReverseFactor posterior_;
  std::vector<LinearizedMeasurement> white_;  ///< measurements scaled to unit noise covariance
  Eigen::VectorXd delta_;
  AlignedBuffer cross_;   ///< information between all errors and the marginalized ones
  AlignedBuffer packed_;  ///< the same in the panel layout of rank_update
};

}  // namespace incognita
