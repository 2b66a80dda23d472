#include "incognita/live/state_channel.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

LiveMessage state_message(const std::shared_ptr<const std::string>& state) {
  LiveMessage message{state};
  message.replaces = "state";
  return message;
}

}  // namespace

void StateChannel::put(std::string json) {
  server_->post([this, state = std::make_shared<const std::string>(std::move(json))] {
    state_ = state;
    for (const auto& [id, viewer] : viewers_) viewer->send(state_message(state_));
  });
}

void StateChannel::joined(std::uint64_t id, Viewer& viewer) {
  viewers_[id] = &viewer;
  if (state_) viewer.send(state_message(state_));
}

void StateChannel::received(std::uint64_t id, std::string_view message, bool binary) {
  try {
    if (binary) throw InputError("a command must be a text");
    command_(message);
  } catch (const InputError& error) {
    const nlohmann::json refused{{"type", "refused"}, {"message", error.what()}};
    viewers_.at(id)->send({std::make_shared<const std::string>(
        refused.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))});
  }
}

}  // namespace incognita
