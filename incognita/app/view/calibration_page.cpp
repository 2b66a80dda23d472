#include "incognita/app/view/calibration_page.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "incognita/app/console/print_message.hpp"
#include "incognita/app/view/page_answers.hpp"
#include "incognita/app/view/page_camera.hpp"
#include "incognita/app/view/page_files.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/json_limits.hpp"

namespace incognita {

CalibrationPage::CalibrationPage(ServerSettings settings, int width_px, int height_px) {
  check_page_is_complete();
  browser_->expect(width_px, height_px, "calibrate at the size of the camera, with --image-size");
  camera_ = std::make_shared<PageCamera>(browser_);
  channel_ = std::make_shared<StateChannel>([this](std::string_view json) { command(json); });
  ServerHandlers handlers;
  handlers.public_answer = [certificate = settings.certificate](const HttpRequest& request) {
    return page_file(request.path == "/" ? "/calibrate.html" : request.path, certificate);
  };
  handlers.answer = [](const HttpRequest&) { return error_answer(404, "there is no such page"); };
  handlers.protocols = {{subprotocol, channel_}, {BrowserCamera::subprotocol, browser_}};
  handlers.log = [](const std::string& line) { print_message("view: {}\n", line); };
  server_ = std::make_unique<Server>(std::move(settings), std::move(handlers),
                                     [this](Server& server) { channel_->attach(server); });
}

void CalibrationPage::command(std::string_view json) {
  if (json_depth(json) > most_json_depth) throw InputError("message: is nested too deep");
  const auto message = nlohmann::json::parse(json, nullptr, false);
  const auto type = message.is_object() ? message.value("type", nlohmann::json()) : nlohmann::json();
  if (type == "finish")
    finish_ = true;
  else if (type == "restart")
    restart_ = true;
  else
    throw InputError("message: type must be finish or restart");
}

}  // namespace incognita
