#include "incognita/app/view/recorded_runs.hpp"

#include <utility>

#include "incognita/app/console/print_message.hpp"
#include "incognita/app/view/page_answers.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/replay/recorded_run.hpp"

namespace incognita {
namespace {

HttpAnswer jpeg_answer(std::string bytes) {
  return {200, "image/jpeg", std::make_shared<const std::string>(std::move(bytes))};
}

HttpAnswer answer_of(const RecordedRun& run, const std::vector<std::string>& what) {
  const std::string& kind = what.front();
  if (what.size() == 1) {
    if (kind == "info") return json_answer(run.info_json());
    if (kind == "series") return json_answer(run.series_json());
    if (kind == "summary") return json_answer(run.summary_json());
  }
  const auto frame = what.size() == 2 ? index_of(what[1]) : std::nullopt;
  if (!frame || static_cast<std::int64_t>(*frame) >= run.frames())
    return error_answer(404, "the run has no such frame");
  if (kind == "frames") return json_answer(run.frame_json(static_cast<std::int64_t>(*frame)));
  if (kind != "images") return error_answer(404, "a run has info, series, summary, frames and images");
  auto image = run.image(static_cast<std::int64_t>(*frame));
  return image ? jpeg_answer(std::move(*image)) : error_answer(404, "there is no image at this frame");
}

}  // namespace

RecordedRuns::RecordedRuns() = default;
RecordedRuns::~RecordedRuns() = default;

void RecordedRuns::add(const std::filesystem::path& directory) {
  auto run = std::make_unique<RecordedRun>(directory);
  const std::string name = run->name();
  if (!run->damage().empty()) print_message("{}\n", run->damage());
  runs_.push_back({directory, name, std::move(run)});
}

void RecordedRuns::add_later(const std::filesystem::path& directory, const std::string& name) {
  runs_.push_back({directory, name, nullptr});
}

std::vector<std::string> RecordedRuns::names() const {
  std::vector<std::string> names;
  for (const Entry& entry : runs_) names.push_back(entry.name);
  return names;
}

HttpAnswer RecordedRuns::answer(std::size_t index, const std::vector<std::string>& what) {
  if (index >= runs_.size() || what.empty()) return error_answer(404, "there is no such run");
  try {
    Entry& entry = runs_[index];
    if (!entry.run) entry.run = std::make_unique<RecordedRun>(entry.directory);
    return answer_of(*entry.run, what);
  } catch (const std::exception& error) {
    return error_answer(500, error.what());
  }
}

}  // namespace incognita
