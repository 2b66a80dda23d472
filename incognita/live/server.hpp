// The server of the page: HTTP requests and WebSocket viewers on one port, in a thread of its own. Nothing that a
// viewer does or fails to do slows the thread that publishes.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "incognita/live/access.hpp"
#include "incognita/live/outbox.hpp"

namespace incognita {

struct ServerSettings {
  std::string address = "127.0.0.1";  ///< numerical; "0.0.0.0" for all
  std::uint16_t port = 0;             ///< 0: any free one
  AccessRules access;
  /// PEM files: with them, the connection is encrypted, and the address begins with https; docs/live-page.md.
  std::filesystem::path certificate = {}, certificate_key = {};
  std::string websocket_path = "/ws";
  std::size_t max_connections = 64;  ///< HTTP and WebSocket together
  /// Of one address that have not shown yet that they have access; a browser opens 6 for the page itself.
  std::size_t max_strangers = 16;
  std::size_t max_message_bytes = 64u << 10;
  int idle_s = 30;  ///< after which a silent connection is closed; WebSocket viewers are pinged before
  Outbox::Limits outbox;
};

struct HttpRequest {
  std::string path;                                        ///< "/api/mode", decoded
  std::vector<std::pair<std::string, std::string>> query;  ///< decoded, in their order

  /// The first value of a parameter; empty without one.
  std::string_view parameter(std::string_view name) const;
};

struct HttpAnswer {
  int status = 200;
  std::string content_type = "application/json";
  std::shared_ptr<const std::string> body;
  std::string location = {};  ///< of status 302
};

/// One WebSocket viewer. All calls are made in the server's thread.
class Viewer {
 public:
  virtual ~Viewer() = default;
  virtual void send(LiveMessage message) = 0;
  /// Messages dropped so far.
  virtual void add_dropped(std::uint64_t count) = 0;
};

/// What viewers of one WebSocket subprotocol talk with. All calls are made in the server's thread.
class ViewerProtocol {
 public:
  virtual ~ViewerProtocol() = default;
  /// `id` is unique; `viewer` is valid until left().
  virtual void joined(std::uint64_t id, Viewer& viewer) = 0;
  virtual void left(std::uint64_t id) = 0;
  /// A message of a viewer, of at most largest_message_bytes().
  virtual void received(std::uint64_t id, std::string_view message, bool binary) = 0;
  /// 0: max_message_bytes of the server.
  virtual std::size_t largest_message_bytes() const { return 0; }
};

struct ServerHandlers {
  /// Answers GET requests of anyone, without data of a run: the page itself. None: `answer` is asked.
  std::function<std::optional<HttpAnswer>(const HttpRequest&)> public_answer;
  /// Answers GET requests of those who have access. Both are called in the server's thread; exceptions become status 500.
  std::function<HttpAnswer(const HttpRequest&)> answer;
  /// By subprotocol, in the order of preference; "" is for clients that offer none.
  std::vector<std::pair<std::string, std::shared_ptr<ViewerProtocol>>> protocols;
  /// Refusals and failures, at most a few per second; called in the server's thread.
  std::function<void(const std::string&)> log;
};

class Server {
 public:
  /// Listens, and starts the thread after `ready`, which may keep the server for post(). Throws InputError if the
  /// address cannot be used.
  Server(ServerSettings settings, ServerHandlers handlers, const std::function<void(Server&)>& ready = {});
  /// Disconnects all viewers and ends the thread.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  std::uint16_t port() const;
  /// "http://127.0.0.1:8321/?token=..."
  std::string address() const;
  /// Runs a task in the server's thread.
  void post(std::function<void()> task);
  /// The same, after some time; not at all if the server ends before.
  void post_after(std::chrono::steady_clock::duration delay, std::function<void()> task);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace incognita
