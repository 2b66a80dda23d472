// A page that shows one state: viewers receive the newest one, and send commands.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "incognita/live/server.hpp"

namespace incognita {

class StateChannel final : public ViewerProtocol {
 public:
  /// `command`: called in the server's thread for each text of a viewer; its InputError is answered with
  /// {"type": "refused", "message"}.
  explicit StateChannel(std::function<void(std::string_view)> command) : command_(std::move(command)) {}

  /// To be called once, before the first state.
  void attach(Server& server) { server_ = &server; }

  /// From any thread: the state for all viewers, and for those who join. It replaces a state that waits. `json`: with a field "type".
  void put(std::string json);

  // From the server's thread:
  void joined(std::uint64_t id, Viewer& viewer) override;
  void left(std::uint64_t id) override { viewers_.erase(id); }
  void received(std::uint64_t id, std::string_view message, bool binary) override;

 private:
  std::function<void(std::string_view)> command_;
  Server* server_ = nullptr;

  // Of the server's thread
  std::map<std::uint64_t, Viewer*> viewers_;
  std::shared_ptr<const std::string> state_;
};

}  // namespace incognita
