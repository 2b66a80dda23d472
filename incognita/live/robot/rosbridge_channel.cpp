#include "incognita/live/robot/rosbridge_channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

using namespace rosbridge;

constexpr std::size_t most_subscriptions = 100;  // of one client

}  // namespace

RosbridgeChannel::RosbridgeChannel(std::map<std::string, std::string> topics,
                                   RosbridgeChannelHandlers handlers)
    : topics_(std::move(topics)), handlers_(std::move(handlers)) {}

void RosbridgeChannel::publish(const std::string& topic, std::string msg) {
  server_->post([this, topic, msg = std::move(msg)] { deliver(topic, msg); });
}

void RosbridgeChannel::joined(std::uint64_t id, Viewer& viewer) { clients_[id].viewer = &viewer; }

void RosbridgeChannel::left(std::uint64_t id) {
  clients_.erase(id);
  if (handlers_.left) handlers_.left(id);
  const std::map<std::string, std::string> before = wanted_;
  for (const auto& [topic, type] : before) note_wanted(topic, type);
}

void RosbridgeChannel::received(std::uint64_t id, std::string_view message, bool binary) {
  Client& client = clients_.at(id);
  if (binary)
    return send_status(client, "error", "binary messages (CBOR, BSON) are not read here; send JSON");
  try {
    const std::optional<Operation> operation = read(id, client, message);
    if (operation) carry_out(id, client, *operation);
  } catch (const InputError& error) {
    send_status(client, "error", error.what());
  }
}

/// None while fragments are missing.
std::optional<Operation> RosbridgeChannel::read(std::uint64_t id, Client& client, std::string_view message) {
  try {
    Operation operation = parse(message);
    const auto* fragment = std::get_if<Fragment>(&operation);
    if (!fragment) return operation;
    const std::optional<std::string> whole = client.fragments.add(*fragment);
    if (!whole) return std::nullopt;
    return parse(*whole);
  } catch (const InputError&) {
    if (handlers_.unreadable) handlers_.unreadable(id);
    throw;
  }
}

void RosbridgeChannel::carry_out(std::uint64_t id, Client& client, const Operation& operation) {
  if (const auto* publish = std::get_if<Publish>(&operation)) {
    if (handlers_.published) handlers_.published(id, *publish);
  } else if (const auto* wish = std::get_if<Subscribe>(&operation)) {
    subscribe(client, *wish);
  } else if (const auto* end = std::get_if<Unsubscribe>(&operation)) {
    unsubscribe(client, *end);
  } else if (const auto* advertised = std::get_if<Advertise>(&operation)) {
    check_type(client, advertised->topic, advertised->type, advertised->id);
  } else if (const auto* call = std::get_if<CallService>(&operation)) {
    send(client, refused_call(*call, "there are no services here"));
  } else if (const auto* other = std::get_if<OtherOperation>(&operation)) {
    if (other->op != "set_level")
      send_status(client, "error", "operation " + other->op + " is not known here", other->id);
  }
}

/// Says that a type is not that of the topic.
void RosbridgeChannel::check_type(Client& client, const std::string& topic, const std::string& type,
                                  const std::string& id) const {
  const auto known = topics_.find(topic);
  if (known == topics_.end() || same_type(known->second, type)) return;
  if (same_type(known->second, "geometry_msgs/Twist") && same_type(type, "geometry_msgs/TwistStamped"))
    return;
  send_status(client, "error",
              fmt::format("topic {} has type {}, not {}", topic, known->second, type.substr(0, 100)), id);
}

void RosbridgeChannel::subscribe(Client& client, const Subscribe& wish) {
  if (client.subscriptions.size() >= most_subscriptions)
    return send_status(client, "error", fmt::format("a client may have {} subscriptions", most_subscriptions),
                       wish.id);
  check_type(client, wish.topic, wish.type, wish.id);
  if (wish.compression != "none")
    send_status(
        client, "warning",
        "compression " + wish.compression.substr(0, 20) + " is not known here: messages are sent without",
        wish.id);
  unsubscribe(client, {wish.topic, wish.id.empty() ? "-" : wish.id});  // the same wish again replaces it
  client.subscriptions.push_back({wish});
  note_wanted(wish.topic, wish.type);
}

void RosbridgeChannel::unsubscribe(Client& client, const Unsubscribe& wish) {
  std::erase_if(client.subscriptions, [&](const Subscription& subscription) {
    const std::string& id = subscription.wish.id;
    return subscription.wish.topic == wish.topic && (wish.id.empty() || (id.empty() ? "-" : id) == wish.id);
  });
  note_wanted(wish.topic, "");
}

void RosbridgeChannel::note_wanted(const std::string& topic, const std::string& type) {
  const bool now = std::ranges::any_of(clients_, [&](const auto& client) {
    return std::ranges::any_of(client.second.subscriptions,
                               [&](const Subscription& s) { return s.wish.topic == topic; });
  });
  const auto before = wanted_.find(topic);
  if (now && before == wanted_.end()) {
    wanted_[topic] = type;
    if (handlers_.wanted) handlers_.wanted(topic, type);
  } else if (!now && before != wanted_.end()) {
    const std::string ended_type = before->second;
    wanted_.erase(before);
    if (handlers_.unwanted) handlers_.unwanted(topic, ended_type);
  }
}

void RosbridgeChannel::deliver(const std::string& topic, const std::string& msg) {
  if (!wanted_.contains(topic)) return;
  const auto message = std::make_shared<const std::string>(to_json(Publish{topic, msg}));
  for (auto& [id, client] : clients_) deliver_to(client, topic, message);
}

/// Several subscriptions of one client share the messages: the shortest interval, the shortest fragments, the longest queue, as
/// Section 3.2.4 of the protocol says.
void RosbridgeChannel::deliver_to(Client& client, const std::string& topic,
                                  const std::shared_ptr<const std::string>& message) {
  int throttle_ms = -1, fragment_bytes = 0, queue_length = 0;
  Clock::time_point sent{};
  for (const Subscription& s : client.subscriptions) {
    if (s.wish.topic != topic) continue;
    throttle_ms = throttle_ms < 0 ? s.wish.throttle_ms : std::min(throttle_ms, s.wish.throttle_ms);
    if (s.wish.fragment_bytes > 0)
      fragment_bytes =
          fragment_bytes == 0 ? s.wish.fragment_bytes : std::min(fragment_bytes, s.wish.fragment_bytes);
    queue_length = std::max(queue_length, s.wish.queue_length);
    sent = std::max(sent, s.sent);
  }
  const auto now = Clock::now();
  if (throttle_ms < 0 || now - sent < std::chrono::milliseconds(throttle_ms)) return;
  for (Subscription& s : client.subscriptions)
    if (s.wish.topic == topic) s.sent = now;
  if (fragment_bytes > 0) {
    const auto parts =
        in_fragments(*message, static_cast<std::size_t>(fragment_bytes), std::to_string(next_fragment_++));
    for (const std::string& part : parts) send(client, part);
    return;
  }
  LiveMessage out{message};
  out.droppable = true;
  const auto known = topics_.find(topic);
  if (queue_length <= 1 && known != topics_.end()) out.replaces = known->first;
  client.viewer->send(std::move(out));
}

void RosbridgeChannel::send(Client& client, std::string json) {
  client.viewer->send({std::make_shared<const std::string>(std::move(json))});
}

void RosbridgeChannel::send_status(Client& client, const char* level, const std::string& msg,
                                   const std::string& id) {
  send(client, to_json(Status{level, msg.substr(0, 300), id}));
}

}  // namespace incognita
