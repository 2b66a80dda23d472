#include "incognita/live/outbox.hpp"

#include <algorithm>
#include <utility>

namespace incognita {

void Outbox::remove_outdated(std::string_view word) {
  const auto outdated = std::find_if(waiting_.begin(), waiting_.end(),
                                     [&](const LiveMessage& waiting) { return waiting.replaces == word; });
  if (outdated == waiting_.end()) return;
  bytes_ -= outdated->size();
  waiting_.erase(outdated);
}

bool Outbox::push(LiveMessage message) {
  if (!message.replaces.empty()) remove_outdated(message.replaces);
  bytes_ += message.size();
  waiting_.push_back(std::move(message));
  while (exceeded()) {
    const auto newest = std::prev(waiting_.end());
    const auto oldest =
        std::find_if(waiting_.begin(), newest, [](const LiveMessage& waiting) { return waiting.droppable; });
    if (oldest == newest) return false;
    bytes_ -= oldest->size();
    waiting_.erase(oldest);
    ++dropped_;
  }
  return true;
}

std::optional<LiveMessage> Outbox::pop() {
  if (waiting_.empty()) return std::nullopt;
  LiveMessage message = std::move(waiting_.front());
  waiting_.pop_front();
  bytes_ -= message.size();
  return message;
}

}  // namespace incognita
