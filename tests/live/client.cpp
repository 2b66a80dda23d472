#include "tests/live/client.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>

namespace incognita::testing {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
namespace net = boost::asio;
using tcp = net::ip::tcp;

tcp::endpoint server_at(std::uint16_t port) { return {net::ip::make_address("127.0.0.1"), port}; }
std::string host_at(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

}  // namespace

Reply get(std::uint16_t port, const std::string& target, const Headers& headers, const std::string& method) {
  net::io_context context;
  beast::tcp_stream stream(context);
  stream.connect(server_at(port));
  http::request<http::empty_body> request(http::string_to_verb(method), target, 11);
  request.set(http::field::host, host_at(port));
  request.set(http::field::connection, "close");
  for (const auto& [name, value] : headers) request.set(name, value);
  beast::error_code error;
  http::write(stream, request, error);
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.skip(method == "HEAD");
  http::read(stream, buffer, parser, error);
  if (error) return {};
  const auto response = parser.release();
  return {static_cast<int>(response.result_int()), response.body(),
          std::string(response[http::field::content_type])};
}

struct WebSocketClient::Implementation {
  net::io_context context;
  websocket::stream<beast::tcp_stream> socket{context};
};

WebSocketClient::WebSocketClient(std::uint16_t port, const std::string& target,
                                 const std::string& subprotocol, const Headers& headers)
    : implementation_(std::make_unique<Implementation>()) {
  auto& socket = implementation_->socket;
  beast::get_lowest_layer(socket).connect(server_at(port));
  std::string host = host_at(port);
  for (const auto& [name, value] : headers)
    if (name == "Host") host = value;
  socket.set_option(websocket::stream_base::decorator([&](websocket::request_type& request) {
    if (!subprotocol.empty()) request.set(http::field::sec_websocket_protocol, subprotocol);
    for (const auto& [name, value] : headers) request.set(name, value);
  }));
  websocket::response_type response;
  beast::error_code error;
  socket.handshake(response, host, target, error);
  status_ = error ? 0 : 101;
  if (error != websocket::error::upgrade_declined) return;
  Headers asked{{"Upgrade", "websocket"},
                {"Connection", "Upgrade"},
                {"Sec-WebSocket-Key", "dGhlIHNhbXBsZSBub25jZQ=="},
                {"Sec-WebSocket-Version", "13"}};
  if (!subprotocol.empty()) asked.emplace_back("Sec-WebSocket-Protocol", subprotocol);
  asked.insert(asked.end(), headers.begin(), headers.end());
  status_ = get(port, target, asked).status;  // the library does not say why the server declined
}

WebSocketClient::~WebSocketClient() = default;
WebSocketClient::WebSocketClient(WebSocketClient&&) noexcept = default;

bool WebSocketClient::send(const std::string& text) {
  beast::error_code error;
  implementation_->socket.text(true);
  implementation_->socket.write(net::buffer(text), error);
  return !error;
}

std::optional<std::string> WebSocketClient::receive() {
  beast::flat_buffer buffer;
  bool read = false;
  implementation_->socket.async_read(buffer, [&](beast::error_code error, std::size_t) { read = !error; });
  implementation_->context.restart();
  implementation_->context.run_for(std::chrono::seconds(2));
  if (!read) return std::nullopt;
  return beast::buffers_to_string(buffer.data());
}

bool WebSocketClient::last_was_binary() const { return implementation_->socket.got_binary(); }

RawConnection::RawConnection(std::uint16_t port, const std::string& from)
    : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in own{}, address{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = inet_addr(from.c_str());
  [[maybe_unused]] const int bound = bind(descriptor_, reinterpret_cast<const sockaddr*>(&own), sizeof(own));
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (connect(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0) return;
  close(descriptor_);
  descriptor_ = -1;
}

RawConnection::~RawConnection() {
  if (descriptor_ >= 0) close(descriptor_);
}

void RawConnection::send(const std::string& bytes) const {
  [[maybe_unused]] const auto sent = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

bool RawConnection::is_closed_within(double s) const {
  if (descriptor_ < 0) return true;
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(s);
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - std::chrono::steady_clock::now());
    if (left.count() <= 0) return false;
    pollfd waiting{descriptor_, POLLIN, 0};
    if (poll(&waiting, 1, static_cast<int>(left.count())) <= 0) continue;
    char bytes[4096];
    if (recv(descriptor_, bytes, sizeof(bytes), 0) <= 0) return true;
  }
}

}  // namespace incognita::testing
