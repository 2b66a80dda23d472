#include "incognita/belief/rank_update.hpp"

#include <array>

namespace incognita {

namespace baseline {
void rank_update(double* P, int stride, int n, const double* W, int rank);
void whiten(const double* A, int stride, int n, const double* L, int rank, double* W);
}  // namespace baseline
namespace avx2 {
void rank_update(double* P, int stride, int n, const double* W, int rank);
void whiten(const double* A, int stride, int n, const double* L, int rank, double* W);
}  // namespace avx2
namespace avx512 {
void rank_update(double* P, int stride, int n, const double* W, int rank);
void whiten(const double* A, int stride, int n, const double* L, int rank, double* W);
}  // namespace avx512

namespace {

struct Paths {
  std::array<RankUpdatePath, 3> list{};
  std::size_t count = 0;

  Paths() {
#ifdef INCOGNITA_X86_PATHS
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f")) list[count++] = {avx512::rank_update, avx512::whiten, "avx512"};
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
      list[count++] = {avx2::rank_update, avx2::whiten, "avx2"};
#endif
    list[count++] = {baseline::rank_update, baseline::whiten, "baseline"};
  }
};

/// Initialized on first use, so that a belief may be a global variable.
const Paths& paths() {
  static const Paths found;
  return found;
}

}  // namespace

std::span<const RankUpdatePath> rank_update_paths() { return {paths().list.data(), paths().count}; }

void rank_update(double* P, int stride, int n, const double* W, int rank) {
  paths().list[0].run(P, stride, n, W, rank);
}

void whiten(const double* A, int stride, int n, const double* L, int L_stride, int rank, double* W) {
  double* panels = W + static_cast<long>(round_up_to_panel(n)) * rank;
  for (int k = 0; k < rank; ++k)
    for (int i = k; i < rank; ++i) panels[panel_index(i, k, rank)] = L[i + static_cast<long>(k) * L_stride];
  paths().list[0].whiten(A, stride, n, panels, rank, W);
}

const char* rank_update_path() { return paths().list[0].name; }

}  // namespace incognita
