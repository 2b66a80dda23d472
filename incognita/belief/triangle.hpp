// Growable storage of a symmetric matrix: the lower triangle, column-major, aligned and padded for rank_update.
#pragma once

#include "incognita/belief/aligned_buffer.hpp"

namespace incognita {

class StateArchive;

struct Triangle {
  AlignedBuffer storage;
  int capacity = 0;  ///< maximum rows
  int stride = 0;    ///< leading dimension

  /// Grows the storage to at least `size` rows, keeping the first `used`. False when it was large enough already.
  bool reserve(int size, int used);
  /// Removes `count` rows and columns; the content beyond the new size stays finite.
  void remove(int first, int count, int size);

  /// Saves or restores the first `used` rows: math/saved_state/.
  void state(StateArchive& archive, int used);

  double* column(int j) { return storage.data() + static_cast<long>(j) * stride; }
  const double* column(int j) const { return storage.data() + static_cast<long>(j) * stride; }
  double entry(int i, int j) const { return i >= j ? column(j)[i] : column(i)[j]; }
};

}  // namespace incognita
