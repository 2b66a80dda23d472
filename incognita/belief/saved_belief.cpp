// The state of the belief. Members that are workspace, or follow from others, are not saved.
#include <algorithm>
#include <string>

#include "incognita/belief/any_belief.hpp"
#include "incognita/belief/tiled_cholesky.hpp"
#include "incognita/math/saved_state/matrices.hpp"

namespace incognita {
namespace {

constexpr int largest_state = 1 << 17;  // errors: its covariance would take more memory than there is

}  // namespace

/// Capacity and content decide how it grows: a restored belief does so at the same tick.
void Triangle::state(StateArchive& archive, int used) {
  int saved = capacity;
  archive(saved);
  if (saved < used || saved > largest_state)
    throw DamagedState("a covariance of " + std::to_string(used) + " errors with room for " +
                       std::to_string(saved));
  if (archive.restores()) {
    *this = {};
    reserve(saved, 0);
  }
  for (int j = 0; j < used; ++j) archive.numbers(column(j) + j, static_cast<std::size_t>(used - j));
}

/// Each block by its id and chart; where its numbers stand follows from the order.
void StateLayout::layout_state(StateArchive& archive) {
  auto& [blocks, index_of, mean, errors, vehicles, trace] = *this;
  std::uint32_t ids = static_cast<std::uint32_t>(index_of.size()),
                count = static_cast<std::uint32_t>(blocks.size());
  archive(ids, count, vehicles, mean);
  if (archive.restores()) {
    if (count > ids || ids > (1u << 30) || vehicles < 0 || vehicles > static_cast<int>(count))
      throw DamagedState("a belief of " + std::to_string(count) + " blocks");
    blocks.assign(count, Block{0, Chart{}, 0, 0});
    index_of.assign(ids, -1);
    errors = 0;
    trace.reset();
  }
  std::size_t numbers = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    Block& block = blocks[i];
    archive(block.id, block.chart);
    if (!archive.restores()) continue;
    if (block.id >= ids || index_of[block.id] >= 0 || block.chart.ambient() > max_block_size)
      throw DamagedState("block " + std::to_string(block.id) + " of a belief");
    index_of[block.id] = static_cast<int>(i);
    block.mean = static_cast<int>(numbers);
    block.error = errors;
    numbers += static_cast<std::size_t>(block.chart.ambient());
    errors += block.chart.tangent();
  }
  if (archive.restores() && (numbers != mean.size() || errors > largest_state))
    throw DamagedState("a belief of " + std::to_string(numbers) + " numbers with " +
                       std::to_string(mean.size()) + " means");
}

void Belief::state(StateArchive& archive) {
  if (archive.restores()) *this = Belief();
  layout_state(archive);
  archive(correlations_);
  P_.state(archive, errors_);
  if (archive.restores())
    delta_.resize(P_.capacity);  // as reserve() does; the other workspace grows with its use
}

void InformationBelief::state(StateArchive& archive) {
  if (archive.restores()) *this = InformationBelief();
  layout_state(archive);
  information_.state(archive, errors_);
  if (!archive.restores()) return;
  size_workspace();
  changed();
}

void AnyBelief::state(StateArchive& archive) {
  bool is_information = std::holds_alternative<InformationBelief>(form_);
  archive(is_information);
  if (archive.restores() && is_information) form_.emplace<InformationBelief>();
  if (archive.restores() && !is_information) form_.emplace<Belief>();
  std::visit([&](auto& belief) { belief.state(archive); }, form_);
}

void TiledCholesky::state(StateArchive& archive) {
  int size = size_;
  archive(size);
  if (archive.restores()) {
    if (size < 0 || size > largest_state) throw DamagedState("a matrix of " + std::to_string(size) + " rows");
    start(size);
  }
  archive(row_, column_, term_, positive_);
  if (row_ < 0 || row_ > tiles_ || column_ < 0 || column_ > row_ || term_ < 0 || term_ > column_ ||
      positive_ < 0 || positive_ > size_)
    throw DamagedState("a factorization at row " + std::to_string(row_));
  for (int row = 0; row < tiles_; ++row)
    archive.numbers(rows_[static_cast<std::size_t>(row)].data(),
                    static_cast<std::size_t>(row + 1) * tile * tile);
}

}  // namespace incognita
