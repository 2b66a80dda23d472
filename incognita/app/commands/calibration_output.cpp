#include "incognita/app/commands/calibration_output.hpp"

#include <fmt/format.h>

#include "incognita/app/commands/calibration_report.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/io/calibrations/write_calibration.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/toml_value.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/unfit_setting.hpp"
#include "incognita/record/files/durable_file.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t largest_replaced = 1 << 20;  // bytes; a calibration has some hundreds

/// The written file is a camera alone: it must not take the place of a scenario, or of anything else in TOML.
void refuse_to_replace(const fs::path& file, CalibrationFormat format) {
  if (!fs::exists(file) || (file.extension() != ".toml" && format != CalibrationFormat::incognita)) return;
  const std::string remedy =
      "it is not replaced: choose another file with --out, and copy the section [camera] from there";
  TomlTable sections;
  try {
    sections = parse_toml(read_file(file, largest_replaced), file.string());
  } catch (const InputError& error) {
    throw InputError(fmt::format("--out {}: exists, and cannot be read as a calibration ({}); {}",
                                 file.string(), error.what(), remedy));
  }
  for (const TomlEntry& entry : sections)
    if (entry.key != "camera")
      throw InputError(
          fmt::format("--out {}: exists, and has more than the section [camera] (`{}` in line {}); {}",
                      file.string(), entry.key, entry.line, remedy));
}

}  // namespace

std::optional<CalibrationOutput> calibration_output(const std::string& out, const std::string& format) {
  if (out.empty() && format.empty()) return std::nullopt;
  if (out.empty()) throw InputError("calibrate: --format needs the file to write: --out FILE");
  const fs::path file = out;
  if (file.has_parent_path() && !fs::is_directory(file.parent_path()))
    throw InputError(file.parent_path().string() +
                     ": is no folder; create it, or choose another one with --out");
  if (fs::is_directory(file)) throw InputError(fmt::format("--out {}: is a folder; name a file in it", out));
  const auto chosen = format.empty() ? guess_written_format(file) : written_format(format);
  if (!chosen)
    throw InputError(fmt::format(
        "--out {}: the ending tells no format; end it with .toml (incognita) or .yaml, or say --format kalibr, ros, opencv or incognita",
        out));
  refuse_to_replace(file, *chosen);
  return CalibrationOutput{file, *chosen};
}

void refuse_useless_lens(const CalibrationViews& views, CameraCalibration& calibration) {
  if (!calibration.refusal.empty()) return;
  try {
    make_camera(camera_settings(*calibration.lens, views.width_px(), views.height_px()));
  } catch (const UnfitSetting& error) {
    calibration.refusal =
        fmt::format("the fitted lens is of no use: {} {}; add views near the edges of the image",
                    error.keys.front(), error.what());
  }
}

namespace {

void print_answer(const CalibrationAnswer& answer, bool json) {
  fmt::print("{}", json ? calibration_json(answer) : calibration_report(answer));
}

}  // namespace

int conclude_calibration(const CalibrationViews& views, CameraCalibration& calibration,
                         const CalibrationReporting& reporting,
                         const std::optional<CalibrationOutput>& output) {
  refuse_useless_lens(views, calibration);
  CalibrationAnswer answer{views, calibration, reporting.board_source, reporting.square_m, ""};
  if (!calibration.refusal.empty()) {
    print_answer(answer, reporting.json);
    print_message("calibrate: refused: {}{}\n", calibration.refusal, output ? "; nothing is written" : "");
    return 1;
  }
  if (!output) return print_answer(answer, reporting.json), 0;
  try {
    refuse_to_replace(output->file, output->format);  // minutes may have passed since the first time
    write_durably(output->file,
                  calibration_text(camera_settings(*calibration.lens, views.width_px(), views.height_px()),
                                   output->format, calibration_comment(answer)));
  } catch (const std::exception&) {
    print_answer(answer, reporting.json);  // what was measured is not lost
    throw;
  }
  answer.written = output->file.string();
  print_answer(answer, reporting.json);
  print_message("calibrate: written: {} ({})\n", answer.written, name_of(output->format));
  return 0;
}

int refuse_without_board(bool json) {
  const std::string why =
      "no image shows a chessboard: all of its squares must be in the image, on a white margin, sharp and evenly lit; if the board is "
      "there, give its inner corners with --board 9x6";
  if (json) fmt::print("{{\n  \"status\": \"refused\",\n  \"reason\": \"{}\"\n}}\n", why);
  print_message("calibrate: refused: {}\n", why);
  return 1;
}

}  // namespace incognita
