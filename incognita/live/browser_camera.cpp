#include "incognita/live/browser_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace incognita {
namespace {

constexpr std::size_t time_bytes = 8;

double time_in(std::string_view message) {
  std::uint64_t bits = 0;
  for (std::size_t i = time_bytes; i-- > 0;) bits = bits << 8 | static_cast<unsigned char>(message[i]);
  return std::bit_cast<double>(bits);
}

nlohmann::json parsed(std::string_view message) { return nlohmann::json::parse(message, nullptr, false); }

/// A name as a browser gives it, for a terminal.
std::string name_for_terminal(const std::string& label) {
  std::string shown;
  for (const char c : label.substr(0, 80)) shown += c < ' ' || c > '~' ? '?' : c;
  return shown;
}

std::string refused(const std::string& why) {
  return nlohmann::json{{"type", "refused"}, {"message", why}}.dump();
}

}  // namespace

void BrowserCamera::expect(int width_px, int height_px, const std::string& remedy) {
  images_.clear();  // of an earlier run
  const std::lock_guard lock(mutex_);
  width_px_ = width_px, height_px_ = height_px;
  remedy_ = remedy;
}

void BrowserCamera::joined(std::uint64_t id, Viewer& viewer) { viewers_[id] = &viewer; }

void BrowserCamera::left(std::uint64_t id) {
  viewers_.erase(id);
  if (sender_ != id) return;
  sender_.reset();
  const std::lock_guard lock(mutex_);
  sends_ = false;
  note("the camera of the page is gone; open the page again, or press its button");
}

void BrowserCamera::received(std::uint64_t id, std::string_view message, bool binary) {
  if (binary) return take_image(id, message);
  greet(id, message);
}

std::string BrowserCamera::refusal_of(std::uint64_t id, std::string_view message) {
  const nlohmann::json hello = parsed(message);
  const auto number = [&](const char* key) -> std::int64_t {
    constexpr std::int64_t most = 1 << 20;
    if (!hello.is_object() || !hello.contains(key) || !hello[key].is_number_integer()) return 0;
    return std::clamp<std::int64_t>(hello[key].get<std::int64_t>(), 0, most);
  };
  if (!hello.is_object() || hello.value("type", nlohmann::json()) != "camera")
    return "the first message must be {\"type\": \"camera\", \"label\", \"width\", \"height\"}";
  if (sender_ && *sender_ != id) return "another camera sends already; end that first";
  const std::lock_guard lock(mutex_);
  if (width_px_ > 0 && (number("width") != width_px_ || number("height") != height_px_))
    return fmt::format("the camera gives images of {}x{} px, and {}x{} are expected: {}", number("width"),
                       number("height"), width_px_, height_px_, remedy_);
  return "";
}

void BrowserCamera::greet(std::uint64_t id, std::string_view message) {
  if (const std::string why = refusal_of(id, message); !why.empty()) return answer(id, refused(why));
  sender_ = id;
  const nlohmann::json hello = parsed(message);
  const std::string label = hello.contains("label") && hello["label"].is_string() ? hello["label"] : "";
  {
    const std::lock_guard lock(mutex_);
    sends_ = true;
    note(fmt::format("images come from the page's camera{}{}", label.empty() ? "" : ": ",
                     name_for_terminal(label)));
  }
  answer(id, R"({"type":"ready"})");
}

void BrowserCamera::take_image(std::uint64_t id, std::string_view message) {
  if (sender_ != id) return answer(id, refused("a camera must say {\"type\": \"camera\", ...} first"));
  const double taken_s = message.size() > time_bytes ? time_in(message) : std::nan("");
  if (!std::isfinite(taken_s)) return answer(id, refused("an image must be 8 bytes of time, s, and a JPEG"));
  const double t = times_.time_of(taken_s, steady_s());
  images_.put({t, std::string(message.substr(time_bytes))});
  answer(id, nlohmann::json{{"type", "got"}, {"t", taken_s}, {"run_t", t}}.dump());
}

void BrowserCamera::answer(std::uint64_t id, const std::string& json) {
  LiveMessage message;
  message.body = std::make_shared<const std::string>(json);
  viewers_.at(id)->send(std::move(message));
}

/// With the mutex held. The oldest make room, and one is not said twice.
void BrowserCamera::note(std::string event) {
  constexpr std::size_t most_events = 10;
  if (!events_.empty() && events_.back() == event) return;
  if (events_.size() == most_events) events_.erase(events_.begin());
  events_.push_back(std::move(event));
}

std::string BrowserCamera::problem() const {
  const std::lock_guard lock(mutex_);
  return sends_
             ? ""
             : "no camera sends: open the page on the device with the camera, and press \"Use this camera\"";
}

std::vector<std::string> BrowserCamera::take_events() {
  const std::lock_guard lock(mutex_);
  return std::exchange(events_, {});
}

}  // namespace incognita
