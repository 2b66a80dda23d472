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
#include <system_error>
#include <utility>
#include <vector>

#include "incognita/app/commands/calibrate_live.hpp"
#include "incognita/app/commands/calibration_output.hpp"
#include "incognita/app/console/print_message.hpp"
#include "incognita/app/console/progress.hpp"
#include "incognita/io/calibrations/read_calibration.hpp"
#include "incognita/io/calibrations/write_calibration.hpp"
#include "incognita/io/formats/image_files.hpp"
#include "incognita/io/recordings/video.hpp"
#include "incognita/io/recordings/video_images.hpp"
#include "incognita/messages/errors.hpp"
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
  std::vector<std::string> view;  ///< the port, if the page is wanted
  PageOptions page;
  std::vector<std::string> given;  ///< the names of the options on the command line
};

/// Throws InputError for the first option that is given and does not apply.
void refuse_options(const CalibrateOptions& options, std::initializer_list<const char*> names,
                    const char* why) {
  for (const char* name : names)
    if (std::find(options.given.begin(), options.given.end(), name) != options.given.end())
      throw InputError(fmt::format("calibrate: {} {}; leave it out", name, why));
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

/// The written file has one camera: what else the converted file holds would be lost.
void refuse_to_replace_source(const CalibrateOptions& options) {
  std::error_code not_there;
  if (fs::equivalent(options.convert, options.out, not_there))
    throw InputError(fmt::format(
        "--out {}: is the file to convert, and is not replaced: further cameras and extrinsics in it would be lost; choose "
        "another file with --out",
        options.out));
}

int convert(const CalibrateOptions& options) {
  if (!options.images.empty()) throw InputError("calibrate: images or --convert, not both");
  refuse_options(options, {"--board", "--square", "--model", "--json"},
                 "is for a calibration from images, and --convert reads a file");
  refuse_options(options, {"--view", "--phone"}, "takes images of a camera, and --convert reads a file");
  refuse_to_replace_source(options);
  const auto output = calibration_output(options.out, options.format);
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

/// --board; nothing without it.
std::optional<BoardSize> given_board(const CalibrateOptions& options) {
  if (options.board.empty()) return std::nullopt;
  const auto given = parse_board(options.board);
  if (!given)
    throw InputError(fmt::format("--board {}: must be the inner corners per row and column, 3 to 50, as 9x6",
                                 options.board));
  return given;
}

/// The board that is given, unless the images show a larger one; else the one that they show. Nothing if they show none.
std::optional<ChosenBoard> choose_board(const CalibrateOptions& options, ImageSource& images) {
  const auto given = given_board(options);
  const GuessedBoard guess = guess_board(images);
  if (!given) {
    if (!guess.board) return std::nullopt;
    return ChosenBoard{*guess.board,
                       fmt::format("guessed: {} of {} images show it", guess.shown, guess.tried)};
  }
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
  images.rewind();
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
void explain_wrong_board(const CalibrateOptions& options, const CalibrationViews& views, ImageSource& images,
                         CameraCalibration& calibration) {
  if (views.used() >= least_views || options.board.empty()) return;
  const GuessedBoard guess = guess_board(images);
  if (!guess.board || guess.board->is_like(views.board())) return;
  calibration.refusal += fmt::format(
      "; {} shows a board of {} inner corners: use --board {} (corners are counted where four squares meet, not squares)",
      guess.example, guess.board->text(), guess.board->text());
}

CalibrationSettings settings_of(const CalibrateOptions& options,
                                const std::optional<CalibrationOutput>& output) {
  using Model = CalibrationSettings::Model;
  CalibrationSettings settings;
  if (options.model != "auto") settings.model = options.model == "fisheye" ? Model::fisheye : Model::pinhole;
  settings.allow_third_radial = !output || output->format != CalibrationFormat::kalibr;
  return settings;
}

/// camera.toml, or the first of camera-2.toml, ... that does not exist: the calibration there may be that of another camera.
std::string new_file() {
  std::string file = "camera.toml";
  for (int number = 2; fs::exists(file); ++number) file = fmt::format("camera-{}.toml", number);
  return file;
}

int calibrate_from_page(const CalibrateOptions& options) {
  if (!options.images.empty()) throw InputError("calibrate: images or --view, not both");
  refuse_options(options, {"--camera"}, "is for a file to --convert");
  CalibrateLiveOptions live;
  live.page = options.page;
  if (!options.view.empty()) live.page.port = options.view.back();
  live.settings.board = given_board(options);
  const auto output = calibration_output(options.out.empty() ? new_file() : options.out, options.format);
  live.settings.fit = settings_of(options, output);
  live.image_size_px = image_size_of(options);
  live.reporting = {"", options.square_m, options.json};
  live.output = *output;
  return calibrate_live(live);
}

int calibrate(const CalibrateOptions& options) {
  const bool from_page = !options.view.empty() || options.page.phone;
  if (!from_page)
    refuse_options(options, {"--view-address", "--allow-origin", "--https"}, "is for the page, with --view");
  if (!options.convert.empty()) return convert(options);
  if (from_page) return calibrate_from_page(options);
  if (options.images.empty())
    throw InputError(
        "calibrate: IMAGES are required: files, a folder of them, or a video; or --view to use the camera of a browser; or a "
        "calibration file to --convert");
  refuse_options(options, {"--camera", "--image-size"},
                 "is for a file to --convert, and images tell their size themselves");
  const auto output = calibration_output(options.out, options.format);
  const std::unique_ptr<ImageSource> images = open(options);
  const auto board = choose_board(options, *images);
  if (!board) return refuse_without_board(options.json);
  CalibrationViews views = collect(board->size, *images);
  CameraCalibration calibration = calibrate_camera(views, settings_of(options, output));
  explain_wrong_board(options, views, *images, calibration);
  return conclude_calibration(views, calibration, {board->source, options.square_m, options.json}, output);
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
  command->add_option(
      "--image-size", o->image_size,
      "Size of the images in px: of a converted file without it, or to ask of the camera with --view: 640x480");
  command->add_flag(
      "--view{0}", o->view,
      "Use the camera of a browser: serve a page that takes the views; =PORT, else any free one [writes camera.toml, or camera-2.toml, ...]");
  add_access_options(*command, o->page);
  command->footer(
      "Examples:\n  incognita calibrate photos/ --square 0.025 --out camera.toml\n  incognita calibrate --view --board 9x6\n  incognita calibrate --phone\n  incognita calibrate --convert camchain.yaml --out "
      "camera_info.yaml\n\ndocs/calibrate-a-camera.md says how to take the images.\n");
  command->callback([o, command, &job] {
    for (const CLI::Option* option : command->get_options())
      if (option->count() > 0) o->given.push_back(option->get_name());
    job = [o] { return calibrate(*o); };
  });
  return command;
}

}  // namespace incognita
