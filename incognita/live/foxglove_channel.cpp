#include "incognita/live/foxglove_channel.hpp"

#include <algorithm>
#include <utility>

#include "incognita/live/foxglove_messages.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

constexpr std::size_t most_subscriptions = 100;  // of one client

std::size_t index_of(const Topic& topic) { return static_cast<std::size_t>(&topic - all_topics().data()); }

using Subscriptions = std::map<std::uint32_t, std::size_t>;

bool want(const Subscriptions& subscriptions, const Topic& topic) {
  return std::any_of(subscriptions.begin(), subscriptions.end(),
                     [&](const auto& entry) { return entry.second == index_of(topic); });
}

void send_to(Viewer& viewer, const Subscriptions& subscriptions, const Topic& topic, std::uint64_t time_ns,
             const std::shared_ptr<const std::string>& body) {
  for (const auto& [subscription, index] : subscriptions) {
    if (index != index_of(topic)) continue;
    LiveMessage out{body, foxglove::message_header(subscription, time_ns)};
    out.binary = out.droppable = true;
    viewer.send(std::move(out));
  }
}

/// A single client.
struct OneClient final : TopicSink {
  OneClient(Viewer& to, const Subscriptions& those) : viewer(to), subscriptions(those) {}
  bool wants(const Topic& topic) const override { return want(subscriptions, topic); }
  void put(const Topic& topic, std::uint64_t time_ns, std::string message) override {
    send_to(viewer, subscriptions, topic, time_ns, std::make_shared<const std::string>(std::move(message)));
  }
  Viewer& viewer;
  const Subscriptions& subscriptions;
};

}  // namespace

void FoxgloveChannel::begin(const RunInfo& info) {
  mailbox_ = std::make_shared<Waiting>(most_waiting);
  server_->post([this, info] {
    topics_.emplace(info);
    last_.reset();
    ++session_;
    for (auto& [id, client] : clients_) {
      send(*client.viewer, foxglove::server_info(std::to_string(session_)));
    }
  });
}

void FoxgloveChannel::publish(std::shared_ptr<const Snapshot> snapshot) {
  if (mailbox_->put(std::move(snapshot))) server_->post([this, mailbox = mailbox_] { deliver(*mailbox); });
}

void FoxgloveChannel::deliver(Waiting& mailbox) {
  auto taken = mailbox.take();
  for (auto& [id, client] : clients_) client.viewer->add_dropped(taken.dropped);
  for (auto& snapshot : taken.values) {
    last_ = std::move(snapshot);
    if (topics_ && !clients_.empty()) topics_->publish(*last_, *this);
  }
}

bool FoxgloveChannel::wants(const Topic& topic) const {
  return std::any_of(clients_.begin(), clients_.end(),
                     [&](const auto& client) { return want(client.second.topics, topic); });
}

void FoxgloveChannel::put(const Topic& topic, std::uint64_t time_ns, std::string message) {
  const auto body = std::make_shared<const std::string>(std::move(message));
  for (auto& [id, client] : clients_) send_to(*client.viewer, client.topics, topic, time_ns, body);
}

void FoxgloveChannel::send(Viewer& viewer, std::string json) {
  viewer.send({std::make_shared<const std::string>(std::move(json))});
}

void FoxgloveChannel::joined(std::uint64_t id, Viewer& viewer) {
  clients_[id] = {&viewer};
  send(viewer, foxglove::server_info(std::to_string(session_)));
  send(viewer, foxglove::advertise(all_topics()));
}

void FoxgloveChannel::left(std::uint64_t id) { clients_.erase(id); }

void FoxgloveChannel::change_subscriptions(Client& client, std::string_view message) {
  const foxglove::Request asked = foxglove::request(message);
  for (const std::uint32_t subscription : asked.unsubscribe) client.topics.erase(subscription);
  Client subscribed{client.viewer};
  for (const auto& [subscription, channel] : asked.subscribe) {
    if (channel >= all_topics().size()) throw InputError("there is no channel " + std::to_string(channel));
    if (client.topics.size() >= most_subscriptions)
      throw InputError("at most 100 subscriptions are possible");
    subscribed.topics[subscription] = client.topics[subscription] = channel;
  }
  repeat_last_to(subscribed);
}

/// With all that is due once or rarely: a paused run has no next snapshot soon.
void FoxgloveChannel::repeat_last_to(const Client& newly_subscribed) {
  if (newly_subscribed.topics.empty() || !topics_ || !last_) return;
  SnapshotTopics once = *topics_;
  once.repeat();
  OneClient sink(*newly_subscribed.viewer, newly_subscribed.topics);
  once.publish(*last_, sink);
}

void FoxgloveChannel::received(std::uint64_t id, std::string_view message, bool binary) {
  const auto client = clients_.find(id);
  if (client == clients_.end()) return;
  try {
    if (binary) throw InputError("this server takes no binary messages");
    change_subscriptions(client->second, message);
  } catch (const InputError& error) {
    send(*client->second.viewer, foxglove::status(2, error.what()));
  }
}

}  // namespace incognita
