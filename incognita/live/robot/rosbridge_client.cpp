#include "incognita/live/robot/rosbridge_client.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "incognita/live/refusal_log.hpp"
#include "incognita/live/robot/fragments.hpp"

namespace incognita {
namespace {

namespace beast = boost::beast;
namespace websocket = beast::websocket;
namespace net = boost::asio;
using tcp = net::ip::tcp;
using ClientError = beast::error_code;
using Socket = websocket::stream<beast::tcp_stream>;

constexpr std::chrono::seconds connect_time{5};

std::chrono::steady_clock::duration duration_of(double s) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(s));
}

}  // namespace

/// Runs in the client's thread, but for the few members under `mutex`.
struct RosbridgeClient::Implementation {
  Implementation(RosbridgeClientSettings given, RosbridgeClientHandlers called)
      : settings(std::move(given)), handlers(std::move(called)), log([this](const std::string& line) {
          if (handlers.say) handlers.say(line);
        }) {}

  /// One connection from its first attempt; replaced by the next, while its last callbacks may still come.
  struct Connection {
    Connection(net::io_context& context, const Outbox::Limits& limits) : socket(context), outbox(limits) {}
    Socket socket;
    Outbox outbox;
    beast::flat_buffer incoming{rosbridge::max_message_bytes + 1024};
    std::optional<LiveMessage> writing;
    rosbridge::FragmentAssembler fragments;
    bool open = false;
  };
  using Held = std::shared_ptr<Connection>;

  bool is_current(const Held& held) const { return held == connection && !ending; }
  std::string where() const { return "ws://" + settings.address.authority(); }

  void start() {
    beat();
    connect();
    thread = std::thread([this] { run(); });
  }

  /// A handler that fails, for example for lack of memory, ends no connection for good.
  void run() {
    for (;;) {
      try {
        context.run();
        return;
      } catch (const std::exception& failure) {
        log.add(fmt::format("{}: failed, and connects again: {}", where(), failure.what()));
        lose(connection, "failed");
      }
    }
  }

  void connect() {
    connection = std::make_shared<Connection>(context, settings.outbox);
    resolver.async_resolve(
        settings.address.host, settings.address.port,
        [this, held = connection](ClientError error, const tcp::resolver::results_type& found) {
          if (!is_current(held)) return;
          if (error) return lose(held, error.message());
          auto& stream = beast::get_lowest_layer(held->socket);
          stream.expires_after(connect_time);
          stream.async_connect(
              found, [this, held](ClientError failure, const tcp::endpoint&) { shake_hands(held, failure); });
        });
  }

  void shake_hands(const Held& held, ClientError error) {
    if (!is_current(held)) return;
    if (error) return lose(held, error.message());
    auto& stream = beast::get_lowest_layer(held->socket);
    ::fcntl(stream.socket().native_handle(), F_SETFD, FD_CLOEXEC);
    ClientError ignored;
    stream.socket().set_option(tcp::no_delay(true), ignored);  // a command is small and must leave at once
    stream.expires_never();
    held->socket.set_option(
        websocket::stream_base::timeout{connect_time, duration_of(settings.silence_s), true});
    held->socket.read_message_max(rosbridge::max_message_bytes);
    held->socket.async_handshake(settings.address.authority(), settings.address.target,
                                 [this, held](ClientError failure) { opened(held, failure); });
  }

  void opened(const Held& held, ClientError error) {
    if (!is_current(held)) return;
    if (error == websocket::error::upgrade_declined)
      return lose(held,
                  "the server there is no rosbridge server, or refuses this client (a token may be missing)");
    if (error) return lose(held, error.message());
    held->open = true;
    retry_s = settings.first_retry_s;
    {
      const std::lock_guard lock(mutex);
      why.clear();
      ++opened_count;
    }
    log.add("connected to " + where());
    if (handlers.connected) handlers.connected();
    read_next(held);
  }

  void read_next(const Held& held) {
    held->socket.async_read(held->incoming, [this, held](ClientError error, std::size_t) {
      if (!is_current(held)) return;
      if (error) return lose(held, error == beast::error::timeout ? "silent for too long" : error.message());
      const auto bytes = held->incoming.cdata();
      const std::string message(static_cast<const char*>(bytes.data()), bytes.size());
      held->incoming.consume(held->incoming.size());
      take(held, message);
      if (is_current(held) && held->open) read_next(held);
    });
  }

