// Counts all heap allocations: the functions below replace those of the C library, which operator new and
// Eigen both call.
#include "tests/allocations.hpp"

#include <atomic>
#include <cerrno>
#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define INCOGNITA_COUNTS_ALLOCATIONS
#endif

namespace {
std::atomic<long> allocations{0};
}

#ifdef INCOGNITA_COUNTS_ALLOCATIONS
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) { return ++allocations, __libc_malloc(size); }
void* calloc(std::size_t count, std::size_t size) { return ++allocations, __libc_calloc(count, size); }
void* realloc(void* p, std::size_t size) { return ++allocations, __libc_realloc(p, size); }
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return ++allocations, __libc_memalign(alignment, size);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t size) {
  *p = (++allocations, __libc_memalign(alignment, size));
  return *p == nullptr ? ENOMEM : 0;
}
}
#endif

namespace incognita::testing {

long allocations_so_far() { return allocations; }

bool allocations_are_counted() {
#ifdef INCOGNITA_COUNTS_ALLOCATIONS
  return true;
#else
  return false;
#endif
}

}  // namespace incognita::testing
