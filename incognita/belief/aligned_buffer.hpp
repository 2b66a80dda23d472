// Zero-initialized doubles at a cache-line boundary. Eigen's own alignment depends on the target processor of
// the build. The pages of a large buffer are given by the system when they are first written, so that a belief that grows
// does not wait for all of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>

namespace incognita {

class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  /// Throws std::bad_alloc.
  explicit AlignedBuffer(std::size_t size) : size_(size) {
    std::size_t bytes = size * sizeof(double), space = bytes + alignment;
    if (size > (static_cast<std::size_t>(-1) - alignment) / sizeof(double)) throw std::bad_alloc();
    memory_.reset(std::calloc(space, 1));
    void* aligned = memory_.get();
    if (!aligned) throw std::bad_alloc();
    data_ = static_cast<double*>(std::align(alignment, bytes, aligned, space));
  }
  AlignedBuffer(const AlignedBuffer& other) : AlignedBuffer(other.size_) {
    std::copy_n(other.data_, size_, data_);
  }
  AlignedBuffer(AlignedBuffer&& other) noexcept { swap(other); }
  AlignedBuffer& operator=(AlignedBuffer other) noexcept {
    swap(other);
    return *this;
  }

  double* data() { return data_; }
  const double* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  void swap(AlignedBuffer& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }

  static constexpr std::size_t alignment = 64;
  struct Free {
    void operator()(void* p) const { std::free(p); }
  };
  std::unique_ptr<void, Free> memory_;
  double* data_ = nullptr;  ///< in `memory_`
  std::size_t size_ = 0;
};

}  // namespace incognita
