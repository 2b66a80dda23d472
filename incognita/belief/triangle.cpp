#include "incognita/belief/triangle.hpp"

#include <algorithm>
#include <utility>

#include "incognita/belief/rank_update.hpp"

namespace incognita {

bool Triangle::reserve(int size, int used) {
  if (size <= capacity) return false;
  Triangle grown;
  grown.capacity = std::max(size, capacity + capacity / 2);
  grown.stride = round_up_to_panel(grown.capacity);
  if (grown.stride % 512 == 0) grown.stride += 8;  // power-of-two strides share cache sets
  grown.storage = AlignedBuffer(static_cast<std::size_t>(grown.stride) * (grown.capacity + 3));
  for (int j = 0; j < used; ++j) std::copy(column(j) + j, column(j) + used, grown.column(j) + j);
  *this = std::move(grown);
  return true;
}

void Triangle::remove(int first, int count, int size) {
  for (int j = 0; j < size; ++j) {
    if (j >= first && j < first + count) continue;
    const int below = std::max(first + count, j);  // the upper triangle is not used
    std::copy(column(j) + below, column(j) + size, column(j < first ? j : j - count) + below - count);
  }
}

}  // namespace incognita
