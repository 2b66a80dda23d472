// The page of a program that runs the loop: server, viewers, control, and the runs so far.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "incognita/app/loop/scenario_run.hpp"
#include "incognita/app/view/live_control.hpp"
#include "incognita/app/view/recorded_runs.hpp"
#include "incognita/live/browser_camera.hpp"
#include "incognita/live/foxglove_channel.hpp"
#include "incognita/live/page_channel.hpp"
#include "incognita/live/series_history.hpp"
#include "incognita/live/server.hpp"
#include "incognita/world/live/live_source.hpp"

namespace incognita {

class ObservabilityWatch;

class LivePage final : public InterventionSource {
 public:
  /// Throws InputError if the server cannot listen, or the program has no page. `scenario`: the file that viewers may
  /// start besides the built-in ones, as given to the program. `interrupted`: whether the program is to end.
  LivePage(ServerSettings settings, std::string scenario, std::function<bool()> interrupted);
  ~LivePage() override;

  std::string address() const { return server_->address(); }

  // In the order of a run, from the thread of the loop:

  /// Another run begins; its interventions change settings of `loaded` by `reload`.
  using Reload = std::function<LoadedScenario(const std::vector<std::string>& settings)>;
  void prepare(const LoadedScenario& loaded, Reload reload, const std::filesystem::path& directory);
  void begin(const RunInfo& info, std::int64_t frames);
  LiveControl& control() { return control_; }
  /// The camera of a device that has the page open.
  std::shared_ptr<LiveSource> camera() const;
  void publish(const Snapshot& snapshot);
  /// The observability monitor after an update: its report is sent about every two seconds while someone watches, on
  /// large maps more rarely. It is computed in the server's thread.
  void observe(const ObservabilityWatch& watch);
  /// How a save into this file of the run directory went.
  void saved(const SaveReport& report, const std::string& file);
  void end(const RunOutcome& outcome);
  /// A run could not start.
  void refuse_start(const std::string& why);

  std::vector<Intervention> due(const Tick& tick) override;
  void refused(const Intervention& intervention, const std::string& why) override;
  LoadedScenario reloaded(const std::vector<std::string>& settings) override { return reload_(settings); }

 private:
  using Clock = std::chrono::steady_clock;

  HttpAnswer answer(const HttpRequest& request);
  void command(const ViewerCommand& command);

  struct Current {
    LoadedScenario loaded;
    std::filesystem::path directory;
    std::string info_json;
    std::shared_ptr<SeriesHistory> history;
  };

  void trust_places_of(const LoadedScenario& loaded);
  LoadedScenario load_for_viewer(const std::string& scenario, const std::vector<std::string>& settings) const;

  const std::string scenario_;
  mutable std::mutex trusted_mutex_;
  std::map<std::string, std::string> trusted_;  ///< settings of the first run, by key
  LiveControl control_;
  std::shared_ptr<PageChannel> channel_;
  std::shared_ptr<BrowserCamera> camera_;
  std::shared_ptr<FoxgloveChannel> foxglove_ = std::make_shared<FoxgloveChannel>();
  std::mutex mutex_;  ///< of `runs_` and `current_`
  RecordedRuns runs_;
  std::optional<Current> current_;  ///< the run that goes on
  Reload reload_;
  std::atomic<Clock::time_point> next_report_{};  ///< of the observability monitor
  std::unique_ptr<Server> server_;                ///< ends first
};

}  // namespace incognita
