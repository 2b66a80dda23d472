// Storage of a symmetric matrix that grows and shrinks: the lower triangle, column-major, aligned and padded
// as rank_update wants it.
#pragma once

#include "incognita/belief/aligned_buffer.hpp"

namespace incognita {

struct Triangle {
  AlignedBuffer storage;
  int capacity = 0;  ///< rows that fit
  int stride = 0;    ///< leading dimension

  /// Room for `size` rows; the first `used` stay. False where there was room enough.
  bool reserve(int size, int used);
  /// Closes the gap of `count` rows and columns; what lies beyond the new size stays finite.
  void remove(int first, int count, int size);

  double* column(int j) { return storage.data() + static_cast<long>(j) * stride; }
  const double* column(int j) const { return storage.data() + static_cast<long>(j) * stride; }
  double entry(int i, int j) const { return i >= j ? column(j)[i] : column(i)[j]; }
};

}  // namespace incognita
