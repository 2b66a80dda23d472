#include "incognita/belief/rank_update.hpp"

namespace incognita {

namespace baseline {
void rank_update(double* P, int stride, int n, const double* W, int rank);
}
namespace avx2 {
void rank_update(double* P, int stride, int n, const double* W, int rank);
}
namespace avx512 {
void rank_update(double* P, int stride, int n, const double* W, int rank);
}

namespace {

struct Path {
  void (*run)(double*, int, int, const double*, int);
  const char* name;
};

Path best_path() {
#ifdef INCOGNITA_X86_PATHS
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) return {avx512::rank_update, "avx512"};
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return {avx2::rank_update, "avx2"};
#endif
  return {baseline::rank_update, "baseline"};
}

const Path path = best_path();

}  // namespace

void rank_update(double* P, int stride, int n, const double* W, int rank) { path.run(P, stride, n, W, rank); }

const char* rank_update_path() { return path.name; }

}  // namespace incognita
