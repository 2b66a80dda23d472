// rank_update and whiten for one instruction set. The including source file defines the namespace (PATH), the
// doubles per vector register (LANES), and the columns (COLUMNS, a divisor of 8) and panels of 8 rows
// (PANELS) of a tile. No library header is used, so that no inline function compiled for a newer processor
// can end up in the rest of the program.
//
// A tile of 8 PANELS rows x COLUMNS columns stays in registers while k runs over the rank. It is as large as the
// registers allow: each further column saves one load of W, and each further panel one of the factors. Large ranks
// are split so that two panels fit the L1 cache, and the rows of W are split into bands that fit the L2 cache.

namespace incognita::INCOGNITA_RANK_UPDATE_PATH {

typedef double Vector __attribute__((vector_size(8 * INCOGNITA_RANK_UPDATE_LANES)));

constexpr int panel = 8, columns = INCOGNITA_RANK_UPDATE_COLUMNS, panels = INCOGNITA_RANK_UPDATE_PANELS;
constexpr int deepest = 192, band_doubles = 1 << 15;

/// P -= W W' on a tile of `height` panels, over `depth` columns of W. Only the first `width` columns of the
/// tile exist.
template <int height>
inline void subtract_tile(double* P, long stride, const double* rows, const double* factors, long panel_step,
                          int depth, int width) {
  constexpr int vectors = panel / INCOGNITA_RANK_UPDATE_LANES * height, each = vectors / height;
  Vector sum[columns][vectors] = {};
  for (int k = 0; k < depth; ++k) {
    Vector w[vectors];
#pragma GCC unroll 16
    for (int v = 0; v < vectors; ++v)
      w[v] = reinterpret_cast<const Vector*>(rows + v / each * panel_step + panel * k)[v % each];
#pragma GCC unroll 16
    for (int c = 0; c < columns; ++c)
#pragma GCC unroll 16
      for (int v = 0; v < vectors; ++v) sum[c][v] += w[v] * factors[panel * k + c];
  }
#pragma GCC unroll 16
  for (int c = 0; c < columns; ++c) {
    if (c >= width) break;
    Vector* p = reinterpret_cast<Vector*>(P + c * stride);
#pragma GCC unroll 16
    for (int v = 0; v < vectors; ++v) p[v] -= sum[c][v];
  }
}

void rank_update(double* P, int stride, int n, const double* W, int rank) {
  constexpr int tile = panel * panels;
  for (int k = 0; k < rank; k += deepest) {
    const int depth = rank - k < deepest ? rank - k : deepest;
    const int fitting = band_doubles / depth, band = fitting < tile ? tile : fitting / tile * tile;
    for (int first = 0; first < n; first += band) {
      const int last = n - first < band ? n : first + band;
      for (int j = 0; j < last; j += columns) {
        const double* factors = W + static_cast<long>(j / panel) * panel * rank + j % panel + panel * k;
        double* strip = P + static_cast<long>(j) * stride;
        const auto at = [&](int i) { return W + static_cast<long>(i) * rank + panel * k; };
        const long step = static_cast<long>(panel) * rank;
        int i = j < first ? first : j / panel * panel;
        for (; i + tile - panel < last; i += tile)
          subtract_tile<panels>(strip + i, stride, at(i), factors, step, depth, n - j);
        for (; i < last; i += panel) subtract_tile<1>(strip + i, stride, at(i), factors, step, depth, n - j);
      }
    }
  }
}

/// Computes `width` columns of W from A and L; the `before` columns to their left are already done.
template <int height, int width>
inline void whiten_tile(const double* A, long stride, const double* L, int before, double* W,
                        long panel_step) {
  constexpr int vectors = panel / INCOGNITA_RANK_UPDATE_LANES * height, each = vectors / height;
  const auto w_at = [&](int v, int k) {
    return reinterpret_cast<Vector*>(W + v / each * panel_step + static_cast<long>(panel) * k) + v % each;
  };
  Vector sum[width][vectors];
#pragma GCC unroll 16
  for (int c = 0; c < width; ++c)
#pragma GCC unroll 16
    for (int v = 0; v < vectors; ++v) sum[c][v] = reinterpret_cast<const Vector*>(A + c * stride)[v];
  for (int l = 0; l < before; ++l) {
    Vector w[vectors];
#pragma GCC unroll 16
    for (int v = 0; v < vectors; ++v) w[v] = *w_at(v, l);
#pragma GCC unroll 16
    for (int c = 0; c < width; ++c)
#pragma GCC unroll 16
      for (int v = 0; v < vectors; ++v) sum[c][v] -= w[v] * L[panel * l + c];
  }
#pragma GCC unroll 16
  for (int c = 0; c < width; ++c) {
    const double* factors = L + static_cast<long>(panel) * (before + c);
    const double inverse = 1 / factors[c];
#pragma GCC unroll 16
    for (int v = 0; v < vectors; ++v) *w_at(v, before + c) = sum[c][v] *= inverse;
#pragma GCC unroll 16
    for (int d = c + 1; d < width; ++d)
#pragma GCC unroll 16
      for (int v = 0; v < vectors; ++v) sum[d][v] -= sum[c][v] * factors[d];
  }
}

/// Columns [k, k + width) of the rows [first, last).
template <int width>
inline void whiten_columns(const double* A, long stride, int first, int last, const double* L, int k, int rank,
                           double* W) {
  constexpr int tile = panel * panels;
  const double* factors = L + static_cast<long>(k / panel) * panel * rank + k % panel;
  const double* column = A + k * stride;
  const long step = static_cast<long>(panel) * rank;
  int i = first;
  for (; i + tile - panel < last; i += tile)
    whiten_tile<panels, width>(column + i, stride, factors, k, W + static_cast<long>(i) * rank, step);
  for (; i < last; i += panel)
    whiten_tile<1, width>(column + i, stride, factors, k, W + static_cast<long>(i) * rank, step);
}

void whiten(const double* A, int stride, int n, const double* L, int rank, double* W) {
  constexpr int tile = panel * panels;
  const int fitting = band_doubles / (rank > 0 ? rank : 1), band = fitting < tile ? tile : fitting / tile * tile;
  for (int first = 0; first < n; first += band) {
    const int last = n - first < band ? n : first + band;
    int k = 0;
    for (; k + columns <= rank; k += columns) whiten_columns<columns>(A, stride, first, last, L, k, rank, W);
    for (; k < rank; ++k) whiten_columns<1>(A, stride, first, last, L, k, rank, W);
  }
}

}  // namespace incognita::INCOGNITA_RANK_UPDATE_PATH
