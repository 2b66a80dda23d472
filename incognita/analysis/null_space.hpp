// Ranks and null spaces of matrices whose rows and columns have different units, decided by singular values
// after scaling, with what decided them; and null spaces as a person would write them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace incognita {

/// Rows of a matrix M to analyse, each with how large its rounding may be.
struct NoisyRows {
  Eigen::MatrixXd rows;   ///< m x n
  Eigen::VectorXd noise;  ///< m: a row no longer than this is nothing but rounding
  bool weighed = false;   ///< lengths of rows mean something: they are not brought to one

  void append(const Eigen::MatrixXd& more, const Eigen::VectorXd& their_noise);
};

struct NullSpaceSettings {
  double tolerance = 1e-9;  ///< singular values below this part of the largest count as 0
  double clear_gap = 1e3;   ///< least ratio of the last that counts to the first that does not
};

struct NullSpace {
  int rank = 0;
  int nullity = 0;
  Eigen::MatrixXd basis;            ///< n x nullity, orthonormal columns
  Eigen::VectorXd singular_values;  ///< of the scaled matrix, the largest first; n of them
  double gap = 0;          ///< last that counts over first that does not; infinite where that is 0 or none
  bool ambiguous = false;  ///< the gap is less than the clear one: the rank is the best guess, and no more

  /// How much of the direction is seen: |M d| of the scaled matrix over the largest singular value, for a
  /// direction of unit length in scaled coordinates. 0 for an unobservable direction.
  double seen(const Eigen::VectorXd& direction) const;
  /// Whether a direction lies in the null space, by the tolerance of the rank.
  bool contains(const Eigen::VectorXd& direction) const;

  Eigen::VectorXd column_scale;  ///< n: what the columns were multiplied by
  Eigen::MatrixXd scaled_null;   ///< n x nullity, orthonormal, in scaled coordinates
  Eigen::MatrixXd scaled_right;  ///< n x n, right singular vectors of the scaled matrix
  double tolerance = 0;          ///< of the rank, relative to the largest singular value
};

/// Every row is brought to length one, then every column: metres, radians and rates of any order weigh alike.
NullSpace null_space(const NoisyRows& rows, const NullSpaceSettings& settings = {});

/// The same space in reduced row-echelon form: sparse, leading with the first states, entries that are
/// rationals of small denominators as small integers. Rows of the result are its vectors.
std::vector<Eigen::VectorXd> readable_basis(const Eigen::MatrixXd& basis);

/// The coordinates in which a vector of the space may be other than zero: whether any has more than
/// `tolerance` there.
std::vector<bool> touched(const Eigen::MatrixXd& basis, double tolerance = 1e-7);

/// A vector as a combination of names: "2 x - y_f1".
std::string written_combination(const Eigen::VectorXd& vector, const std::vector<std::string>& names);

}  // namespace incognita
