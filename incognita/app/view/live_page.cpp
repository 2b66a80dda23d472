#include "incognita/app/view/live_page.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

#include "incognita/app/console/print_message.hpp"
#include "incognita/app/loop/observability_watch.hpp"
#include "incognita/app/view/live_messages.hpp"
#include "incognita/app/view/page_answers.hpp"
#include "incognita/app/view/page_camera.hpp"
#include "incognita/app/view/page_files.hpp"
#include "incognita/app/view/settings_json.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/live/foxglove_messages.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/recorder.hpp"
#include "incognita/record/snapshot/interventions.hpp"

namespace incognita {
namespace {

constexpr std::chrono::seconds observe_every{2};
/// A report is cubic in the size of the map. Pause between two, in times of the last one: other messages wait meanwhile.
constexpr int least_pause = 20;

/// Whether a setting names a file, a device or an address.
bool names_place(const std::string& key) {
  constexpr std::array others{"recording.folder", "recording.truth", "live.source", "robot.address"};
  return key.ends_with(".file") || key.ends_with(".target") ||
         std::find(others.begin(), others.end(), key) != others.end();
}

/// A viewer names no place but those of the program's own scenario, and its own camera. To be called before anything is loaded: what
/// is wrong with a file says that it exists, and what is in it. `sets`: "key=value".
void refuse_other_places(const std::vector<std::string>& sets,
                         const std::map<std::string, std::string>& trusted) {
  for (const std::string& set : sets) {
    const std::size_t equals = std::min(set.find('='), set.size());
    const std::string key = set.substr(0, equals);
    if (!names_place(key)) continue;
    const std::string typed = set.substr(std::min(equals + 1, set.size()));
    const std::string value = typed.starts_with('"') ? typed : toml_string(typed);
    const auto known = trusted.find(key);
    const bool is_own_camera = key == "live.source" && value == "\"browser\"";
    if (is_own_camera || (known != trusted.end() && known->second == value)) continue;
    throw InputError(key +
                     ": names a file, a device or an address, which only who starts the program may choose");
  }
}

std::vector<std::string> settings_of(const HttpRequest& request) {
  std::vector<std::string> settings;
  for (const auto& [name, value] : request.query)
    if (name == "set") settings.push_back(value);
  return settings;
}

}  // namespace

LivePage::LivePage(ServerSettings settings, std::string scenario, std::function<bool()> interrupted)
    : scenario_(std::move(scenario)), control_(std::move(interrupted)) {
  check_page_is_complete();
  camera_ = std::make_shared<BrowserCamera>();
  channel_ = std::make_shared<PageChannel>([this](const ViewerCommand& asked) { command(asked); });
  control_.on_change = [this](const LiveState& state) { channel_->set_state(state); };
  ServerHandlers handlers;
  handlers.public_answer = [certificate = settings.certificate](const HttpRequest& request) {
    return page_file(request.path, certificate);
  };
  handlers.answer = [this](const HttpRequest& request) { return answer(request); };
  handlers.protocols = {{PageChannel::subprotocol, channel_}, {BrowserCamera::subprotocol, camera_}};
  for (const char* name : foxglove::subprotocols) handlers.protocols.emplace_back(name, foxglove_);
  handlers.log = [](const std::string& line) { print_message("view: {}\n", line); };
  server_ = std::make_unique<Server>(std::move(settings), std::move(handlers), [this](Server& server) {
    channel_->attach(server);
    foxglove_->attach(server);
  });
}

LivePage::~LivePage() { server_.reset(); }

std::shared_ptr<LiveSource> LivePage::camera() const { return std::make_shared<PageCamera>(camera_); }

void LivePage::prepare(const LoadedScenario& loaded, Reload reload, const std::filesystem::path& directory) {
  const std::lock_guard lock(mutex_);
  reload_ = std::move(reload);
  trust_places_of(loaded);
  current_.emplace();
  current_->loaded = loaded;
  current_->directory = directory;
  const CameraSettings& camera = loaded.scenario.camera;
  camera_->expect(camera.width_px, camera.height_px);
}

/// Those of the first run are what the program was started with.
void LivePage::trust_places_of(const LoadedScenario& loaded) {
  const std::lock_guard lock(trusted_mutex_);
  if (!trusted_.empty()) return;
  for (const SettingInForce& setting : loaded.settings) trusted_[setting.key] = setting.value;
}

void LivePage::begin(const RunInfo& info, std::int64_t frames) {
  // Errors are known from the first snapshot on; until then their columns are empty
  const bool with_errors = same_frame_as_truth(info);
  int index = 0;
  {
    const std::lock_guard lock(mutex_);
    current_->info_json = live_info_json(current_->loaded, info, frames);
    current_->history = std::make_shared<SeriesHistory>(with_errors, static_cast<std::size_t>(info.bodies));
    index = static_cast<int>(runs_.size());
  }
  channel_->begin(index, current_->loaded.name, with_errors);
  foxglove_->begin(info);
  const Scenario& scenario = current_->loaded.scenario;
  control_.begin(!scenario.is_live() && !scenario.is_robot());
}

void LivePage::publish(const Snapshot& snapshot) {
  if (auto changed = changed_info_json(current_->info_json, snapshot.interventions)) {
    const std::lock_guard lock(mutex_);
    current_->info_json = *std::move(changed);
  }
  current_->history->add(snapshot);
  const auto shared = std::make_shared<const Snapshot>(snapshot);
  channel_->publish(shared);
  foxglove_->publish(shared);
}

void LivePage::observe(const ObservabilityWatch& watch) {
  if (Clock::now() < next_report_.load() || !channel_->has_viewers()) return;
  next_report_ = Clock::time_point::max();  // until this one is done
  // A copy, since a report rearranges the information, which must not depend on who watches
  server_->post([this, copy = std::make_shared<ObservabilityWatch>(watch)] {
    const auto start = Clock::now();
    if (const auto report = copy->report()) channel_->put_observability(observability_fields(*report));
    const auto end = Clock::now();
    next_report_ = std::max(start + observe_every, end + least_pause * (end - start));
  });
}

void LivePage::saved(const SaveReport& report, const std::string& file) {
  channel_->saved({report.t, file, report.bytes, report.failure});
}

void LivePage::end(const RunOutcome& outcome) {
  {
    const std::lock_guard lock(mutex_);
    runs_.add_later(current_->directory, current_->loaded.name);
    current_.reset();
  }
  control_.end(name(outcome.status), outcome.reason);
}

void LivePage::refuse_start(const std::string& why) {
  {
    const std::lock_guard lock(mutex_);
    current_.reset();
  }
  channel_->refuse("start", why);
  control_.end("failed", why);
}

std::vector<Intervention> LivePage::due(const Tick&) { return control_.take_interventions(); }

void LivePage::refused(const Intervention& intervention, const std::string& why) {
  channel_->refuse(name(intervention), why);
  if (const auto* drive = std::get_if<DriveBody>(&intervention)) channel_->forget_driver_of(drive->body);
}

/// A viewer names no files of this machine but the one that the program was started with.
LoadedScenario LivePage::load_for_viewer(const std::string& scenario,
                                         const std::vector<std::string>& settings) const {
  const std::vector<std::string> built_in = embedded_scenarios();
  if (scenario != scenario_ && std::find(built_in.begin(), built_in.end(), scenario) == built_in.end())
    throw InputError(scenario.substr(0, 100) +
                     ": is no built-in scenario, nor the one that the program was started with");
  {
    const std::lock_guard lock(trusted_mutex_);
    refuse_other_places(settings, trusted_);
  }
  return load_scenario(scenario, settings);
}

/// In the server's thread. A run that could not start is refused here already, as far as its settings say.
void LivePage::command(const ViewerCommand& asked) {
  if (const auto* start = std::get_if<StartRun>(&asked)) load_for_viewer(start->scenario, start->settings);
  control_.command(asked);
}

/// In the server's thread.
HttpAnswer LivePage::answer(const HttpRequest& request) {
  const auto path = api_path(request.path);
  if (path.empty()) return error_answer(404, "there is no such page");
  if (path[0] == "scenarios") return json_answer(scenarios_json(scenario_));
  if (path[0] == "config") {
    try {
      return json_answer(
          scenario_json(load_for_viewer(std::string(request.parameter("scenario")), settings_of(request))));
    } catch (const InputError& error) {
      return error_answer(400, error.what());
    }
  }
  std::unique_lock lock(mutex_);
  if (path[0] == "mode") {
    nlohmann::json runs = nlohmann::json::array();
    for (const std::string& name : runs_.names()) runs.push_back({{"name", name}});
    if (current_) runs.push_back({{"name", current_->loaded.name}});
    return json_answer(nlohmann::json{
        {"mode", "live"},
        {"version", INCOGNITA_VERSION},
        {"runs", runs},
        {"control", true}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  const auto index = path[0] == "runs" && path.size() > 2 ? index_of(path[1]) : std::nullopt;
  if (!index) return error_answer(404, "there is no such page");
  if (*index != runs_.size() || !current_ || !current_->history)
    return runs_.answer(*index, {path.begin() + 2, path.end()});
  if (path[2] == "info") return json_answer(current_->info_json);
  const auto history = current_->history;
  lock.unlock();  // the loop takes it between two frames
  if (path[2] == "series") return json_answer(history->json());
  return error_answer(404, "frames, images and the summary are available after the end of the run");
}

}  // namespace incognita
