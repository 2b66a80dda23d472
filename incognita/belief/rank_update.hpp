// The filter's heaviest loops: P <- P - W W' on one triangle, and W.
#pragma once

#include <span>

namespace incognita {

/// Rows of a packed panel; storage passed to rank_update must be padded to a multiple of it.
inline constexpr int rank_update_panel = 8;

constexpr int round_up_to_panel(int n) {
  return (n + rank_update_panel - 1) / rank_update_panel * rank_update_panel;
}

/// Lower triangle of P <- P - W W'.
///
/// P: column-major, leading dimension `stride` (a multiple of 8, >= round_up_to_panel(n)), 64-byte aligned.
/// W: n x rank in panels: element (i, k) at W[panel_index(i, k, rank)], 64-byte aligned, and rows
/// from n up to the next multiple of 8 zero. Above the diagonal, P is scratch within 8 x 8 tiles. The widest
/// vector unit of the processor is chosen at run time; each gives the same result up to rounding, and the
/// same processor always the same bytes.
void rank_update(double* P, int stride, int n, const double* W, int rank);

/// Where an element of W or L is in panels.
inline long panel_index(int row, int column, int rank) {
  constexpr int lanes = rank_update_panel;
  return static_cast<long>(row / lanes) * lanes * rank + static_cast<long>(column) * lanes + row % lanes;
}

/// W = A L^-T into the panels of rank_update: A is n x rank with leading dimension `stride`, aligned and
/// padded like P with zeros, L lower triangular, column-major with leading dimension `L_stride`. Behind W
/// there is room for L in panels, too: round_up_to_panel(rank) x rank numbers.
void whiten(const double* A, int stride, int n, const double* L, int L_stride, int rank, double* W);

/// One build of the loops, for one instruction set.
struct RankUpdatePath {
  void (*run)(double* P, int stride, int n, const double* W, int rank);
  void (*whiten)(const double* A, int stride, int n, const double* L_panels, int rank, double* W);
  const char* name;  ///< "avx512", "avx2" or "baseline"
};

/// The paths this processor can run, the one in use first: for tests and benchmarks.
std::span<const RankUpdatePath> rank_update_paths();

/// Name of the path in use.
const char* rank_update_path();

}  // namespace incognita
