// A client of the server for tests: HTTP requests, WebSockets, and raw connections.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace incognita::testing {

using Headers = std::vector<std::pair<std::string, std::string>>;

struct Reply {
  int status = 0;  ///< 0: the connection was closed without an answer
  std::string body;
  std::string content_type;
};

/// GET at 127.0.0.1; Host is "127.0.0.1:port" unless given.
Reply get(std::uint16_t port, const std::string& target, const Headers& headers = {},
          const std::string& method = "GET");

class WebSocketClient {
 public:
  /// Connects at 127.0.0.1; status() is 101 if that worked.
  WebSocketClient(std::uint16_t port, const std::string& target, const std::string& subprotocol,
                  const Headers& headers = {});
  ~WebSocketClient();
  WebSocketClient(WebSocketClient&&) noexcept;

  int status() const { return status_; }
  /// False if the connection is closed.
  bool send(const std::string& text);
  /// The next message; none if the connection ends before, or nothing comes for two seconds.
  std::optional<std::string> receive();
  bool last_was_binary() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
  int status_ = 0;
};

/// A connection that sends what it is told.
class RawConnection {
 public:
  /// `from`: the address of this side, of the loopback.
  explicit RawConnection(std::uint16_t port, const std::string& from = "127.0.0.1");
  ~RawConnection();
  RawConnection(RawConnection&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

  void send(const std::string& bytes) const;
  /// Whether the server closes the connection within that time.
  bool is_closed_within(double s) const;

 private:
  int descriptor_ = -1;
};

}  // namespace incognita::testing
