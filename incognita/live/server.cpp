#include "incognita/live/server.hpp"

#include <fcntl.h>

#include <algorithm>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/ssl.hpp>
#include <boost/beast/websocket.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <chrono>
#include <optional>
#include <set>
#include <thread>
#include <type_traits>
#include <utility>

#include "incognita/live/connections.hpp"
#include "incognita/live/refusal_log.hpp"
#include "incognita/live/url.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
namespace net = boost::asio;
namespace ssl = net::ssl;
using tcp = net::ip::tcp;
using Plain = beast::tcp_stream;
using Encrypted = beast::ssl_stream<beast::tcp_stream>;
using Error = beast::error_code;

constexpr std::size_t most_header_bytes = 8u << 10;
constexpr std::chrono::seconds request_time{10};  // to send a whole request
constexpr const char* security_policy =
    "default-src 'self'; connect-src 'self' ws: wss:; img-src 'self' blob: data:; style-src 'self' 'unsafe-inline'; "
    "object-src 'none'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

std::string words(const Error& error) { return error.message(); }

std::string origin_of(const tcp::socket& socket) {
  Error error;
  const auto end = socket.remote_endpoint(error);
  return error ? "a closed connection" : end.address().to_string();
}

/// A browser or gnuplot that the program starts must not keep a port open.
template <class Socket>
void close_in_children(Socket& socket) {
  ::fcntl(socket.native_handle(), F_SETFD, FD_CLOEXEC);
}

/// What all connections share; used in the server's thread only.
struct Shared {
  ServerSettings settings;
  ServerHandlers handlers;
  RefusalLog log;
  Connections connections{settings.max_connections, settings.max_strangers};
  std::uint64_t next_id = 1;
};

class Session {
 public:
  virtual ~Session() = default;
  /// Without a farewell: for a viewer that does not read, and at the end of the program.
  virtual void disconnect() = 0;
};
using Sessions = std::set<std::shared_ptr<Session>>;

