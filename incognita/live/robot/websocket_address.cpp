#include "incognita/live/robot/websocket_address.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

[[noreturn]] void refuse_address(const std::string& address, const char* why) {
  throw InputError(
      fmt::format("address {}: {}; write e.g. ws://localhost:9090", address.substr(0, 200), why));
}

bool is_port(const std::string& text) {
  int port = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  return error == std::errc{} && end == text.data() + text.size() && port >= 1 && port <= 65535;
}

bool is_plain(char c) { return c > ' ' && c <= '~'; }

}  // namespace

std::string WebSocketAddress::authority() const {
  return (host.find(':') == std::string::npos ? host : "[" + host + "]") + ":" + port;
}

WebSocketAddress parse_websocket_address(const std::string& address) {
  constexpr std::string_view scheme = "ws://";
  if (address.starts_with("wss://"))
    throw InputError(fmt::format(
        "address {}: the link is not encrypted itself; use an encrypted tunnel, e.g. ssh -L 9090:localhost:9090 "
        "ROBOT, and write ws://localhost:9090",
        address.substr(0, 200)));
  if (!address.starts_with(scheme)) refuse_address(address, "must begin with ws://");
  if (!std::ranges::all_of(address, is_plain))
    refuse_address(address, "has characters that an address cannot have");
  const auto slash = std::min(address.find_first_of("/?", scheme.size()), address.size());
  const std::string authority = address.substr(scheme.size(), slash - scheme.size());
  WebSocketAddress out;
  if (slash < address.size()) out.target = (address[slash] == '?' ? "/" : "") + address.substr(slash);
  const auto bracket = authority.starts_with('[') ? authority.find(']') : 0;
  if (bracket == std::string::npos) refuse_address(address, "the bracket of its host is not closed");
  const auto colon = authority.find(':', bracket);
  out.host = bracket > 0 ? authority.substr(1, bracket - 1) : authority.substr(0, colon);
  if (out.host.empty() || out.host.find('@') != std::string::npos)
    refuse_address(address, "has no valid host");
  if (colon != std::string::npos) out.port = authority.substr(colon + 1);
  if (!is_port(out.port)) refuse_address(address, "its port must be 1 to 65535");
  return out;
}

}  // namespace incognita
