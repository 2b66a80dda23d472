#include "incognita/record/mcap/mcap_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "incognita/io/bags/mcap_index.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

/// This program writes uncompressed JSON; other files would be read in part only.
void check_is_run(const bags::BagIndex& index, const std::string& path) {
  if (!index.chunks.empty())
    throw InputError(
        fmt::format("{}: at byte {}: compressed with `{}`; decompress it: mcap decompress FILE -o run.mcap",
                    path, index.chunks.front().record, word_of(index.chunks.front().compression)));
  for (const auto& [id, channel] : index.channels)
    if (channel.encoding != "json")
      throw InputError(
          fmt::format("{}: at byte {}: messages of `{:.40}` are encoded as `{:.40}`, not as JSON; only a "
                      "run.mcap of this program can be read",
                      path, channel.record, channel.topic, channel.encoding));
}

bags::BagIndex index_of_run(const InputFile& file) {
  const std::string path = file.path().string();
  if (!mcap::is_mcap(file))
    throw InputError(path + ": at byte 0: not an MCAP file; name the run.mcap of a run directory");
  bags::BagIndex index = mcap::index_messages(file);
  check_is_run(index, path);
  if (!index.messages.empty()) return index;
  throw InputError(
      (index.damage.empty() ? path + ": at byte " + std::to_string(file.size()) : index.damage) +
      ": no message before it; the run ended before its first chunk was written (2 s), or the file is cut");
}

}  // namespace

McapReader::McapReader(const std::filesystem::path& path) : file_(path) {
  bags::BagIndex index = index_of_run(file_);
  damage_ = std::move(index.damage);
  for (auto& [channel, places] : index.messages) {
    std::vector<bags::MessagePlace>& all =
        messages_[index.channels.at(channel).topic];  // channels may share a topic
    all.insert(all.end(), places.begin(), places.end());
  }
  for (auto& [topic, places] : messages_)
    std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.offset < b.offset; });
}

const std::vector<bags::MessagePlace>& McapReader::messages(std::string_view topic) const {
  static const std::vector<bags::MessagePlace> none;
  const auto found = messages_.find(topic);
  return found == messages_.end() ? none : found->second;
}

std::string McapReader::text(const bags::MessagePlace& message) const {
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
