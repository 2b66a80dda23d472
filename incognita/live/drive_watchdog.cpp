#include "incognita/live/drive_watchdog.hpp"

#include <algorithm>

namespace incognita {
namespace {

const DriveBody* drive_of(const ViewerCommand& command) {
  const auto* intervention = std::get_if<Intervention>(&command);
  return intervention ? std::get_if<DriveBody>(intervention) : nullptr;
}

/// The body whose motion a command determines.
std::optional<std::size_t> commanded_body(const ViewerCommand& command) {
  const auto* intervention = std::get_if<Intervention>(&command);
  if (!intervention) return std::nullopt;
  if (const auto* drive = std::get_if<DriveBody>(intervention)) return drive->body;
  if (const auto* take = std::get_if<TakeOverBody>(intervention)) return take->body;
  if (const auto* back = std::get_if<GiveBackBody>(intervention)) return back->body;
  return std::nullopt;
}

bool is_at_rest(const DriveBody& drive) { return drive.direction.isZero(0) && drive.turn == 0; }

bool moves_alike(const DriveBody& a, const DriveBody& b) {
  return a.direction == b.direction && a.turn == b.turn;
}

}  // namespace

bool DriveWatchdog::renews(std::uint64_t viewer, const ViewerCommand& command, Time now) {
  const DriveBody* const drive = drive_of(command);
  if (!drive) return false;
  const auto found = drives_.find({viewer, drive->body});
  if (found == drives_.end() || !moves_alike(found->second.command, *drive)) return false;
  found->second.until = now + holds_;
  return true;
}

void DriveWatchdog::accept(std::uint64_t viewer, const ViewerCommand& command, Time now) {
  const auto body = commanded_body(command);
  if (!body) return;
  drives_.erase({viewer, *body});
  for (auto& [key, drive] : drives_) drive.superseded |= key.second == *body;
  const DriveBody* const drive = drive_of(command);
  if (drive && !is_at_rest(*drive)) drives_[{viewer, *body}] = {*drive, now + holds_};
}

void DriveWatchdog::leave(std::uint64_t viewer) {
  for (auto& [key, drive] : drives_)
    if (key.first == viewer) drive.until = Time::min();
}

std::vector<std::size_t> DriveWatchdog::overdue(Time now) {
  std::erase_if(drives_, [now](const auto& entry) {
    const Drive& drive = entry.second;
    return drive.superseded && drive.until <= now;
  });
  std::vector<std::size_t> bodies;
  for (const auto& [key, drive] : drives_)
    if (drive.until <= now) bodies.push_back(key.second);
  return bodies;
}

void DriveWatchdog::stopped(std::size_t body) {
  std::erase_if(drives_,
                [body](const auto& entry) { return entry.first.second == body && !entry.second.superseded; });
}

std::optional<DriveWatchdog::Time> DriveWatchdog::next() const {
  std::optional<Time> next;
  for (const auto& [key, drive] : drives_) next = std::min(next.value_or(drive.until), drive.until);
  return next;
}

}  // namespace incognita
