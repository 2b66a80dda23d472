#include "incognita/app/commands/calibration_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <utility>
#include <vector>

namespace incognita {
namespace {

using Json = nlohmann::ordered_json;

struct NamedValue {
  std::string name, unit;
  FittedValue fitted;
};

std::vector<NamedValue> parameters_of(const LensFit& lens) {
  std::vector<NamedValue> all = {
      {"fu_px", "px", lens.fu}, {"fv_px", "px", lens.fv}, {"u0_px", "px", lens.u0}, {"v0_px", "px", lens.v0}};
  const bool pinhole = lens.model == LensModel::pinhole;
  const std::vector<std::string> names = pinhole ? std::vector<std::string>{"k1", "k2", "p1", "p2", "k3"}
                                                 : std::vector<std::string>{"k1", "k2", "k3", "k4"};
  for (std::size_t i = 0; i < lens.distortion.size(); ++i) all.push_back({names[i], "", lens.distortion[i]});
  return all;
}

std::string name_of(LensModel model) { return model == LensModel::fisheye ? "fisheye" : "pinhole"; }

std::string parameter_line(const NamedValue& p) {
  if (p.fitted.sigma == 0) return fmt::format("{:<6} {:>11.5g}  not fitted", p.name, p.fitted.value);
  if (!p.unit.empty())
    return fmt::format("{:<6} {:>11.3f} +- {:.3f} px", p.name, p.fitted.value, p.fitted.sigma);
  return fmt::format("{:<6} {:>11.6f} +- {:.6f}", p.name, p.fitted.value, p.fitted.sigma);
}

std::string view_line(const CalibrationAnswer& answer, std::size_t i) {
  const CalibrationView& view = answer.views.views()[i];
  if (!view.refusal.empty()) return fmt::format("  {}: refused: {}\n", view.name, view.refusal);
  const auto& board = answer.calibration.boards[i];
  if (!board) return fmt::format("  {}: edges {:.1f} px\n", view.name, view.edge_width_px);
  const double scale = answer.square_m > 0 ? answer.square_m : 1;
  return fmt::format("  {}: rms {:.3f} px, edges {:.1f} px, tilt {:.0f} deg, distance {:.3g} {}\n", view.name,
                     answer.calibration.view_rms_px[i], view.edge_width_px,
                     board->tilt_rad * 180 / std::numbers::pi, board->distance * scale,
                     answer.square_m > 0 ? "m" : "squares");
}

Json view_json(const CalibrationAnswer& answer, std::size_t i) {
  const CalibrationView& view = answer.views.views()[i];
  Json json = {{"name", view.name}, {"used", view.refusal.empty()}, {"reason", view.refusal}};
  if (!view.corners.empty()) json["edge_width_px"] = view.edge_width_px;
  const auto& board = answer.calibration.boards[i];
  if (!board) return json;
  json["rms_px"] = answer.calibration.view_rms_px[i];
  json["tilt_rad"] = board->tilt_rad;
  json["distance_squares"] = board->distance;
  if (answer.square_m > 0) json["distance_m"] = board->distance * answer.square_m;
  return json;
}

Json coverage_json(const Coverage& coverage) {
  Json cells = Json::array();
  for (int row = 0; row < Coverage::rows; ++row) {
    Json line = Json::array();
    for (int column = 0; column < Coverage::columns; ++column) line.push_back(coverage.count(row, column));
    cells.push_back(line);
  }
  return {{"share", coverage.share()}, {"corners", cells}, {"gaps", coverage.gaps()}};
}

}  // namespace

std::string calibration_report(const CalibrationAnswer& answer) {
  const CalibrationViews& views = answer.views;
  std::string text = fmt::format("board      {} inner corners ({})\nimages     {} of {}x{} px, {} used\n",
                                 views.board().text(), answer.board_source, views.views().size(),
                                 views.width_px(), views.height_px(), views.used());
  for (std::size_t i = 0; i < views.views().size(); ++i) text += view_line(answer, i);
  if (const auto& lens = answer.calibration.lens) {
    text += fmt::format("model      {}\n", name_of(lens->model));
    for (const NamedValue& p : parameters_of(*lens)) text += "  " + parameter_line(p) + "\n";
    text += fmt::format("rms        {:.3f} px\n", lens->rms_px);
  }
  text += fmt::format("coverage   {:.0f} % of the image; corners in each part of it:\n{}",
                      100 * views.coverage().share(), views.coverage().grid());
  for (const std::string& note : answer.calibration.notes) text += "note       " + note + "\n";
  return text;
}

std::string calibration_json(const CalibrationAnswer& answer) {
  const CameraCalibration& calibration = answer.calibration;
  const CalibrationViews& views = answer.views;
  Json json = {
      {"status", calibration.refusal.empty() ? "done" : "refused"},
      {"reason", calibration.refusal},
      {"board",
       {{"columns", views.board().columns}, {"rows", views.board().rows}, {"source", answer.board_source}}},
      {"width_px", views.width_px()},
      {"height_px", views.height_px()}};
  if (calibration.lens) {
    json["model"] = name_of(calibration.lens->model);
    for (const NamedValue& p : parameters_of(*calibration.lens))
      json["parameters"][p.name] = {{"value", p.fitted.value}, {"sigma", p.fitted.sigma}};
    json["rms_px"] = calibration.lens->rms_px;
  }
  json["coverage"] = coverage_json(views.coverage());
  json["views"] = Json::array();
  for (std::size_t i = 0; i < views.views().size(); ++i) json["views"].push_back(view_json(answer, i));
  json["notes"] = calibration.notes;
  json["file"] = answer.written;
  // File names may not be UTF-8
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string calibration_comment(const CalibrationAnswer& answer) {
  const LensFit& lens = *answer.calibration.lens;
  std::string text = fmt::format(
      "Calibrated from {} views of a chessboard with {} inner corners: rms {:.3f} px, {:.0f} % of the image covered.\n"
      "Standard deviations:",
      answer.views.used(), answer.views.board().text(), lens.rms_px, 100 * answer.views.coverage().share());
  for (const NamedValue& p : parameters_of(lens))
    if (p.fitted.sigma > 0) text += fmt::format(" {} {:.2g}", p.name, p.fitted.sigma);
  return text + "\nPixel (0, 0) is the center of the first pixel.";
}

CameraSettings camera_settings(const LensFit& lens, int width_px, int height_px) {
  CameraSettings camera;
  camera.width_px = width_px, camera.height_px = height_px;
  camera.fu_px = lens.fu.value, camera.fv_px = lens.fv.value;
  camera.u0_px = lens.u0.value, camera.v0_px = lens.v0.value;
  const auto k = [&](std::size_t i) { return lens.distortion[i].value; };
  if (lens.model == LensModel::fisheye)
    camera.model = FisheyeLens{k(0), k(1), k(2), k(3)};
  else
    camera.model = PinholeLens{k(0), k(1), k(2), k(3), k(4)};
  return camera;
}

}  // namespace incognita
