// The most expensive loops of the filter: P <- P - W W' on one triangle, and W.
#pragma once

#include <span>

namespace incognita {

/// Rows of a packed panel; the storage passed to rank_update is padded to a multiple of it.
inline constexpr int rank_update_panel = 8;

constexpr int round_up_to_panel(int n) {
  return (n + rank_update_panel - 1) / rank_update_panel * rank_update_panel;
}

/// Lower triangle of P <- P - W W'.
///
/// P: column-major, leading dimension `stride` (a multiple of 8, >= round_up_to_panel(n)), 64-byte aligned.
/// Above the diagonal it is scratch within 8 x 8 tiles.
/// W: n x rank in panels, element (i, k) at W[panel_index(i, k, rank)], 64-byte aligned, rows from n up to
/// the next multiple of 8 zero.
///
/// The widest vector unit of the processor is chosen at run time. Instruction sets agree up to rounding; on
/// one processor results are bitwise reproducible.
void rank_update(double* P, int stride, int n, const double* W, int rank);

/// Index of an element of W or L in the panel layout.
inline long panel_index(int row, int column, int rank) {
  constexpr int lanes = rank_update_panel;
  return static_cast<long>(row / lanes) * lanes * rank + static_cast<long>(column) * lanes + row % lanes;
}

/// W = A L^-T, in the panel layout of rank_update. A: n x rank with leading dimension `stride`, aligned and
/// zero-padded like P. L: lower triangular, column-major, leading dimension `L_stride`. The storage of W must
/// have another round_up_to_panel(rank) x rank doubles at its end, for L in panels.
void whiten(const double* A, int stride, int n, const double* L, int L_stride, int rank, double* W);

/// The loops compiled for one instruction set.
struct RankUpdatePath {
  void (*run)(double* P, int stride, int n, const double* W, int rank);
  void (*whiten)(const double* A, int stride, int n, const double* L_panels, int rank, double* W);
  const char* name;  ///< "avx512", "avx2" or "baseline"
};

/// The paths this processor supports, the one in use first: for tests and benchmarks.
std::span<const RankUpdatePath> rank_update_paths();

/// Name of the path in use.
const char* rank_update_path();

}  // namespace incognita
