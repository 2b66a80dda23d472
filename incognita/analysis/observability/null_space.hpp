// Ranks and null spaces of matrices with mixed units, by singular values after scaling, with the values that
// determined them; and null spaces in readable form.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace incognita {

/// Rows of a matrix M, with a bound of the rounding error of each entry.
struct NoisyRows {
  Eigen::MatrixXd rows;   ///< m x n
  Eigen::MatrixXd noise;  ///< m x n: entries not larger than this are rounding
  bool weighed = false;   ///< row lengths are meaningful: rows are not normalized
  /// n, or empty: columns in which rows that were removed had nothing but apparent rounding
  std::vector<bool> faint;

  static NoisyRows exact(const Eigen::MatrixXd& rows);
  void append(const NoisyRows& more);
  /// At most n rows with the same ranks and null space, normalized unless weighed, to continue with instead of these.
  NoisyRows condensed() const;
};

struct NullSpaceSettings {
  double tolerance = 1e-9;  ///< singular values below this fraction of the largest count as 0
  double clear_gap = 1e3;   ///< smallest unambiguous ratio of the last counted to the first uncounted value
};

struct NullSpace {
  int rank = 0;
  int nullity = 0;
  Eigen::MatrixXd basis;            ///< n x nullity, orthonormal columns
  Eigen::VectorXd singular_values;  ///< singular values of the scaled matrix, decreasing; n of them
  double gap = 0;           ///< last counted over first uncounted; infinite if that is 0 or there is none
  double least = 0;         ///< last counted over the largest; 0 if none counts
  bool ambiguous = false;   ///< the gap is below clear_gap: the rank is only a best guess
  std::vector<bool> faint;  ///< n: columns at rounding level, left out; also ambiguous

  /// |M d| of the scaled matrix over the largest singular value, for a unit direction in scaled coordinates:
  /// 0 for an unobservable direction.
  double observed_share(const Eigen::VectorXd& direction) const;
  /// Whether a direction lies in the null space, by the tolerance of the rank.
  bool contains(const Eigen::VectorXd& direction) const;

  Eigen::VectorXd column_scale;  ///< n: factors of the columns
  Eigen::MatrixXd scaled_null;   ///< n x nullity, orthonormal, in scaled coordinates
  Eigen::MatrixXd scaled_right;  ///< n x n, right singular vectors of the scaled matrix
  double tolerance = 0;          ///< tolerance of the rank, relative to the largest singular value
};

/// Scales every row to length one, then every column, so that meters, radians and rates of any order have
/// equal weight.
NullSpace null_space(const NoisyRows& rows, const NullSpaceSettings& settings = {});

/// The same space in reduced row-echelon form: sparse, with leading entries in the first states; rationals of
/// small denominators become small integers. Its size is the nullity.
std::vector<Eigen::VectorXd> readable_basis(const NullSpace& space);

/// For each coordinate, whether any vector of the basis exceeds `tolerance` there.
std::vector<bool> touched(const Eigen::MatrixXd& basis, double tolerance = 1e-7);

/// Writes a vector as a combination of names: "2 x - y_f1".
std::string written_combination(const Eigen::VectorXd& vector, const std::vector<std::string>& names);

}  // namespace incognita
