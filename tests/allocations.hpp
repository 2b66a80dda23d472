// Number of heap allocations; a test that uses it links allocations.cpp.
#pragma once

#include <gtest/gtest.h>

namespace incognita::testing {

long allocations_so_far();
bool allocations_are_counted();

template <class Work>
long allocations_in(const Work& work) {
  const long before = allocations_so_far();
  work();
  return allocations_so_far() - before;
}

class Allocation : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!allocations_are_counted())
      GTEST_SKIP() << "allocations are counted with the GNU C library and without sanitizers only";
  }
};

}  // namespace incognita::testing
