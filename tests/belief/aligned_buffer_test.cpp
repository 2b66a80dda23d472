// Storage of covariances.
#include "incognita/belief/aligned_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <utility>

namespace incognita {
namespace {

TEST(AlignedBuffer, IsAlignedAndZero) {
  for (const std::size_t size : {0u, 1u, 7u, 100u, 1000000u}) {
    const AlignedBuffer buffer(size);
    EXPECT_EQ(buffer.size(), size);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffer.data()) % 64, 0u) << size;
    EXPECT_TRUE(std::all_of(buffer.data(), buffer.data() + size, [](double x) { return x == 0; })) << size;
  }
}

TEST(AlignedBuffer, IsEmptyAfterItMoved) {
  AlignedBuffer from(3);
  from.data()[1] = 5;
  const AlignedBuffer copy = from, to = std::move(from);
  EXPECT_EQ(copy.data()[1], 5);
  EXPECT_EQ(to.data()[1], 5);
  EXPECT_NE(copy.data(), to.data());
  EXPECT_EQ(from.size(), 0u);
  EXPECT_EQ(from.data(), nullptr);
}

TEST(AlignedBuffer, RefusesSizesBeyondMemory) {
  EXPECT_THROW(AlignedBuffer(static_cast<std::size_t>(-1) / 4), std::bad_alloc);
}

}  // namespace
}  // namespace incognita
