// Cholesky factorization that can be interrupted: of a copy of a covariance, over as many frames as it takes.
//
// The lower triangle is stored in tiles. One step multiplies two tiles or factorizes one, 0.5 million floating-point
// operations at most, so that the time of a call is bounded whatever the size of the matrix.
#pragma once

#include <vector>

#include "incognita/belief/aligned_buffer.hpp"

namespace incognita {

class StateArchive;

class TiledCholesky {
 public:
  static constexpr int tile = 64;  ///< rows and columns of a tile

  /// Makes room for a matrix of `size` rows, whose lower triangle must then be set completely. Allocates only for the
  /// largest matrix so far, and only the tiles that were missing.
  void start(int size);
  int size() const { return size_; }

  /// Sets the elements of a column from row `first` >= `column` on.
  void set_column(int column, int first, const double* values, int count);
  /// Sets one element of the lower triangle.
  void set(int row, int column, double value);

  /// Does at most that many steps. True when the factorization is done or failed; further calls do nothing then.
  bool advance(long steps);
  bool is_done() const { return row_ >= tiles_; }

  /// log-determinant of the leading `rows` x `rows` block, once done; NaN when it is not positive definite.
  double log_det(int rows) const;

  /// Steps of a whole factorization: rows^3 / 6 in tiles.
  static long steps_of(int size);

  /// Saves or restores a factorization that has begun: math/saved_state/.
  void state(StateArchive& archive);

 private:
  double* at(int row, int column) {
    return rows_[static_cast<std::size_t>(row)].data() + column * tile * tile;
  }
  const double* at(int row, int column) const {
    return rows_[static_cast<std::size_t>(row)].data() + column * tile * tile;
  }
  void step();
  bool factorize_diagonal(int row);

  std::vector<AlignedBuffer> rows_;  ///< by row of tiles: its tiles up to the diagonal, column-major
  int size_ = 0;
  int tiles_ = 0;  ///< rows of tiles in use
  // The next step: tile (row, column) minus the product of tiles (row, term) and (column, term)', or its last step
  int row_ = 0, column_ = 0, term_ = 0;
  int positive_ = 0;  ///< leading rows known to be positive definite, once done
};

}  // namespace incognita
