// The address of a WebSocket server, "ws://robot:9090/?token=...", taken apart.
#pragma once

#include <cstdint>
#include <string>

namespace incognita {

struct WebSocketAddress {
  std::string host;  ///< a name or a number, without the brackets of IPv6
  std::string port = "9090";
  std::string target = "/";

  /// As the Host header has it.
  std::string authority() const;
};

/// Throws InputError that says what is wrong and what to write. "wss://" is refused, since the link is not encrypted.
WebSocketAddress parse_websocket_address(const std::string& address);

}  // namespace incognita
