#include "incognita/record/mcap/mcap_reader.hpp"

#include <algorithm>
#include <utility>

#include "incognita/messages/errors.hpp"

namespace incognita {

McapReader::McapReader(const std::filesystem::path& path) : file_(path) {
  mcap::MessageIndex index = mcap::index_messages(file_);
  damage_ = std::move(index.damage);
  for (auto& [channel, places] : index.messages) {
    std::vector<mcap::MessagePlace>& all = messages_[index.topics.at(channel)];  // channels may share a topic
    all.insert(all.end(), places.begin(), places.end());
  }
  for (auto& [topic, places] : messages_)
    std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.offset < b.offset; });
}

const std::vector<mcap::MessagePlace>& McapReader::messages(std::string_view topic) const {
  static const std::vector<mcap::MessagePlace> none;
  const auto found = messages_.find(topic);
  return found == messages_.end() ? none : found->second;
}

std::string McapReader::text(const mcap::MessagePlace& message) const {
  const mcap::RecordHead head = mcap::record_head(file_.read(message.offset, mcap::record_head_bytes));
  const std::uint64_t content = message.offset + mcap::record_head_bytes;
  if (head.opcode != mcap::Opcode::message || head.length < mcap::message_head_bytes ||
      head.length > file_.size() - content)
    throw InputError(path().string() + ": at byte " + std::to_string(message.offset) +
                     ": no complete message, which the index of the file names; the file is damaged, "
                     "`mcap recover` may help");
  return file_.read(content + mcap::message_head_bytes, head.length - mcap::message_head_bytes);
}

}  // namespace incognita
