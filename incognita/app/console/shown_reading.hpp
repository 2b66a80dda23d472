// A progress line for files that take long to read, on a terminal.
#pragma once

#include <chrono>
#include <optional>

#include "incognita/app/console/progress.hpp"
#include "incognita/io/formats/reading_progress.hpp"

namespace incognita {

/// Shows what this thread reads while it lives, where that takes longer than a moment.
class ShownReading final : public ReadingListener {
 public:
  void progressed(const Reading& reading, std::uint64_t done) override;
  void ended(const Reading& reading) override;

 private:
  std::optional<Progress> line_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace incognita
