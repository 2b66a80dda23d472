// The state of the observability monitor.
#include <algorithm>
#include <map>
#include <string>

#include "incognita/analysis/observability/observability_monitor.hpp"
#include "incognita/math/saved_state/matrices.hpp"

namespace incognita {

/// The lower triangle, as Belief does.
void RowSum::state(StateArchive& archive) {
  auto& [size, capacity, stride, minus, packed] = *this;
  int saved_size = size, saved_capacity = capacity;
  archive(saved_size, saved_capacity);
  if (archive.restores()) {
    constexpr int largest = 1 << 17;
    if (saved_size < 0 || saved_capacity < saved_size || saved_capacity > largest)
      throw DamagedState("information about " + std::to_string(saved_size) + " errors");
    *this = {};
    reserve(saved_capacity);
    size = saved_size;
  }
  for (int j = 0; j < size; ++j)
    archive.numbers(minus.data() + static_cast<long>(j) * stride + j, static_cast<std::size_t>(size - j));
}

void ObservabilityMonitor::Part::state(StateArchive& archive) {
  auto& [row_, first_, H_] = *this;
  archive(row_, first_, H_);
}

void ObservabilityMonitor::Motion::state(StateArchive& archive) {
  auto& [moved_, A_, N_] = *this;
  archive(moved_, A_, N_);
}

template <AnyStateArchive Archive>
void serialize(Archive& archive, ObservabilityMonitor::Block& block) {
  auto& [id, first, errors] = block;
  archive(id, first, errors);
}

void ObservabilityMonitor::state(StateArchive& archive) {
  auto& [motions, vehicle_errors, blocks, index_of, V, L, added, noises, pending, row_count, moved,
         position_size, exact_position_sigma, uncovered] = *this;
  std::map<BlockId, BlockMatrix> ordered(noises.begin(), noises.end());
  archive(motions, vehicle_errors, blocks, V, L, added, ordered, pending, row_count, moved, position_size,
          exact_position_sigma, uncovered);
  if (!archive.restores()) return;
  noises = {ordered.begin(), ordered.end()};
  index_of.clear();
  for (std::size_t i = 0; i < blocks.size(); ++i) index_of[blocks[i].id] = i;
  const bool fits = vehicle_errors >= 0 && V.rows() == vehicle_errors &&
                    V.cols() == vehicle_errors + L.size() && added.size() == L.size() &&
                    moved.size() <= blocks.size() && std::ranges::all_of(blocks, [&](const Block& block) {
                      return block.first >= 0 && block.errors >= 0 && block.first + block.errors <= V.cols();
                    });
  if (!fits) throw DamagedState("the information of a monitor");
}

}  // namespace incognita
