#include "incognita/live/robot/fragments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "incognita/messages/errors.hpp"

namespace incognita::rosbridge {
namespace {

/// End of a part from `begin` with at most `bytes` bytes, and one character at least.
std::size_t end_of_part(const std::string& message, std::size_t begin, std::size_t bytes) {
  const auto continues = [&](std::size_t i) {
    return i < message.size() && (static_cast<unsigned char>(message[i]) & 0xc0u) == 0x80u;
  };
  std::size_t end = std::min(message.size(), begin + std::max<std::size_t>(bytes, 1));
  while (end > begin + 1 && continues(end)) --end;
  while (continues(end)) ++end;  // one character that is longer than a part
  return end;
}

}  // namespace

std::vector<std::string> in_fragments(const std::string& message, std::size_t bytes, const std::string& id) {
  if (bytes == 0 || message.size() <= bytes) return {message};
  std::vector<Fragment> fragments;
  for (std::size_t begin = 0; begin < message.size();) {
    const std::size_t end = end_of_part(message, begin, bytes);
    fragments.push_back({id, message.substr(begin, end - begin), static_cast<int>(fragments.size())});
    begin = end;
  }
  std::vector<std::string> out;
  for (Fragment& fragment : fragments) {
    fragment.total = static_cast<int>(fragments.size());
    out.push_back(to_json(fragment));
  }
  return out;
}

void FragmentAssembler::forget_oldest() {
  open_.erase(std::ranges::min_element(
      open_, [](const auto& a, const auto& b) { return a.second.begun < b.second.begun; }));
}

std::optional<std::string> FragmentAssembler::add(const Fragment& fragment) {
  if (!open_.contains(fragment.id)) {
    if (open_.size() >= most_open) forget_oldest();
    open_[fragment.id] = {.total = fragment.total, .begun = begun_++};
  }
  Open& open = open_[fragment.id];
  open.bytes += fragment.data.size();
  if (fragment.total != open.total || open.bytes > max_message_bytes) {
    open_.erase(fragment.id);
    throw InputError(fmt::format(
        "rosbridge: fragment: the parts of message \"{}\" differ in `total`, or make more than {} bytes",
        fragment.id, max_message_bytes));
  }
  open.parts[fragment.number] = fragment.data;
  if (open.parts.size() < static_cast<std::size_t>(open.total)) return std::nullopt;
  std::string message;
  for (const auto& [number, part] : open.parts) message += part;
  open_.erase(fragment.id);
  return message;
}

}  // namespace incognita::rosbridge
