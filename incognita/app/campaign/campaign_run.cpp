#include "incognita/app/campaign/campaign_run.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>

#include "incognita/app/loop/scenario_run.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t largest_summary = 1 << 20;

/// Output of a run: its summary, and the disk error if there was one.
struct Left {
  std::string summary_json;
  std::string disk_trouble;
};

class SummarySink : public RunSink {
 public:
  SummarySink(const RunInfo& info, Left& left) : summary_(info), left_(left) {}
  void publish(const Snapshot& snapshot) override { summary_.add(snapshot); }
  void note(const ObservabilityReport& report, const std::vector<std::string>&) override {
    summary_.note(report);
  }
  void note(const std::string& key, const SummaryValue& value) override { summary_.note(key, value); }
  RunOutcome finish(RunStatus status, const std::string& reason,
                    const std::vector<std::string>& warnings) override {
    for (const std::string& warning : warnings) summary_.warn(warning);
    left_.summary_json = summary_.json(status, reason);
    return {status, reason};
  }

 private:
  RunSummary summary_;
  Left& left_;
};

/// Records into a temporary folder and renames it, so that an existing run directory is always that of a
/// finished run.
class DirectorySink : public RunSink {
 public:
  DirectorySink(const RunInfo& info, const fs::path& folder, Left& left)
      : place_(folder), part_(folder.string() + ".part"), recorder_(part_, info), left_(left) {}

  void publish(const Snapshot& snapshot) override {
    try {
      recorder_.publish(snapshot);
    } catch (const RecordError& error) {
      left_.disk_trouble = error.what();
      throw;
    }
  }
  void note(const ObservabilityReport& report, const std::vector<std::string>&) override {
    recorder_.note(report);
  }
  void note(const std::string& key, const SummaryValue& value) override { recorder_.note(key, value); }
  RunOutcome finish(RunStatus status, const std::string& reason,
                    const std::vector<std::string>& warnings) override {
    RunOutcome outcome = recorder_.finish(status, reason, [&](const fs::path&) { return warnings; });
    if (outcome.reason != reason) left_.disk_trouble = outcome.reason;
    left_.summary_json = read_file(part_ / "summary.json", largest_summary);
    fs::remove_all(place_);
    fs::rename(part_, place_);
    return outcome;
  }

 private:
  fs::path place_, part_;
  Recorder recorder_;
  Left& left_;
};

Json ended(const std::string& status, const std::string& reason) {
  return {{"end", "result"}, {"status", status}, {"reason", reason}};
}

Json trouble(const std::string& why, bool bad_input = false) {
  return {{"end", bad_input ? "input" : "trouble"}, {"why", why}};
}

Json run_and_report(const CampaignPlan& plan, std::size_t run, const std::optional<fs::path>& keep) {
  Left left;
  const SinkFactory open = [&](const RunInfo& info, std::int64_t) -> std::unique_ptr<RunSink> {
    if (keep) return std::make_unique<DirectorySink>(info, *keep, left);
    return std::make_unique<SummarySink>(info, left);
  };
  const LoadedScenario loaded = load_run(plan, plan.variant_of(run), plan.seed_of(run));
  const RunOutcome outcome = run_scenario(loaded, open, {[](const std::string&) {}, {}});
  if (!left.disk_trouble.empty()) return trouble(left.disk_trouble);
  Json result_json = ended(name(outcome.status), outcome.reason);
  result_json["summary"] = Json::parse(left.summary_json);
  return result_json;
}

std::string dumped(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

bool is_a_crash(int signal) {
  for (const int fault : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP})
    if (signal == fault) return true;
  return false;
}

std::string in_words(int signal) { return fmt::format("signal {} ({})", signal, ::strsignal(signal)); }

}  // namespace

std::string make_run(const CampaignPlan& plan, std::size_t run, const std::optional<fs::path>& keep) {
  try {
    return dumped(run_and_report(plan, run, keep));
  } catch (const InputError& error) {
    return dumped(trouble(error.what(), true));
  } catch (const RecordError& error) {
    return dumped(trouble(error.what()));
  } catch (const fs::filesystem_error& error) {
    return dumped(trouble(error.what()));
  } catch (const std::bad_alloc&) {
    return dumped(trouble("out of memory"));
  } catch (const std::exception& error) {
    return dumped(ended("failed", error.what()));
  }
}

std::string no_run(const std::string& why) { return dumped(trouble(why, true)); }

std::string answer_of(const JobEnd& end) {
  Json answer;
  if (end.signal != 0)
    answer = is_a_crash(end.signal) ? ended("failed", "crashed: " + in_words(end.signal))
                                    : trouble("killed from outside by " + in_words(end.signal));
  else if (end.exit_code != 0)
    answer = ended("failed", fmt::format("crashed: ended with exit code {}", end.exit_code));
  else
    answer = Json::parse(end.answer);
  answer["seconds"] = end.seconds;
  return dumped(answer);
}

RunEnd end_of_run(const std::string& answer) {
  const Json json = Json::parse(answer);
  if (json.at("end") != "result") return {{}, json.at("why"), json.at("end") == "input"};
  const bool whole = json.contains("summary");
  return {RunResult{json.at("status"), json.at("reason"), json.at("seconds"),
                    whole ? json["summary"].dump() : "", ""},
          "", false};
}

}  // namespace incognita
