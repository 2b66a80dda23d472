#include "incognita/live/foxglove_messages.hpp"

#include <nlohmann/json.hpp>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/json_limits.hpp"

namespace incognita::foxglove {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_entries = 100;

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

std::uint32_t id_of(const Json& json) {
  if (!json.is_number_unsigned() || json > 0xffffffffu)
    throw InputError("an id must be a whole number, 0 to 4294967295");
  return json.get<std::uint32_t>();
}

const Json& list_of(const Json& json, const char* key) {
  const auto found = json.find(key);
  if (found == json.end() || !found->is_array() || found->size() > most_entries)
    throw InputError(std::string(key) + " must be a list of at most 100 entries");
  return *found;
}

}  // namespace

std::string server_info(const std::string& session) {
  return text_of(
      {{"op", "serverInfo"}, {"name", "incognita"}, {"capabilities", Json::array()}, {"sessionId", session}});
}

std::string advertise(std::span<const Topic> topics) {
  Json channels = Json::array();
  for (std::size_t i = 0; i < topics.size(); ++i)
    channels.push_back({{"id", i},
                        {"topic", topics[i].name},
                        {"encoding", "json"},
                        {"schemaName", topics[i].schema_name},
                        {"schema", topics[i].schema()},
                        {"schemaEncoding", "jsonschema"}});
  return text_of({{"op", "advertise"}, {"channels", channels}});
}

std::string status(int level, const std::string& text) {
  return text_of({{"op", "status"}, {"level", level}, {"message", text}});
}

std::string message_header(std::uint32_t subscription, std::uint64_t time_ns) {
  std::string header(1, '\x01');
  for (int i = 0; i < 4; ++i) header.push_back(static_cast<char>(subscription >> (8 * i) & 0xff));
  for (int i = 0; i < 8; ++i) header.push_back(static_cast<char>(time_ns >> (8 * i) & 0xff));
  return header;
}

Request request(std::string_view text) {
  if (json_depth(text) > most_json_depth) throw InputError("a message must not be nested deeply");
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("op") || !json["op"].is_string())
    throw InputError("a message must be a JSON object with `op`");
  Request out;
  if (json["op"] == "subscribe") {
    for (const Json& entry : list_of(json, "subscriptions")) {
      if (!entry.is_object() || !entry.contains("id") || !entry.contains("channelId"))
        throw InputError("a subscription needs id and channelId");
      out.subscribe.emplace_back(id_of(entry["id"]), id_of(entry["channelId"]));
    }
  } else if (json["op"] == "unsubscribe") {
    for (const Json& entry : list_of(json, "subscriptionIds")) out.unsubscribe.push_back(id_of(entry));
  } else {
    throw InputError("this server takes subscribe and unsubscribe only");
  }
  return out;
}

}  // namespace incognita::foxglove
