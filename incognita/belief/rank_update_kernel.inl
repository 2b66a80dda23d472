// Body of rank_update for one vector width; included by one source file per instruction set. It calls nothing from
// any library header, so that no inline function compiled for a newer processor can reach the rest of the program.
//
// A tile of 8 rows x 4 columns of P stays in registers while k runs over the rank.

namespace incognita::INCOGNITA_RANK_UPDATE_PATH {

// Eight doubles; the compiler splits them where the registers are narrower.
typedef double Vector __attribute__((vector_size(64)));

void rank_update(double* P, int stride, int n, const double* W, int rank) {
  for (int j = 0; j < n; j += 4) {
    const double* column_panel = W + static_cast<long>(j / 8) * 8 * rank + j % 8;
    double* p0 = P + static_cast<long>(j) * stride;
    const int columns = n - j < 4 ? n - j : 4;
    for (int i = j / 8 * 8; i < n; i += 8) {
      const double* row_panel = W + static_cast<long>(i) * rank;
      Vector sum0 = {}, sum1 = {}, sum2 = {}, sum3 = {};
      for (int k = 0; k < rank; ++k) {
        const Vector w = *reinterpret_cast<const Vector*>(row_panel + 8 * k);
        const double* c = column_panel + 8 * k;
        sum0 += w * c[0];
        sum1 += w * c[1];
        sum2 += w * c[2];
        sum3 += w * c[3];
      }
      double* p = p0 + i;
      *reinterpret_cast<Vector*>(p) -= sum0;
      if (columns > 1) *reinterpret_cast<Vector*>(p + stride) -= sum1;
      if (columns > 2) *reinterpret_cast<Vector*>(p + 2L * stride) -= sum2;
      if (columns > 3) *reinterpret_cast<Vector*>(p + 3L * stride) -= sum3;
    }
  }
}

}  // namespace incognita::INCOGNITA_RANK_UPDATE_PATH