/// A viewer. Stays in `sessions` until its connection ends.
template <class Stream>
class WebSocketSession final : public Viewer,
                               public Session,
                               public std::enable_shared_from_this<WebSocketSession<Stream>> {
 public:
  WebSocketSession(Stream stream, Connections::Place place, Shared& shared, Sessions& sessions,
                   std::string subprotocol, std::shared_ptr<ViewerProtocol> protocol)
      : socket_(std::move(stream)),
        place_(std::move(place)),
        shared_(shared),
        sessions_(sessions),
        subprotocol_(std::move(subprotocol)),
        protocol_(std::move(protocol)),
        id_(shared.next_id++),
        outbox_(shared.settings.outbox) {}

  void run(const http::request<http::string_body>& request) {
    beast::get_lowest_layer(socket_).expires_never();  // the WebSocket has its own time limits
    websocket::stream_base::timeout limits{request_time, std::chrono::seconds(shared_.settings.idle_s), true};
    socket_.set_option(limits);
    socket_.set_option(websocket::stream_base::decorator([this](websocket::response_type& response) {
      if (!subprotocol_.empty()) response.set(http::field::sec_websocket_protocol, subprotocol_);
    }));
    socket_.read_message_max(largest_message_bytes());
    sessions_.insert(this->shared_from_this());
    socket_.async_accept(request, [self = this->shared_from_this()](Error error) { self->accepted(error); });
  }

  void send(LiveMessage message) override {
    if (closing_) return;
    if (!outbox_.push(std::move(message))) {
      shared_.log.add("a viewer was disconnected: it does not read, and more messages wait than may");
      return disconnect();
    }
    write_next();
  }

  void add_dropped(std::uint64_t count) override { outbox_.add_dropped(count); }

  void disconnect() override {
    closing_ = true;
    Error ignored;
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

 private:
  void accepted(Error error) {
    if (error) return leave(error);
    joined_ = true;
    protocol_->joined(id_, *this);
    read_next();
  }

  void read_next() {
    socket_.async_read(incoming_,
                       [self = this->shared_from_this()](Error error, std::size_t) { self->read(error); });
  }

  void read(Error error) {
    if (error) return leave(error);
    const auto bytes = incoming_.cdata();
    const std::string message(static_cast<const char*>(bytes.data()), bytes.size());
    incoming_.consume(incoming_.size());
    try {
      protocol_->received(id_, message, socket_.got_binary());
    } catch (const std::exception& failure) {
      shared_.log.add(std::string("a viewer was disconnected: its message failed: ") + failure.what());
      disconnect();
    }
    if (!closing_) return read_next();
    leave({});
  }

  void write_next() {
    if (writing_ || !joined_) return;
    writing_ = outbox_.pop();
    if (!writing_) return;
    if (writing_->counts_drops) writing_->prefix += std::to_string(outbox_.dropped());
    socket_.binary(writing_->binary);
    const std::array<net::const_buffer, 2> parts{net::buffer(writing_->prefix), net::buffer(*writing_->body)};
    socket_.async_write(parts, [self = this->shared_from_this()](Error error, std::size_t) {
      self->writing_.reset();
      if (!error && !self->closing_) self->write_next();
    });
  }

  void leave(Error error) {
    closing_ = true;
    if (error == websocket::error::message_too_big)
      shared_.log.add("a message was refused: it has more than " + std::to_string(largest_message_bytes()) +
                      " bytes");
    else if (error == beast::error::timeout)
      shared_.log.add("a viewer was disconnected: it was silent for " +
                      std::to_string(shared_.settings.idle_s) + " s");
    if (std::exchange(joined_, false)) protocol_->left(id_);
    sessions_.erase(this->shared_from_this());
  }

  std::size_t largest_message_bytes() const {
    const std::size_t of_protocol = protocol_->largest_message_bytes();
    return of_protocol > 0 ? of_protocol : shared_.settings.max_message_bytes;
  }

  websocket::stream<Stream> socket_;
  Connections::Place place_;
  Shared& shared_;
  Sessions& sessions_;
  std::string subprotocol_;
  std::shared_ptr<ViewerProtocol> protocol_;
  std::uint64_t id_;
  beast::flat_buffer incoming_;
  Outbox outbox_;
  std::optional<LiveMessage> writing_;
  bool joined_ = false, closing_ = false;
};

/// Answers requests until one asks for a WebSocket, or the client leaves.
template <class Stream>
class HttpSession : public std::enable_shared_from_this<HttpSession<Stream>> {
 public:
  HttpSession(Stream stream, Shared& shared, Sessions& sessions)
      : from_(origin_of(beast::get_lowest_layer(stream).socket())),
        stream_(std::move(stream)),
        place_(shared.connections, from_, [this] { give_way(); }),
        shared_(shared),
        sessions_(sessions) {}

  void run() {
    if constexpr (std::is_same_v<Stream, Encrypted>) {
      beast::get_lowest_layer(stream_).expires_after(request_time);
      stream_.async_handshake(ssl::stream_base::server, [self = this->shared_from_this()](Error error) {
        if (!error) return self->read_next();
        if (self->has_given_way_) return;
        self->shared_.log.add("a connection of " + self->from_ +
                              " was refused: it is not encrypted as it must be (" + words(error) +
                              "); open the address with https, and accept the certificate");
      });
    } else {
      read_next();
    }
  }

 private:
  using Parser = http::request_parser<http::string_body>;
  using Response = http::response<http::string_body>;

  void read_next() {
    parser_.emplace();
    parser_->header_limit(most_header_bytes);
    parser_->body_limit(0);
    beast::get_lowest_layer(stream_).expires_after(request_time);
    http::async_read(stream_, buffer_, *parser_,
                     [self = this->shared_from_this()](Error error, std::size_t) { self->read(error); });
  }

  /// To a connection with more right to be there.
  void give_way() {
    has_given_way_ = true;
    beast::get_lowest_layer(stream_).close();
  }

  void read(Error error) {
    if (has_given_way_) return;
    if (error == http::error::end_of_stream || error == ssl::error::stream_truncated) return close();
    if (error == beast::error::timeout) {
      if (asked_) return;  // a connection that was kept for further requests
      return shared_.log.add("a connection of " + from_ + " was closed: no whole request in " +
                             std::to_string(request_time.count()) + " s");
    }
    if (error == http::error::header_limit || error == http::error::body_limit ||
        error == http::error::buffer_overflow)
      return refuse(413, "the request is too large");
    if (error) return refuse(400, "the request is not valid HTTP: " + words(error));
    asked_ = true;
    answer(parser_->release());
  }

  void answer(http::request<http::string_body> request) {
    const auto target = parse_target(view_of(request.target()));
    if (!target) return refuse(400, "the address of the request is not valid");
    const HttpRequest asked{target->path, target->query};
    const std::string why = refusal_of(
        {view_of(request[http::field::host]), view_of(request[http::field::origin]), asked.parameter("token"),
         view_of(request["Sec-Fetch-Site"]), std::is_same_v<Stream, Encrypted>},
        shared_.settings.access);
    why.empty() ? place_.trust() : place_.renew();
    if (websocket::is_upgrade(request)) return upgrade(request, asked, why);
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return refuse(405, "only GET is possible");
    const bool head = request.method() == http::verb::head, keep_alive = request.keep_alive();
    try {
      if (const auto page = public_answer(asked)) return respond(*page, head, keep_alive);
      if (!why.empty()) return refuse(403, why);
      respond(shared_.handlers.answer(asked), head, keep_alive);
    } catch (const std::exception& failure) {
      refuse(500, std::string("the answer failed: ") + failure.what());
    }
  }

  std::optional<HttpAnswer> public_answer(const HttpRequest& asked) const {
    return shared_.handlers.public_answer ? shared_.handlers.public_answer(asked) : std::nullopt;
  }

  void upgrade(const http::request<http::string_body>& request, const HttpRequest& asked,
               const std::string& why) {
    if (!why.empty()) return refuse(403, why);
    if (asked.path != shared_.settings.websocket_path)
      return refuse(404, "WebSockets are at " + shared_.settings.websocket_path);
    if (buffer_.size() > 0)
      return refuse(400,
                    "data follow the request for a WebSocket; wait for its answer (RFC 6455, Section 4.1)");
    const std::string offered(view_of(request[http::field::sec_websocket_protocol]));
    for (const auto& [name, protocol] : shared_.handlers.protocols) {
      if (name.empty() ? !offered.empty() : !http::token_list(offered).exists(name)) continue;
      std::make_shared<WebSocketSession<Stream>>(std::move(stream_), std::move(place_), shared_, sessions_,
                                                 name, protocol)
          ->run(request);
      return;
    }
    refuse(400, "no WebSocket subprotocol of this program is offered: \"" + offered.substr(0, 100) + "\"");
  }

  void refuse(int status, const std::string& why) {
    shared_.log.add("a request of " + from_ + " was refused: " + why);
    std::string quoted;  // as JSON; everything unusual becomes a question mark
    for (const char c : why)
      quoted += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c < ' ' || c > '~' ? '?' : c);
    HttpAnswer answer;
    answer.status = status;
    answer.body = std::make_shared<const std::string>("{\"error\": \"" + quoted + "\"}");
    respond(answer, false, false);
  }

  void respond(const HttpAnswer& answer, bool head, bool keep_alive) {
    response_.emplace(static_cast<http::status>(answer.status), 11);
    response_->set(http::field::content_type, answer.content_type);
    response_->set(http::field::cache_control, "no-cache");
    response_->set("X-Content-Type-Options", "nosniff");
    response_->set("Cross-Origin-Resource-Policy", "same-origin");
    response_->set("Content-Security-Policy", security_policy);
    response_->set("Referrer-Policy", "no-referrer");
    if (!answer.location.empty()) response_->set(http::field::location, answer.location);
    response_->keep_alive(keep_alive);
    if (!head && answer.body) response_->body() = *answer.body;
    response_->prepare_payload();
    if (head && answer.body) response_->content_length(answer.body->size());
    beast::get_lowest_layer(stream_).expires_after(request_time);
    http::async_write(stream_, *response_,
                      [self = this->shared_from_this(), keep_alive](Error error, std::size_t) {
                        if (error) return;
                        if (keep_alive) return self->read_next();
                        self->close();
                      });
  }

  void close() {
    if constexpr (std::is_same_v<Stream, Encrypted>) {
      stream_.async_shutdown([self = this->shared_from_this()](Error) {});
    } else {
      Error ignored;
      stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    }
  }

  std::string from_;
  Stream stream_;
  Connections::Place place_;
  Shared& shared_;
  Sessions& sessions_;
  beast::flat_buffer buffer_{2 * most_header_bytes};  // bounds what the limits of the parser do not: chunks
  std::optional<Parser> parser_;
  std::optional<Response> response_;
  bool asked_ = false, has_given_way_ = false;
};

}  // namespace