  /// A message that is not valid is said and skipped.
  void take(const Held& held, const std::string& message) {
    try {
      rosbridge::Operation operation = rosbridge::parse(message);
      if (const auto* fragment = std::get_if<rosbridge::Fragment>(&operation)) {
        const std::optional<std::string> whole = held->fragments.add(*fragment);
        if (!whole) return;
        operation = rosbridge::parse(*whole);
      }
      if (handlers.received) handlers.received(operation);
    } catch (const std::exception& error) {
      log.add(fmt::format("a message of {} was skipped: {}", where(), error.what()));
    }
  }

  void queue(LiveMessage message) {
    if (!connection || !connection->open || ending) return;
    if (!connection->outbox.push(std::move(message))) return lose(connection, "it does not read");
    write_next(connection);
  }

  void write_next(const Held& held) {
    if (held->writing || !held->open) return;
    held->writing = held->outbox.pop();
    if (!held->writing) return;
    held->socket.text(true);
    held->socket.async_write(net::buffer(*held->writing->body), [this, held](ClientError error, std::size_t) {
      held->writing.reset();
      if (!error && (is_current(held) || ending)) write_next(held);
      if (ending && !held->writing) close_for_good();
    });
  }

  void lose(Held held, const std::string& reason) {
    if (!held || !is_current(held)) return;
    const bool was_open = std::exchange(held->open, false);
    ClientError ignored;
    beast::get_lowest_layer(held->socket).socket().close(ignored);
    connection.reset();
    {
      const std::lock_guard lock(mutex);
      why = fmt::format("{} to {}: {}", was_open ? "lost the connection" : "no connection", where(), reason);
    }
    log.add(why);
    retry.expires_after(duration_of(retry_s));
    retry_s = std::min(2 * retry_s, settings.last_retry_s);
    retry.async_wait([this](ClientError error) {
      if (!error && !ending) connect();
    });
    if (was_open && handlers.disconnected) handlers.disconnected();
  }

  void beat() {
    heartbeat.expires_after(duration_of(settings.heartbeat_s));
    heartbeat.async_wait([this](ClientError error) {
      if (error || ending) return;
      beat();  // first: a handler that fails must not end the heartbeat
      if (handlers.heartbeat) handlers.heartbeat();
    });
  }

  /// What waits to be written is written first, such as the last command.
  void end() {
    ending = true;
    if (!connection || !connection->open || (!connection->writing && connection->outbox.messages() == 0))
      return close_for_good();
    farewell.expires_after(std::chrono::milliseconds(200));
    farewell.async_wait([this](ClientError) { close_for_good(); });
  }

  void close_for_good() {
    ClientError ignored;
    if (connection) beast::get_lowest_layer(connection->socket).socket().close(ignored);
    context.stop();
  }

  RosbridgeClientSettings settings;
  RosbridgeClientHandlers handlers;
  RefusalLog log;
  net::io_context context{1};
  tcp::resolver resolver{context};
  net::steady_timer retry{context}, heartbeat{context}, farewell{context};
  Held connection;
  double retry_s = 0.1;
  bool ending = false;
  std::thread thread;

  mutable std::mutex mutex;  ///< of what follows
  std::string why = "not connected yet";
  std::uint64_t opened_count = 0;
};

RosbridgeClient::RosbridgeClient(RosbridgeClientSettings settings, RosbridgeClientHandlers handlers)
    : implementation_(std::make_unique<Implementation>(std::move(settings), std::move(handlers))) {
  implementation_->retry_s = implementation_->settings.first_retry_s;
}

void RosbridgeClient::start() { implementation_->start(); }

RosbridgeClient::~RosbridgeClient() {
  if (!implementation_->thread.joinable()) return;
  net::post(implementation_->context, [this] { implementation_->end(); });
  implementation_->thread.join();
}

void RosbridgeClient::send(std::string json, std::string_view replaces) {
  LiveMessage message{std::make_shared<const std::string>(std::move(json))};
  message.replaces = replaces;
  net::post(implementation_->context,
            [this, message = std::move(message)]() mutable { implementation_->queue(std::move(message)); });
}

bool RosbridgeClient::is_connected() const { return problem().empty(); }

std::uint64_t RosbridgeClient::connections() const {
  const std::lock_guard lock(implementation_->mutex);
  return implementation_->opened_count;
}

std::string RosbridgeClient::problem() const {
  const std::lock_guard lock(implementation_->mutex);
  return implementation_->why;
}

}  // namespace incognita
