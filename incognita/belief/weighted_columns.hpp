// Weighted sums of a few columns of the covariance in one pass.
#pragma once

namespace incognita {

/// out[r] += sum over k < columns of h[k] * P[r + k * stride], for r < length.
template <int columns>
void add_columns(double* out, const double* P, long stride, const double* h, int length) {
  for (int r = 0; r < length; ++r) {
    double sum = h[0] * P[r];
    if constexpr (columns > 1) sum += h[1] * P[r + stride];
    if constexpr (columns > 2) sum += h[2] * P[r + 2 * stride];
    if constexpr (columns > 3) sum += h[3] * P[r + 3 * stride];
    out[r] += sum;
  }
}

inline void add_weighted_columns(double* out, const double* P, long stride, const double* h, int columns,
                                 int length) {
  for (; columns >= 4; columns -= 4, P += 4 * stride, h += 4) add_columns<4>(out, P, stride, h, length);
  if (columns == 3) add_columns<3>(out, P, stride, h, length);
  if (columns == 2) add_columns<2>(out, P, stride, h, length);
  if (columns == 1) add_columns<1>(out, P, stride, h, length);
}

}  // namespace incognita
