#include "incognita/record/summary/timing_table.hpp"

#include <algorithm>

#include "incognita/math/unknown.hpp"
#include "incognita/record/files/number.hpp"

namespace incognita {

void TimingTable::add(const Snapshot& snapshot) {
  const bool more = set_stages(snapshot);
  std::vector<double> ms(stages_.size(), unknown);
  for (const auto& [stage, value] : snapshot.timing_ms)
    ms[static_cast<std::size_t>(std::find(stages_.begin(), stages_.end(), stage) - stages_.begin())] = value;
  frames_.emplace_back(snapshot.tick.t, std::move(ms));
  if (more) {
    open();
  } else {
    file_.append(row(frames_.size() - 1), snapshot.tick.t);
  }
}

bool TimingTable::set_stages(const Snapshot& snapshot) {
  const std::size_t before = stages_.size();
  for (const auto& [stage, ms] : snapshot.timing_ms)
    if (std::find(stages_.begin(), stages_.end(), stage) == stages_.end()) stages_.push_back(stage);
  return stages_.size() > before;
}

void TimingTable::open() {
  std::string header = "t";
  for (const std::string& stage : stages_) append_cell(header, stage + "_ms");
  file_ = RowFile();  // the old one writes what it still has before the new one begins
  file_ = RowFile(path_, header);
  for (std::size_t i = 0; i < frames_.size(); ++i) file_.append(row(i), frames_[i].first);
}

std::string TimingTable::row(std::size_t frame) const {
  std::string text;
  append_number(text, frames_[frame].first);
  const std::vector<double>& ms = frames_[frame].second;
  for (std::size_t i = 0; i < stages_.size(); ++i) append_cell(text, i < ms.size() ? ms[i] : unknown);
  return text;
}

void TimingTable::close() {
  if (stages_.empty()) open();
  file_.close();
}

std::vector<double> TimingTable::column(std::size_t stage) const {
  std::vector<double> values;
  for (const auto& [t, ms] : frames_) values.push_back(stage < ms.size() ? ms[stage] : unknown);
  return values;
}

}  // namespace incognita
