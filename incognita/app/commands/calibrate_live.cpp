#include "incognita/app/commands/calibrate_live.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "incognita/app/commands/calibration_report.hpp"
#include "incognita/app/console/interrupt.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/app/view/calibration_page.hpp"

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

constexpr double wait_s = 0.1;  // for an image, before it is asked again whether to end
/// Between the last state and the end of the server, so that the page receives it.
constexpr std::chrono::milliseconds farewell{500};

std::string source_of_board(const LiveCalibration& live) {
  return live.board_is_guessed() ? "guessed from the first images that show one" : "given";
}

Json corners_json(const std::vector<Eigen::Vector2d>& corners) {
  Json json = Json::array();
  for (const Eigen::Vector2d& corner : corners) json.push_back({corner.x(), corner.y()});
  return json;
}

/// What the page shows: web/connection/calibration-socket.js tells the fields. `ended`: what became of the calibration; empty while it
/// goes on.
std::string state_json(const LiveCalibration& live, const CalibrateLiveOptions& options,
                       const std::string& ended) {
  Json json = {
      {"type", "calibration"},
      {"images", live.images()},
      {"newest", {{"refusal", live.newest().refusal}, {"corners", corners_json(live.newest().corners)}}},
      {"result", nullptr},
      {"file", options.output.file.filename().string()},
      {"size", nullptr},
      {"ended", ended}};
  if (options.image_size_px) json["size"] = {options.image_size_px->first, options.image_size_px->second};
  if (live.views())
    json["result"] = Json::parse(calibration_json(
        {*live.views(), live.calibration(), source_of_board(live), options.reporting.square_m, ""}));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// One line per view that is taken.
void tell_view(const LiveCalibration& live) {
  const CalibrationViews& views = *live.views();
  const std::string gaps = views.coverage().gaps();
  print_message("calibrate: {} views of the {} board; {:.0f} % of the image covered{}\n",
                views.views().size(), views.board().text(), 100 * views.coverage().share(),
                gaps.empty() ? "" : "; move the board to: " + gaps);
}

/// An image of another size than was asked for is no view of this camera.
bool has_size(const Image& image, const CalibrateLiveOptions& options) {
  return !options.image_size_px || options.image_size_px == std::pair{image.width(), image.height()};
}

/// Whether the views determine the camera, all of them used.
bool determine_camera(LiveCalibration& live) {
  live.finish();
  if (!live.views()) return false;
  CameraCalibration calibration = live.calibration();
  refuse_useless_lens(*live.views(), calibration);
  return calibration.refusal.empty();
}

/// Until a viewer finishes a calibration that determines the camera, or the program is interrupted.
void take_images(LiveCalibration& live, CalibrationPage& page, const CalibrateLiveOptions& options) {
  page.put(state_json(live, options, ""));
  while (!interrupted()) {
    const auto reading = page.camera().read(wait_s);
    for (const std::string& event : page.camera().take_events()) print_message("calibrate: {}\n", event);
    const bool restarts = page.take_restart(), finishes = page.take_finish();
    if (restarts) live.restart();
    if (finishes && determine_camera(live)) return;
    const bool is_image = reading && has_size(*reading->image, options);
    if (is_image) live.add(reading->t, *reading->image);
    if (is_image && live.views() && live.newest().refusal.empty()) tell_view(live);
    if (is_image || restarts || finishes) page.put(state_json(live, options, ""));
  }
}

void part_with(CalibrationPage& page, const LiveCalibration& live, const CalibrateLiveOptions& options,
               const std::string& ended) {
  page.put(state_json(live, options, ended));
  std::this_thread::sleep_for(farewell);
}

/// Reports and writes the calibration.
int conclude(const LiveCalibration& live, CalibrationPage& page, const CalibrateLiveOptions& options) {
  CalibrationReporting reporting = options.reporting;
  reporting.board_source = source_of_board(live);
  CameraCalibration calibration = live.calibration();
  try {
    const int code = conclude_calibration(*live.views(), calibration, reporting, options.output);
    part_with(page, live, options,
              code == 0 ? "written: " + options.output.file.string()
                        : "refused: " + calibration.refusal + "; nothing is written");
    return code;
  } catch (const std::exception& error) {
    part_with(page, live, options, std::string("not written: ") + error.what());
    throw;
  }
}

}  // namespace

int calibrate_live(const CalibrateLiveOptions& options) {
  catch_interrupts();
  std::signal(SIGPIPE, SIG_IGN);
  const auto [width_px, height_px] = options.image_size_px.value_or(std::pair{0, 0});
  LiveCalibration live(options.settings);
  CalibrationPage page(server_settings(options.page), width_px, height_px);
  print_message("the page is at {}\n{}Ctrl-C ends with the views taken until then\n", page.address(),
                hint_for_other_machines(options.page, page.address()));
  open_in_browser(page.address());
  take_images(live, page, options);
  if (!live.views()) {
    const int code = refuse_without_board(options.reporting.json);
    part_with(page, live, options, "refused: no image showed a board; nothing is written");
    return code;
  }
  live.finish();
  return conclude(live, page, options);
}

}  // namespace incognita
