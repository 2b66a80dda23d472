#include "incognita/app/commands/calibrate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "incognita/app/commands/calibration_report.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/app/console/progress.hpp"
#include "incognita/io/calibrations/read_calibration.hpp"
#include "incognita/io/calibrations/write_calibration.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/image_files.hpp"
#include "incognita/io/formats/toml_value.hpp"
#include "incognita/io/recordings/video.hpp"
#include "incognita/io/recordings/video_images.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/messages/unfit_setting.hpp"
#include "incognita/record/files/durable_file.hpp"
#include "incognita/vision/calibration/guess_board.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

struct CalibrateOptions {
  std::vector<std::string> images;
  std::string board, model = "auto", out, format, convert, image_size, camera;
  double square_m = 0;
  bool json = false;
  std::vector<std::string> given;  ///< the names of the options on the command line
};

/// Throws InputError for the first option that is given and does not apply.
void refuse_options(const CalibrateOptions& options, std::initializer_list<const char*> names,
                    const char* why) {
  for (const char* name : names)
    if (std::find(options.given.begin(), options.given.end(), name) != options.given.end())
      throw InputError(fmt::format("calibrate: {} {}; leave it out", name, why));
}

// ----------------------------------------------------------------------------------------------------------- the output file

constexpr std::size_t largest_replaced = 1 << 20;  // bytes; a calibration has some hundreds

struct OutputFile {
  fs::path file;
  CalibrationFormat format = CalibrationFormat::incognita;
};

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

/// Checked before the work: throws InputError for a folder that does not exist, a format that is not known, and a file that must
/// not be replaced.
std::optional<OutputFile> output_of(const CalibrateOptions& options) {
  if (options.out.empty() && options.format.empty()) return std::nullopt;
  if (options.out.empty()) throw InputError("calibrate: --format needs the file to write: --out FILE");
  const fs::path file = options.out;
  if (file.has_parent_path() && !fs::is_directory(file.parent_path()))
    throw InputError(file.parent_path().string() +
                     ": is no folder; create it, or choose another one with --out");
  const auto format = options.format.empty() ? guess_written_format(file) : written_format(options.format);
  if (!format)
    throw InputError(fmt::format(
        "--out {}: the ending tells no format; end it with .toml (incognita) or .yaml, or say --format kalibr, ros, opencv or incognita",
        options.out));
  refuse_to_replace(file, *format);
  return OutputFile{file, *format};
}

// -------------------------------------------------------------------------------------------------------------- conversion

std::optional<std::pair<int, int>> image_size_of(const CalibrateOptions& options) {
  if (options.image_size.empty()) return std::nullopt;
  int width = 0, height = 0;
  const char *begin = options.image_size.data(), *end = begin + options.image_size.size();
  const auto first = std::from_chars(begin, end, width);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == 'x') {
    const auto second = std::from_chars(first.ptr + 1, end, height);
    if (second.ec == std::errc() && second.ptr == end && width > 0 && height > 0) return {{width, height}};
  }
  throw InputError(
      fmt::format("--image-size {}: must be width and height in px, as 640x480", options.image_size));
}

int convert(const CalibrateOptions& options) {
  if (!options.images.empty()) throw InputError("calibrate: images or --convert, not both");
  refuse_options(options, {"--board", "--square", "--model", "--json"},
                 "is for a calibration from images, and --convert reads a file");
  const auto output = output_of(options);
  const CalibrationFile read =
      read_calibration_file(options.convert, {options.camera, image_size_of(options)});
  print_message("calibrate: {}: recognized as {}\n", options.convert, name_of(read.format));
  for (const std::string& note : read.notes) print_message("calibrate: {}: {}\n", options.convert, note);
  check_calibrated(read.calibrated);
  if (!output) {
    fmt::print("{}", calibration_text(read.calibrated.camera, CalibrationFormat::incognita));
    return 0;
  }
  write_durably(output->file, calibration_text(read.calibrated.camera, output->format,
                                               fmt::format("Converted from {}, {}.", options.convert,
                                                           name_of(read.format))));
  print_message("calibrate: written: {} ({})\n", options.out, name_of(output->format));
  return 0;
}

// ------------------------------------------------------------------------------------------------------------- calibration

struct ChosenBoard {
  BoardSize size;
  std::string source;
};

/// The board that is given, unless the images show a larger one; else the one that they show. Nothing if they show none.
std::optional<ChosenBoard> choose_board(const CalibrateOptions& options, ImageSource& images) {
  const GuessedBoard guess = guess_board(images);
  if (options.board.empty()) {
    if (!guess.board) return std::nullopt;
    return ChosenBoard{*guess.board,
                       fmt::format("guessed: {} of {} images show it", guess.shown, guess.tried)};
  }
  const auto given = parse_board(options.board);
  if (!given)
    throw InputError(fmt::format("--board {}: must be the inner corners per row and column, 3 to 50, as 9x6",
                                 options.board));
  if (guess.board && !guess.board->is_like(*given) && guess.board->corners() > given->corners())
    throw InputError(fmt::format(
        "--board {}: {} of {} images, {} the first, show a board of {} inner corners: use --board {} (corners are counted where four "
        "squares meet, not squares)",
        options.board, guess.shown, guess.tried, guess.example, guess.board->text(), guess.board->text()));
  return ChosenBoard{*given, "given"};
}

constexpr std::size_t most_of_video = 150;  // images that are looked at: finding a board takes some 20 ms

std::unique_ptr<ImageSource> open(const CalibrateOptions& options) {
  const std::vector<fs::path> paths(options.images.begin(), options.images.end());
  if (paths.size() == 1 && looks_like_video(paths.front()))
    return open_video_images(paths.front(), most_of_video);
  return open_images(paths);
}

