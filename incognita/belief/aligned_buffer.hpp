// Zero-initialized doubles at a cache-line boundary. Eigen's own alignment depends on the target processor of
// the build.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <new>

namespace incognita {

class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  explicit AlignedBuffer(std::size_t size)
      : data_(
            static_cast<double*>(::operator new(std::max<std::size_t>(size, 1) * sizeof(double), alignment))),
        size_(size) {
    std::fill_n(data_.get(), size_, 0.0);
  }
  AlignedBuffer(const AlignedBuffer& other) : AlignedBuffer(other.size_) {
    std::copy_n(other.data_.get(), size_, data_.get());
  }
  AlignedBuffer& operator=(const AlignedBuffer& other) {
    if (this != &other) *this = AlignedBuffer(other);
    return *this;
  }
  AlignedBuffer(AlignedBuffer&&) = default;
  AlignedBuffer& operator=(AlignedBuffer&&) = default;

  double* data() { return data_.get(); }
  const double* data() const { return data_.get(); }
  std::size_t size() const { return size_; }

 private:
  static constexpr std::align_val_t alignment{64};
  struct Free {
    void operator()(double* p) const { ::operator delete(p, alignment); }
  };
  std::unique_ptr<double, Free> data_;
  std::size_t size_ = 0;
};

}  // namespace incognita
