// The belief in information form: the inverse of the covariance, over the same blocks and through the same
// narrow waist as belief.hpp, with the same answers.
//
// What is kept is the information matrix, and the information vector about the means: 0 between updates,
// since an update adds H' R^-1 residual to it, solves for the errors and moves the means by them, each in its
// chart. Looks cost only what they are from and at, however many there are; then one Cholesky factorisation,
// the cube of the state, gives means and covariances. To predict, to drop and to replace marginalise:
// quadratic in the state. Whoever is known exactly has infinite information, and can not be told here.
//
// Covariances are computed when first asked for and kept until the next change: two threads must not ask the
// same belief at once.
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
  /// Covariance between two blocks' errors; not a number where the information is not positive definite
  /// within rounding.
  BlockMatrix covariance(BlockId row, BlockId column) const;
  BlockMatrix covariance(BlockId id) const { return covariance(id, id); }
  Eigen::MatrixXd dense_covariance() const;
  Eigen::MatrixXd dense_information() const;

  /// Logarithms of the determinants of the covariance: of its first errors, of the others, of all. Not a
  /// number where the information is not positive definite within rounding.
  struct LogDeterminants {
    double first = 0, others = 0, all = 0;
  };
  LogDeterminants log_determinants(int first) const;

  // What can happen to it, as in belief.hpp
  // ----------------------------------------------------------------------------------------- All throw
  // std::invalid_argument, with the sizes, when sizes do not fit, or with the reason, where information would
  // be infinite; the belief is unchanged then.

  /// The covariance must be positive definite. Throws std::logic_error when there are landmarks already.
  BlockId add_vehicle(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                      const Eigen::Ref<const Eigen::MatrixXd>& covariance);
  /// The noise must be positive definite.
  BlockId augment(const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
                  std::span<const BlockParent> parents, const Eigen::Ref<const Eigen::MatrixXd>& noise);
  /// J J' + noise must be positive definite: neither alone needs to be.
  void replace(BlockId id, const Chart& chart, const Eigen::Ref<const Eigen::VectorXd>& mean,
               const BlockMatrix& J, const BlockMatrix& noise);
  void drop(BlockId id);
  /// A A' + N must be positive definite: neither alone needs to be.
  void predict(const LinearizedMotion& motion);
  UpdateReport update(std::span<const LinearizedMeasurement> measurements);
  bool correction(std::span<const LinearizedMeasurement> measurements, std::span<const BlockId> blocks,
                  std::span<BlockVector> out);
  void innovation_covariance(std::span<const LinearizedMeasurement> measurements, Eigen::MatrixXd& S) const;

 private:
  void reserve(int errors);
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
  std::vector<LinearizedMeasurement> white_;  ///< looks whose noise is of unit covariance
  Eigen::VectorXd delta_;
  AlignedBuffer cross_;   ///< information between all errors and those that are marginalised out
  AlignedBuffer packed_;  ///< the same, as rank_update takes it
};

}  // namespace incognita
