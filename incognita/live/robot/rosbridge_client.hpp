// A client of a rosbridge server, in a thread of its own: connects, and connects again after any failure. What it sends while
// there is no connection is lost: a command must not wait for one.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "incognita/live/outbox.hpp"
#include "incognita/live/robot/rosbridge.hpp"
#include "incognita/live/robot/websocket_address.hpp"

namespace incognita {

struct RosbridgeClientSettings {
  WebSocketAddress address;
  double first_retry_s = 0.1, last_retry_s = 2;  ///< pauses between attempts: doubled each time
  double silence_s = 3;      ///< a connection without a sign of life for so long is given up; pinged before
  double heartbeat_s = 0.1;  ///< interval of the calls of `heartbeat`
  Outbox::Limits outbox{64, std::size_t{16} << 20};
};

/// All are called in the client's thread, and may be empty.
struct RosbridgeClientHandlers {
  std::function<void()> connected = {};     ///< to subscribe and advertise; each time
  std::function<void()> disconnected = {};  ///< after `connected`
  std::function<void(const rosbridge::Operation& operation)> received = {};
  std::function<void()> heartbeat = {};
  /// What happens to the connection, and messages that are not valid; at most a few per second.
  std::function<void(const std::string&)> say = {};
};

class RosbridgeClient {
 public:
  RosbridgeClient(RosbridgeClientSettings settings, RosbridgeClientHandlers handlers);
  /// Begins; to be called once, when what the handlers use is there.
  void start();
  /// Ends the connection, after what was sent before, and the thread.
  ~RosbridgeClient();
  RosbridgeClient(const RosbridgeClient&) = delete;
  RosbridgeClient& operator=(const RosbridgeClient&) = delete;

  /// From any thread. `replaces`: a constant; a waiting message with the same word is outdated and not sent.
  void send(std::string json, std::string_view replaces = {});
  bool is_connected() const;
  /// Number of connections so far.
  std::uint64_t connections() const;
  /// Why there is no connection; empty if there is one.
  std::string problem() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace incognita
