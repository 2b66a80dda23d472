// Ranks and null spaces of matrices whose rows and columns have different units, decided by singular values
// after scaling, with what decided them; and null spaces as a person would write them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace incognita {

/// Rows of a matrix M to analyse, each entry with how large its rounding may be.
struct NoisyRows {
  Eigen::MatrixXd rows;     ///< m x n
  Eigen::MatrixXd noise;    ///< m x n: an entry no larger than this is nothing but rounding
  bool weighed = false;     ///< lengths of rows mean something: they are not brought to one
  std::vector<bool> faint;  ///< n, or none: columns that rows no longer here had only rounding in, it seems

  static NoisyRows exact(const Eigen::MatrixXd& rows);
  void append(const NoisyRows& more);
  /// At most n rows with the same ranks and null space, those of length one where they are not weighed: to
  /// carry on with instead of these.
  NoisyRows condensed() const;
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
  double least = 0;        ///< last that counts over the largest; 0 where none does
  bool ambiguous = false;  ///< the gap is less than the clear one: the rank is the best guess, and no more
  std::vector<bool>
      faint;  ///< n: columns whose entries are as small as rounding, and left out; ambiguous too

  /// How much of the direction is seen: |M d| of the scaled matrix over the largest singular value, for a
  /// direction of unit length in scaled coordinates. 0 for an unobservable direction.
  double observed_share(const Eigen::VectorXd& direction) const;
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
/// rationals of small denominators as small integers. As many vectors as the nullity.
std::vector<Eigen::VectorXd> readable_basis(const NullSpace& space);

/// The coordinates in which a vector of the space may be other than zero: whether any has more than
/// `tolerance` there.
std::vector<bool> touched(const Eigen::MatrixXd& basis, double tolerance = 1e-7);

/// A vector as a combination of names: "2 x - y_f1".
std::string written_combination(const Eigen::VectorXd& vector, const std::vector<std::string>& names);

}  // namespace incognita
