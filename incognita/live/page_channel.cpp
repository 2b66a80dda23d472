#include "incognita/live/page_channel.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "incognita/messages/errors.hpp"
#include "incognita/record/files/image_text.hpp"
#include "incognita/record/mcap/snapshot_message.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::chrono::milliseconds least_wait{20};  // for drivers that are overdue

std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

LiveMessage message(const Json& json) { return {std::make_shared<const std::string>(text_of(json))}; }

/// The latest replaces those that wait.
LiveMessage refusal(const std::string& of, const std::string& why) {
  LiveMessage refused = message({{"type", "refused"}, {"of", of}, {"message", why}});
  refused.replaces = "refused";
  return refused;
}

Json row_of(const Snapshot& snapshot, bool with_errors) {
  const auto names = series_columns(with_errors);
  const auto values = series_row(snapshot, with_errors);
  Json row = Json::object();
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::isfinite(values[i])) row[names[i]] = values[i];
  return row;
}

Json timing_of(const Snapshot& snapshot) {
  Json timing = Json::object();
  for (const auto& [stage, ms] : snapshot.timing_ms) timing[stage] = std::round(ms * 1e3) / 1e3;
  return timing;
}

/// 8 bytes, little-endian: the frame; then a JPEG.
LiveMessage image_of(const Snapshot& snapshot) {
  std::string bytes;
  for (auto frame = static_cast<std::uint64_t>(snapshot.tick.frame); bytes.size() < 8; frame >>= 8)
    bytes.push_back(static_cast<char>(frame & 0xff));
  const auto picture = jpeg(*snapshot.image);
  bytes.append(picture.begin(), picture.end());
  LiveMessage message{std::make_shared<const std::string>(std::move(bytes))};
  message.binary = message.droppable = true;
  return message;
}

Json json_of(const LiveState& state, std::size_t viewers) {
  Json json{{"type", "state"},      {"running", state.running}, {"paused", state.paused},
            {"speed", state.speed}, {"viewers", viewers},       {"ended", nullptr}};
  json["robot_stopped"] = state.robot_stopped ? Json(*state.robot_stopped) : Json(nullptr);
  if (!state.ended_status.empty())
    json["ended"] = {{"status", state.ended_status}, {"reason", state.ended_reason}};
  return json;
}

}  // namespace

PageChannel::PageChannel(std::function<void(const ViewerCommand&)> command) : command_(std::move(command)) {}

void PageChannel::begin(int index, const std::string& name, bool with_errors) {
  next_seq_ = 0;
  mailbox_ = std::make_shared<Mailbox<Published>>(most_waiting);
  server_->post([this, index, name, with_errors] {
    with_errors_ = with_errors;
    last_published_.reset(), observability_.reset();
    watchdog_.clear();
    run_ = message({{"type", "run"}, {"index", index}, {"name", name}});
    send_to_all(*run_);
  });
}

void PageChannel::publish(std::shared_ptr<const Snapshot> snapshot) {
  if (mailbox_->put({next_seq_++, std::move(snapshot)}))
    server_->post([this, mailbox = mailbox_] { deliver(*mailbox); });
}

LiveMessage PageChannel::message_of(const Published& published) const {
  const Snapshot& snapshot = *published.snapshot;
  std::string body = ",\"seq\":" + std::to_string(published.seq) +
                     ",\"snapshot\":" + snapshot_message(snapshot, true) +
                     ",\"row\":" + text_of(row_of(snapshot, with_errors_)) +
                     ",\"timing_ms\":" + text_of(timing_of(snapshot)) + "}";
  LiveMessage out{std::make_shared<const std::string>(std::move(body)),
                  "{\"type\":\"snapshot\",\"dropped\":"};
  out.droppable = out.counts_drops = true;
  return out;
}

bool PageChannel::has_image(const Published& published) {
  return published.snapshot->image && !published.snapshot->image->empty();
}

