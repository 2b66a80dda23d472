// Messages of the Foxglove WebSocket protocol: https://github.com/foxglove/ws-protocol, version 1.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "incognita/record/mcap/snapshot_topics.hpp"

namespace incognita::foxglove {

/// Names of the protocol, the newer first; they differ in what this server does not offer.
inline constexpr const char* subprotocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

/// `session`: another one makes viewers forget what they have.
std::string server_info(const std::string& session);
/// Channel k is topic k.
std::string advertise(std::span<const Topic> topics);
/// A remark for the person at the viewer. `level`: 0 information, 1 warning, 2 error.
std::string status(int level, const std::string& text);

/// What precedes the JSON of a message: opcode 1, subscription, time; little-endian.
std::string message_header(std::uint32_t subscription, std::uint64_t time_ns);

/// What a client asks for; one of the lists is empty.
struct Request {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> subscribe;  ///< subscription and channel
  std::vector<std::uint32_t> unsubscribe;
};
/// Throws InputError for anything that is neither.
Request request(std::string_view json);

}  // namespace incognita::foxglove