CalibrationViews collect(const BoardSize& board, ImageSource& images) {
  CalibrationViews views(board);
  Progress progress(static_cast<std::int64_t>(images.count()), "images");
  for (std::int64_t done = 1; auto image = images.next(); ++done) {
    if (image->failure.empty())
      views.add(image->name, image->image);
    else
      views.add_unreadable(image->name, image->failure);
    progress.show(done, fmt::format("{} views can be used", views.used()));
  }
  return views;
}

/// If few images show the board that was given, names the one that they show.
void explain_wrong_board(const CalibrateOptions& options, const CalibrationViews& views,
                         CameraCalibration& calibration) {
  if (views.used() >= least_views || options.board.empty()) return;
  const GuessedBoard guess = guess_board(*open(options));
  if (!guess.board || guess.board->is_like(views.board())) return;
  calibration.refusal += fmt::format(
      "; {} shows a board of {} inner corners: use --board {} (corners are counted where four squares meet, not squares)",
      guess.example, guess.board->text(), guess.board->text());
}

/// A lens whose polynomial folds within the image has no ray for some pixels.
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

CalibrationSettings settings_of(const CalibrateOptions& options, const std::optional<OutputFile>& output) {
  using Model = CalibrationSettings::Model;
  CalibrationSettings settings;
  if (options.model != "auto") settings.model = options.model == "fisheye" ? Model::fisheye : Model::pinhole;
  settings.allow_third_radial = !output || output->format != CalibrationFormat::kalibr;
  return settings;
}

int refuse_without_board(const CalibrateOptions& options) {
  const std::string why =
      "no image shows a chessboard: all of its squares must be in the image, on a white margin, sharp and evenly lit; if the board is "
      "there, give its inner corners with --board 9x6";
  if (options.json) fmt::print("{{\n  \"status\": \"refused\",\n  \"reason\": \"{}\"\n}}\n", why);
  print_message("calibrate: refused: {}\n", why);
  return 1;
}

int calibrate(const CalibrateOptions& options) {
  if (!options.convert.empty()) return convert(options);
  if (options.images.empty())
    throw InputError(
        "calibrate: IMAGES are required: files, a folder of them, or a video; or a calibration file to --convert");
  refuse_options(options, {"--camera", "--image-size"},
                 "is for a file to --convert, and images tell their size themselves");
  const auto output = output_of(options);
  const auto board = choose_board(options, *open(options));
  if (!board) return refuse_without_board(options);
  CalibrationViews views = collect(board->size, *open(options));
  CameraCalibration calibration = calibrate_camera(views, settings_of(options, output));
  explain_wrong_board(options, views, calibration);
  refuse_useless_lens(views, calibration);
  const bool refused = !calibration.refusal.empty();
  CalibrationAnswer answer{views, calibration, board->source, options.square_m,
                           refused || !output ? "" : options.out};
  if (!answer.written.empty())
    write_durably(output->file,
                  calibration_text(camera_settings(*calibration.lens, views.width_px(), views.height_px()),
                                   output->format, calibration_comment(answer)));
  fmt::print("{}", options.json ? calibration_json(answer) : calibration_report(answer));
  if (refused)
    print_message("calibrate: refused: {}{}\n", calibration.refusal, output ? "; nothing is written" : "");
  if (!answer.written.empty())
    print_message("calibrate: written: {} ({})\n", options.out, name_of(output->format));
  return refused ? 1 : 0;
}

}  // namespace

CLI::App* add_calibrate(CLI::App& app, std::function<int()>& job) {
  CLI::App* command = app.add_subcommand(
      "calibrate",
      "Camera intrinsics from images of a chessboard; converts calibration files of Kalibr, ROS and OpenCV");
  const auto o = std::make_shared<CalibrateOptions>();
  command->add_option(
      "IMAGES", o->images,
      "Images of a chessboard: files, or folders of them; 10 to 20, each tilted differently; or one video");
  command->add_option("--board", o->board,
                      "Inner corners per row and column, where four squares meet: 9x6 [guessed]");
  command
      ->add_option("--square", o->square_m,
                   "Side of a square, m; for the distances only: the camera does not depend on it")
      ->check(CLI::Range(1e-4, 100.0));
  command
      ->add_option("--model", o->model,
                   "pinhole (k1 k2 p1 p2, and k3 if the views determine it), fisheye (Kannala-Brandt), auto")
      ->check(CLI::IsMember({"pinhole", "fisheye", "auto"}))
      ->capture_default_str();
  command->add_option("--out", o->out, "Calibration file to write");
  command->add_option("--format", o->format, "kalibr, ros, opencv or incognita [by the name of the file]")
      ->check(CLI::IsMember({"kalibr", "ros", "opencv", "incognita"}));
  command->add_flag("--json", o->json, "One JSON document on standard output");
  command->add_option("--convert", o->convert,
                      "Calibration file to read instead of images; without --out it is printed as [camera]");
  command->add_option("--camera", o->camera, "Camera of a converted file with several: cam1, P2 [the first]");
  command->add_option("--image-size", o->image_size,
                      "Size of the images in px, for converted files without it: 1241x376");
  command->footer(
      "Examples:\n  incognita calibrate photos/ --square 0.025 --out camera.toml\n  incognita calibrate --convert camchain.yaml --out "
      "camera_info.yaml\n\ndocs/calibrate-a-camera.md says how to take the images.\n");
  command->callback([o, command, &job] {
    for (const CLI::Option* option : command->get_options())
      if (option->count() > 0) o->given.push_back(option->get_name());
    job = [o] { return calibrate(*o); };
  });
  return command;
}

}  // namespace incognita
