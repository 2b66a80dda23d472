#include "incognita/app/console/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace incognita {

Progress::Progress(std::int64_t total, std::string unit)
    : total_(total),
      unit_(std::move(unit)),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::int64_t done, const std::string& what) {
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || (shown_ && now - last_ < std::chrono::milliseconds(100))) return;
  last_ = now;
  shown_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = static_cast<double>(done) / std::max(seconds, 1e-3);
  const std::string per_s = fmt::format("{:.{}f}/s", rate, rate < 10 ? 1 : 0);
  std::string line = fmt::format("\r\033[K{} {}, {}", done, unit_, per_s);
  if (total_ > 0) {
    constexpr int width = 24;
    const int filled = static_cast<int>(std::min<std::int64_t>(width, width * done / total_));
    line = fmt::format("\r\033[K[{:=<{}}{: <{}}] {}/{} {}, {}", "", filled, "", width - filled, done, total_,
                       unit_, per_s);
  }
  std::fputs((line + "  " + what).c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace incognita
