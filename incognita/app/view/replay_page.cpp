#include "incognita/app/view/replay_page.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "incognita/app/console/print_message.hpp"
#include "incognita/app/view/page_answers.hpp"
#include "incognita/app/view/page_files.hpp"

namespace incognita {
namespace {

std::string mode_json(const std::vector<std::string>& names) {
  nlohmann::json runs = nlohmann::json::array();
  for (const std::string& name : names) runs.push_back({{"name", name}});
  return nlohmann::json{
      {"mode", "replay"}, {"version", INCOGNITA_VERSION}, {"runs", runs}, {"control", false}}
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

ReplayPage::ReplayPage(const std::vector<std::filesystem::path>& runs, ServerSettings settings) {
  check_page_is_complete();
  for (const std::filesystem::path& run : runs) runs_.add(run);
  ServerHandlers handlers;
  handlers.public_answer = [certificate = settings.certificate](const HttpRequest& request) {
    return page_file(request.path, certificate);
  };
  handlers.answer = [this](const HttpRequest& request) { return answer(request); };
  handlers.log = [](const std::string& line) { print_message("view: {}\n", line); };
  server_ = std::make_unique<Server>(std::move(settings), std::move(handlers));
}

HttpAnswer ReplayPage::answer(const HttpRequest& request) {
  const auto path = api_path(request.path);
  if (path.size() == 1 && path[0] == "mode") return json_answer(mode_json(runs_.names()));
  const auto index = path.size() > 2 && path[0] == "runs" ? index_of(path[1]) : std::nullopt;
  if (!index) return error_answer(404, "there is no such page");
  return runs_.answer(*index, {path.begin() + 2, path.end()});
}

}  // namespace incognita
