#include "incognita/live/refusal_log.hpp"

namespace incognita {
namespace {

constexpr std::size_t most_entries = 50;  // messages carry text of the client

}  // namespace

void RefusalLog::add(const std::string& message, Clock::time_point now) {
  if (!print_) return;
  if (entries_.size() >= most_entries && !entries_.contains(message)) entries_.erase(entries_.begin());
  const auto [entry, is_new] = entries_.try_emplace(message, Entry{now});
  if (is_new) return print_(message);
  ++entry->second.since;
  if (now - entry->second.printed < std::chrono::seconds(1)) return;
  print_(message + (entry->second.since > 1 ? " (" + std::to_string(entry->second.since) + " times)" : ""));
  entry->second = {now, 0};
}

}  // namespace incognita
