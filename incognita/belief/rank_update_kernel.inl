// Bodies of rank_update and whiten for one instruction set; the source file that includes it says the
// namespace (PATH), the doubles in a vector register (LANES) and the columns of a tile (COLUMNS). It calls
// nothing from any library header, so that no inline function compiled for a newer processor can reach the
// rest of the program.
//
// A tile of 8 rows x COLUMNS columns of P stays in registers while k runs over the rank: COLUMNS is as many
// as leaves room for the factors, since each further column saves a reading of W.

namespace incognita::INCOGNITA_RANK_UPDATE_PATH {

typedef double Vector __attribute__((vector_size(8 * INCOGNITA_RANK_UPDATE_LANES)));

void rank_update(double* P, int stride, int n, const double* W, int rank) {
  constexpr int panel = 8, lanes = INCOGNITA_RANK_UPDATE_LANES, columns = INCOGNITA_RANK_UPDATE_COLUMNS;
  constexpr int vectors = panel / lanes;
  for (int j = 0; j < n; j += columns) {
    const double* column_panel = W + static_cast<long>(j / panel) * panel * rank + j % panel;
    double* strip = P + static_cast<long>(j) * stride;
    for (int i = j / panel * panel; i < n; i += panel) {
      const double* row_panel = W + static_cast<long>(i) * rank;
      Vector sum[columns][vectors] = {};
      for (int k = 0; k < rank; ++k) {
        const Vector* w = reinterpret_cast<const Vector*>(row_panel + panel * k);
        const double* factor = column_panel + panel * k;
#pragma GCC unroll 8
        for (int c = 0; c < columns; ++c)
#pragma GCC unroll 8
          for (int v = 0; v < vectors; ++v) sum[c][v] += w[v] * factor[c];
      }
#pragma GCC unroll 8
      for (int c = 0; c < columns; ++c) {
        if (j + c >= n) break;
        Vector* p = reinterpret_cast<Vector*>(strip + static_cast<long>(c) * stride + i);
#pragma GCC unroll 8
        for (int v = 0; v < vectors; ++v) p[v] -= sum[c][v];
      }
    }
  }
}

void whiten(const double* A, int stride, int n, const double* L, int L_stride, int rank, double* W) {
  constexpr int panel = 8, vectors = panel / INCOGNITA_RANK_UPDATE_LANES;
  for (int i = 0; i < n; i += panel) {
    Vector* w = reinterpret_cast<Vector*>(W + static_cast<long>(i) * rank);
    for (int k = 0; k < rank; ++k) {
      const Vector* a = reinterpret_cast<const Vector*>(A + static_cast<long>(k) * stride + i);
      Vector sum[vectors];
#pragma GCC unroll 8
      for (int v = 0; v < vectors; ++v) sum[v] = a[v];
      for (int l = 0; l < k; ++l) {
        const double factor = L[k + static_cast<long>(l) * L_stride];
#pragma GCC unroll 8
        for (int v = 0; v < vectors; ++v) sum[v] -= w[l * vectors + v] * factor;
      }
      const double inverse = 1 / L[k + static_cast<long>(k) * L_stride];
#pragma GCC unroll 8
      for (int v = 0; v < vectors; ++v) w[k * vectors + v] = sum[v] * inverse;
    }
  }
}

}  // namespace incognita::INCOGNITA_RANK_UPDATE_PATH
