// Matrices of Eigen in the state of a run, and the containers of the standard library that hold state.
#pragma once

#include <Eigen/Core>
#include <cereal/types/array.hpp>
#include <cereal/types/deque.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/utility.hpp>
#include <cereal/types/variant.hpp>
#include <cereal/types/vector.hpp>
#include <cstdint>
#include <string>

#include "incognita/math/saved_state/state_archive.hpp"

namespace incognita {

/// Rows and columns, and the numbers in the order in which they are stored.
template <class S, int R, int C, int O, int MR, int MC>
void save(StateWriter& archive, const Eigen::Matrix<S, R, C, O, MR, MC>& m) {
  const std::int64_t rows = m.rows(), columns = m.cols();
  archive(rows, columns);
  archive.write(m.data(), static_cast<std::size_t>(m.size()) * sizeof(S));
}

template <class S, int R, int C, int O, int MR, int MC>
void load(StateReader& archive, Eigen::Matrix<S, R, C, O, MR, MC>& m) {
  std::int64_t rows = 0, columns = 0;
  archive(rows, columns);
  const auto fits = [](std::int64_t size, int fixed, int most) {
    return size >= 0 && (fixed == Eigen::Dynamic || size == fixed) &&
           (most == Eigen::Dynamic || size <= most);
  };
  constexpr std::int64_t most = 1 << 24;  // their product does not overflow
  if (!fits(rows, R, MR) || !fits(columns, C, MC) || rows > most || columns > most)
    throw DamagedState("a matrix of " + std::to_string(rows) + "x" + std::to_string(columns) + " numbers");
  archive.need(static_cast<std::uint64_t>(rows * columns), sizeof(S));
  m.resize(rows, columns);
  archive.read(m.data(), static_cast<std::size_t>(m.size()) * sizeof(S));
}

}  // namespace incognita
