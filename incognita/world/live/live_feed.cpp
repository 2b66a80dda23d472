#include "incognita/world/live/live_feed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "incognita/math/saved_state/matrices.hpp"
#include "incognita/math/saved_state/state_archive.hpp"

namespace incognita {
namespace {

constexpr double nap_s = 0.05;  // between questions whether the run is to end
constexpr std::size_t most_odometry = 1000;

std::string in_seconds(double s) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", s);
  return text;
}

}  // namespace

LiveFeed::LiveFeed(const LiveFeedSettings& settings, std::shared_ptr<LiveSource> link,
                   std::function<double()> now_s)
    : settings_(settings), source_(std::move(link)), now_s_(std::move(now_s)), began_s_(now_s_()) {
  const auto& s = settings_;
  if (!(s.duration_s > 0 && s.period_s > 0 && s.give_up_s > s.late_s.value_or(0)))
    throw std::invalid_argument(
        "a live source needs times that are positive, and give_up_s more than late_s");
  if (s.late_s && !(*s.late_s > s.period_s))
    throw std::invalid_argument("late_s must be more than the period of the images");
}

Tick LiveFeed::next() {
  if (first_t_ && last_t_ && *last_t_ + settings_.period_s - *first_t_ >= settings_.duration_s) return {};
  reading_.reset();
  while (!is_over_()) {
    std::optional<LiveReading> reading = source_->read(time_to_wait(now_s_()));
    report_events();
    const double now_s = now_s_();
    const std::optional<Tick> tick =
        reading ? tick_of(*std::move(reading), now_s) : tick_without_image(now_s);
    if (tick) return *tick;
    if (is_complete_ || (!reading && source_->has_ended())) return {};
    check_patience(now_s);
  }
  return {};
}

double LiveFeed::time_to_wait(double now_s) const {
  if (!last_image_s_ || !settings_.late_s) return nap_s;
  const double due_s = std::max(*last_image_s_ + *settings_.late_s, *last_tick_s_ + settings_.period_s);
  return std::clamp(due_s - now_s, 0.0, nap_s);
}

void LiveFeed::state(StateArchive& archive) {
  archive(frame_, first_t_, last_t_);
  resumed_ = archive.restores();
}

/// The time while the program was off is no time of the run. The clock of a camera starts anew: its first image is one period
/// after the last. That of a robot goes on, and its stamps are kept, so that they fit its own records.
void LiveFeed::move_after_saved_run(LiveReading& reading) {
  is_first_again_ = std::exchange(resumed_, false) && last_t_;
  if (is_first_again_ && reading.t > *last_t_)
    first_t_ = rounded_to_us(*first_t_ + (reading.t - *last_t_) - settings_.period_s);
  else if (is_first_again_)
    shift_s_ = rounded_to_us(*last_t_ + settings_.period_s - reading.t);
  if (shift_s_ == 0) return;
  reading.t = rounded_to_us(reading.t + shift_s_);
  for (Odometry& odometry : reading.odometry) odometry.t = rounded_to_us(odometry.t + shift_s_);
}

std::optional<Tick> LiveFeed::tick_of(LiveReading reading, double now_s) {
  move_after_saved_run(reading);
  is_complete_ = first_t_ && duration_s(*first_t_, reading.t, true) >= settings_.duration_s;
  if (is_complete_) return std::nullopt;
  keep_odometry(reading.odometry);
  if (last_t_ && reading.t <= *last_t_) {
    ++unused_;
    const double back_s = last_image_t_ ? *last_image_t_ - reading.t : 0;
    if (back_s > 1 && !std::exchange(went_back_, true))
      report_("the stamps of the images went back by " + in_seconds(back_s) +
              ": images are not used until they are later again; if its clock was set, start another run");
    return std::nullopt;
  }
  if (last_image_s_ && settings_.late_s && now_s - *last_image_s_ > *settings_.late_s)
    report_("images come again, after " + in_seconds(now_s - *last_image_s_));
  went_back_ = false;
  last_image_s_ = now_s;
  last_image_t_ = reading.t;
  reading_ = std::move(reading);
  reading_->odometry = take_odometry(reading_->t);
  return next_tick(reading_->t);
}

/// The oldest readings make room.
void LiveFeed::keep_odometry(const std::vector<Odometry>& readings) {
  odometry_.insert(odometry_.end(), readings.begin(), readings.end());
  std::ranges::stable_sort(odometry_, {}, &Odometry::t);
  if (odometry_.size() > most_odometry)
    odometry_.erase(odometry_.begin(), odometry_.end() - static_cast<std::ptrdiff_t>(most_odometry));
}

/// Those since the last tick, until `t`.
std::vector<Odometry> LiveFeed::take_odometry(double t) {
  std::vector<Odometry> since;
  for (const Odometry& odometry : odometry_)
    if ((!last_t_ || odometry.t > *last_t_) && odometry.t <= t) since.push_back(odometry);
  std::erase_if(odometry_, [&](const Odometry& odometry) { return odometry.t <= t; });
  return since;
}

/// Its time is that of the robot's clock when the image was due, which is less than now: images that come again are later.
std::optional<Tick> LiveFeed::tick_without_image(double now_s) {
  if (!settings_.late_s || !last_image_s_) return std::nullopt;
  const double late_s = *settings_.late_s;
  if (now_s < *last_image_s_ + late_s || now_s < *last_tick_s_ + settings_.period_s) return std::nullopt;
  check_patience(now_s);
  const double t = *last_image_t_ + (now_s - *last_image_s_) - late_s + settings_.period_s;
  if (*last_t_ <= *last_image_t_) report_("no image for " + in_seconds(now_s - *last_image_s_));
  if (t <= *last_t_) return std::nullopt;
  return next_tick(rounded_to_us(t));
}

Tick LiveFeed::next_tick(double t) {
  last_tick_s_ = now_s_();
  const bool is_first_again = std::exchange(is_first_again_, false);
  const double dt = !last_t_ ? 0 : is_first_again ? settings_.period_s : duration_s(*last_t_, t, true);
  if (!first_t_) first_t_ = t;
  last_t_ = t;
  return {frame_++, t, dt, true};
}

BodyObservation LiveFeed::observation() const {
  BodyObservation body;
  if (!reading_) return body;
  body.images.push_back(reading_->image);
  body.odometry = reading_->odometry;
  return body;
}

std::vector<std::pair<std::string, std::int64_t>> LiveFeed::counts() const {
  auto counts = source_->counts();
  counts.emplace_back("outdated_images", unused_);
  return counts;
}

void LiveFeed::report_events() {
  for (const std::string& event : source_->take_events()) report_(event);
}

void LiveFeed::check_patience(double now_s) const {
  const double waited_s = now_s - last_image_s_.value_or(began_s_);
  if (waited_s < settings_.give_up_s) return;
  const std::string problem = source_->problem();
  throw std::runtime_error("no image for " + in_seconds(waited_s) + (problem.empty() ? "" : ": " + problem));
}

}  // namespace incognita
