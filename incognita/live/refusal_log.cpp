#include "incognita/live/refusal_log.hpp"

namespace incognita {
namespace {

constexpr std::size_t most_entries = 50;  // messages carry text of the client
constexpr int most_per_second = 5;

/// A terminal takes some bytes as commands.
std::string printable(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

}  // namespace

/// False if too many were printed in this second; they are counted.
bool RefusalLog::may_print(Clock::time_point now) {
  if (now - second_ >= std::chrono::seconds(1)) {
    second_ = now;
    printed_ = 0;
    if (unprinted_ > 0)
      print_(std::to_string(std::exchange(unprinted_, 0)) + " further refusals of other kinds");
  }
  if (printed_ < most_per_second) return ++printed_ > 0;
  ++unprinted_;
  return false;
}

void RefusalLog::add(const std::string& text, Clock::time_point now) {
  if (!print_) return;
  const std::string message = printable(text);
  if (entries_.size() >= most_entries && !entries_.contains(message)) entries_.erase(entries_.begin());
  const auto [entry, is_new] = entries_.try_emplace(message, Entry{now});
  if (is_new) {
    if (may_print(now)) print_(message);
    return;
  }
  ++entry->second.since;
  if (now - entry->second.printed < std::chrono::seconds(1) || !may_print(now)) return;
  print_(message + (entry->second.since > 1 ? " (" + std::to_string(entry->second.since) + " times)" : ""));
  entry->second = {now, 0};
}

}  // namespace incognita