struct Server::Implementation {
  Implementation(ServerSettings settings, ServerHandlers handlers)
      : shared{std::move(settings), handlers, RefusalLog(handlers.log)} {
    if (encrypts()) read_certificate();
  }

  bool encrypts() const { return !shared.settings.certificate.empty(); }

  void read_certificate() {
    const auto read = [](const std::filesystem::path& file, auto&& use) {
      Error error;
      use(file.string(), error);
      if (error)
        throw InputError(file.string() + ": cannot be used for encryption: " + words(error) +
                         "; remove it, and it is made anew");
    };
    read(shared.settings.certificate,
         [&](const std::string& file, Error& error) { encryption.use_certificate_chain_file(file, error); });
    read(shared.settings.certificate_key, [&](const std::string& file, Error& error) {
      encryption.use_private_key_file(file, ssl::context::pem, error);
    });
  }

  void listen() {
    Error error;
    const auto address = net::ip::make_address(shared.settings.address, error);
    if (error) throw InputError(shared.settings.address + ": is no numerical address, such as 127.0.0.1");
    const tcp::endpoint end(address, shared.settings.port);
    acceptor.open(end.protocol(), error);
    if (!error) acceptor.set_option(net::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(end, error);
    if (!error) acceptor.listen(net::socket_base::max_listen_connections, error);
    if (!error) close_in_children(acceptor);
    if (error)
      throw InputError("cannot listen at " + shared.settings.address + ", port " +
                       std::to_string(shared.settings.port) + ": " + words(error) +
                       "; choose another port, or none for any free one");
    accept();
  }

  void accept() {
    acceptor.async_accept([this](Error error, tcp::socket socket) {
      if (!acceptor.is_open()) return;
      if (error) return retry();
      close_in_children(socket);
      const auto log = [this](const std::string& line) { shared.log.add(line); };
      if (shared.connections.make_room(origin_of(socket), log)) answer(std::move(socket));
      accept();
    });
  }

  void answer(tcp::socket socket) {
    if (encrypts())
      std::make_shared<HttpSession<Encrypted>>(Encrypted(Plain(std::move(socket)), encryption), shared,
                                               sessions)
          ->run();
    else
      std::make_shared<HttpSession<Plain>>(Plain(std::move(socket)), shared, sessions)->run();
  }

  /// A task that fails, such as one that runs out of memory, ends neither the server nor the run.
  void run() {
    for (;;) {
      try {
        context.run();
        return;
      } catch (const std::exception& failure) {
        shared.log.add(std::string("the server failed, and goes on: ") + failure.what());
      }
    }
  }

  /// After a failure such as too many open files.
  void retry() {
    pause.expires_after(std::chrono::milliseconds(100));
    pause.async_wait([this](Error error) {
      if (!error) accept();
    });
  }

  void stop() {
    Error ignored;
    acceptor.close(ignored);
    const Sessions leaving = sessions;
    for (const auto& session : leaving) session->disconnect();
    sessions.clear();  // what still waits in the context goes with it, while `shared` is there
    context.stop();
  }

  Shared shared;
  Sessions sessions;
  ssl::context encryption{ssl::context::tls_server};
  net::io_context context{1};
  tcp::acceptor acceptor{context};
  net::steady_timer pause{context};
  std::thread thread;
};

std::string_view HttpRequest::parameter(std::string_view name) const {
  const auto found =
      std::find_if(query.begin(), query.end(), [&](const auto& pair) { return pair.first == name; });
  return found == query.end() ? std::string_view{} : found->second;
}

Server::Server(ServerSettings settings, ServerHandlers handlers, const std::function<void(Server&)>& ready)
    : implementation_(std::make_unique<Implementation>(std::move(settings), std::move(handlers))) {
  implementation_->listen();
  if (ready) ready(*this);
  implementation_->thread = std::thread([this] { implementation_->run(); });
}

Server::~Server() {
  post([this] { implementation_->stop(); });
  implementation_->thread.join();
}

std::uint16_t Server::port() const { return implementation_->acceptor.local_endpoint().port(); }

std::string Server::address() const {
  const ServerSettings& settings = implementation_->shared.settings;
  const bool v6 = settings.address.find(':') != std::string::npos;
  const std::string& token = settings.access.token;
  return (implementation_->encrypts() ? "https://" : "http://") +
         (v6 ? "[" + settings.address + "]" : settings.address) + ":" + std::to_string(port()) + "/" +
         (token.empty() ? "" : "?token=" + token);
}

void Server::post(std::function<void()> task) { net::post(implementation_->context, std::move(task)); }

void Server::post_after(std::chrono::steady_clock::duration delay, std::function<void()> task) {
  const auto timer = std::make_shared<net::steady_timer>(implementation_->context, delay);
  timer->async_wait([timer, task = std::move(task)](Error error) {
    if (!error) task();
  });
}

}  // namespace incognita
