// A camera of the network as many are: JPEG images over HTTP, multipart/x-mixed-replace, to one viewer at a time.
#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace incognita::testing {

class MjpegServer {
 public:
  /// One connection. Everything is false once the viewer has gone or the server is to end.
  class Viewer {
   public:
    Viewer(int socket, const std::atomic<bool>& stop) : socket_(socket), stop_(stop) {}

    bool accept_request() { return answer("200 OK", "multipart/x-mixed-replace;boundary=cut"); }
    bool refuse(const std::string& status) {
      const std::string page = "<html>" + status + "</html>";
      return answer(status, "text/html\r\nContent-Length: " + std::to_string(page.size())) && send(page);
    }
    /// Without its length, and always from its begin.
    bool send_file(const std::string& type, const std::string& bytes) {
      return answer("200 OK", type) && send(bytes);
    }
    bool send_image(const std::string& jpeg) {
      return send("--cut\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size()) +
                  "\r\n\r\n" + jpeg + "\r\n");
    }
    bool wait_for(double s) const {
      const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(s);
      while (!stop_ && std::chrono::steady_clock::now() < until) {
        pollfd gone{socket_, POLLRDHUP, 0};
        if (::poll(&gone, 1, 0) > 0) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
      return !stop_;
    }

    /// A request; empty once none comes any more.
    std::string receive() {
      char request[4096];
      const ssize_t size = ::recv(socket_, request, sizeof request, 0);
      return {request, static_cast<std::size_t>(size > 0 ? size : 0)};
    }
    bool send(const std::string& bytes) {
      for (std::size_t sent = 0; sent < bytes.size();) {
        const ssize_t more = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (more <= 0) return false;
        sent += static_cast<std::size_t>(more);
      }
      return !stop_;
    }

   private:
    bool answer(const std::string& status, const std::string& type) {
      if (receive().empty()) return false;
      return send("HTTP/1.1 " + status + "\r\nConnection: close\r\nContent-Type: " + type + "\r\n\r\n");
    }
    int socket_;
    const std::atomic<bool>& stop_;
  };

  /// `serve` is called for each connection, in a thread of the server, and the connection ends with it.
  explicit MjpegServer(std::function<void(Viewer&)> serve) : serve_(std::move(serve)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    auto* any = reinterpret_cast<sockaddr*>(&address);
    socklen_t size = sizeof address;
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (::bind(socket_, any, size) != 0 || ::listen(socket_, 8) != 0 ||
        ::getsockname(socket_, any, &size) != 0)
      throw std::runtime_error("no port for the server of images");
    host_ = "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    thread_ = std::thread([this] { accept_all(); });
  }
  ~MjpegServer() {
    stop_ = true;
    thread_.join();
    ::close(socket_);
  }
  MjpegServer(const MjpegServer&) = delete;
  MjpegServer& operator=(const MjpegServer&) = delete;

  std::string address() const { return "http://" + host_ + "/video"; }
  const std::string& host() const { return host_; }

 private:
  void accept_all() {
    while (!stop_) {
      pollfd comes{socket_, POLLIN, 0};
      if (::poll(&comes, 1, 20) <= 0) continue;
      const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
      if (connection < 0) continue;
      Viewer viewer(connection, stop_);
      serve_(viewer);
      ::close(connection);
    }
  }

  std::function<void(Viewer&)> serve_;
  int socket_ = -1;
  std::string host_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace incognita::testing