/// In the server's thread. Without viewers only the last snapshot is written, when a viewer comes.
void PageChannel::deliver(Mailbox<Published>& mailbox) {
  auto taken = mailbox.take();
  for (auto& [id, viewer] : viewers_) viewer->add_dropped(taken.dropped);
  for (const Published& published : taken.values) {
    last_published_ = published;
    if (viewers_.empty()) continue;
    if (has_image(published)) send_to_all(image_of(*published.snapshot));
    send_to_all(message_of(published));
  }
}

void PageChannel::send_to_all(const LiveMessage& message) {
  const auto viewers = viewers_;  // a viewer that is disconnected leaves
  for (const auto& [id, viewer] : viewers)
    if (viewers_.contains(id)) viewer->send(message);
}

void PageChannel::send_state() {
  LiveMessage state = message(json_of(state_, viewers_.size()));
  state.replaces = "state";
  send_to_all(state);
}

void PageChannel::set_state(const LiveState& state) {
  server_->post([this, state] {
    if (!state.running) watchdog_.clear();
    if (state_ == state) return;
    state_ = state;
    send_state();
  });
}

void PageChannel::put_observability(const std::string& json) {
  observability_ =
      LiveMessage{std::make_shared<const std::string>("{\"type\":\"observability\"," + json + "}")};
  observability_->replaces = "observability";
  send_to_all(*observability_);
}

void PageChannel::refuse(const std::string& of, const std::string& why) {
  server_->post([this, of, why] { send_to_all(refusal(of, why)); });
}

void PageChannel::saved(const SavedState& saved) {
  Json json{{"type", "saved"}, {"t", saved.t}, {"file", saved.file}, {"bytes", saved.bytes}};
  json["failure"] = saved.failure.empty() ? Json(nullptr) : Json(saved.failure);
  LiveMessage report = message(json);
  report.replaces = "saved";
  server_->post([this, report] { send_to_all(report); });
}

void PageChannel::joined(std::uint64_t id, Viewer& viewer) {
  viewers_[id] = &viewer;
  viewer_count_ = static_cast<int>(viewers_.size());
  if (run_) viewer.send(*run_);
  send_state();
  if (observability_) viewer.send(*observability_);
  if (!last_published_) return;
  if (has_image(*last_published_)) viewer.send(image_of(*last_published_->snapshot));
  viewer.send(message_of(*last_published_));
}

void PageChannel::left(std::uint64_t id) {
  viewers_.erase(id);
  viewer_count_ = static_cast<int>(viewers_.size());
  send_state();
  watchdog_.leave(id);
  stop_overdue_bodies();
  watch_drivers();
}

void PageChannel::stop_overdue_bodies() {
  for (const std::size_t body : watchdog_.overdue(std::chrono::steady_clock::now())) {
    try {
      command_(Intervention{DriveBody{body}});
      watchdog_.stopped(body);
    } catch (const InputError&) {  // too many interventions wait: it is tried again
    }
  }
}

void PageChannel::forget_driver_of(std::size_t body) {
  server_->post([this, body] { watchdog_.stopped(body); });
}

/// Plans the next look at the watchdog, as long as somebody drives.
void PageChannel::watch_drivers() {
  const auto next = watchdog_.next();
  if (is_watching_ || !next) return;
  is_watching_ = true;
  const auto now = std::chrono::steady_clock::now();
  server_->post_after(*next > now + least_wait ? *next - now : least_wait, [this] {
    is_watching_ = false;
    stop_overdue_bodies();
    watch_drivers();
  });
}

void PageChannel::received(std::uint64_t id, std::string_view text, bool binary) {
  try {
    if (binary) throw InputError("message: must be text, not binary");
    const ViewerCommand command = viewer_command(text);
    if (watchdog_.renews(id, command, std::chrono::steady_clock::now())) return;
    command_(command);
    watchdog_.accept(id, command, std::chrono::steady_clock::now());
    watch_drivers();
  } catch (const InputError& error) {
    const auto viewer = viewers_.find(id);
    if (viewer == viewers_.end()) return;
    viewer->second->send(refusal(type_of_message(text), error.what()));
  }
}

}  // namespace incognita
