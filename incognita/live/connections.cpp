#include "incognita/live/connections.hpp"

#include <algorithm>

namespace incognita {

Connections::Place::Place(Connections& connections, std::string from, std::function<void()> close)
    : of_(&connections), number_(connections.next_number_++) {
  of_->strangers_.emplace(number_, Stranger{std::move(from), std::move(close)});
  ++of_->open_;
}

Connections::Place::~Place() {
  if (of_ && (is_trusted_ || of_->strangers_.erase(number_) > 0)) --of_->open_;
}

void Connections::Place::trust() {
  if (of_->strangers_.erase(number_) > 0) is_trusted_ = true;
}

void Connections::Place::renew() {
  auto stranger = of_->strangers_.extract(number_);
  if (!stranger) return;
  number_ = stranger.key() = of_->next_number_++;
  of_->strangers_.insert(std::move(stranger));
}

std::size_t Connections::strangers_of(const std::string& from) const {
  return static_cast<std::size_t>(std::count_if(strangers_.begin(), strangers_.end(),
                                                [&](const auto& one) { return one.second.from == from; }));
}

void Connections::close(Strangers::iterator stranger) {
  const auto close_it = std::move(stranger->second.close);
  strangers_.erase(stranger);
  --open_;
  close_it();
}

bool Connections::make_room(const std::string& from, const std::function<void(const std::string&)>& log) {
  if (strangers_of(from) >= most_strangers_) {
    log("a connection of " + from + " was closed for its next: it has " + std::to_string(most_strangers_) +
        " without access, the most that may be");
    close(std::find_if(strangers_.begin(), strangers_.end(),
                       [&](const auto& one) { return one.second.from == from; }));
  }
  if (open_ < most_) return true;
  const std::string all = "there are " + std::to_string(open_) + ", the most that may be";
  if (strangers_.empty()) {
    log("a connection of " + from + " was refused: " + all);
    return false;
  }
  log("a connection of " + strangers_.begin()->second.from +
      " was closed for another: it has no access, and " + all);
  close(strangers_.begin());
  return true;
}

}  // namespace incognita
