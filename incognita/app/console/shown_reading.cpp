#include "incognita/app/console/shown_reading.hpp"

#include <fmt/format.h>

namespace incognita {
namespace {

constexpr std::chrono::milliseconds moment{500};
constexpr std::uint64_t bytes_per_mb = 1'000'000;

bool is_in_bytes(const ReadingListener::Reading& reading) { return reading.unit == "bytes"; }

std::int64_t in_shown_unit(const ReadingListener::Reading& reading, std::uint64_t number) {
  return static_cast<std::int64_t>(is_in_bytes(reading) ? number / bytes_per_mb : number);
}

}  // namespace

void ShownReading::progressed(const Reading& reading, std::uint64_t done) {
  const auto now = std::chrono::steady_clock::now();
  if (!line_) {
    start_ = now;
    line_.emplace(in_shown_unit(reading, reading.total), is_in_bytes(reading) ? "MB" : reading.unit);
  }
  if (now - start_ < moment) return;
  line_->show(in_shown_unit(reading, done), fmt::format("of {} read", reading.file.filename().string()));
}

void ShownReading::ended(const Reading&) { line_.reset(); }

}  // namespace incognita
