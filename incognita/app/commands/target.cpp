#include "incognita/app/commands/target.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "incognita/app/console/print_message.hpp"
#include "incognita/io/calibrations/read_calibration.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/image_file.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "incognita/io/scenario/target_file.hpp"
#include "incognita/io/targets/cut_target.hpp"
#include "incognita/io/targets/printed_target.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/durable_file.hpp"

namespace incognita {
namespace fs = std::filesystem;
namespace {

struct TargetOptions {
  std::string image, paper = "a4", size, camera, out;
  std::vector<std::string> corners;
  bool print = false;
  std::vector<std::string> given;  ///< the names of the options on the command line
};

/// Throws InputError for the first option that is given and does not apply.
void refuse_unused(const TargetOptions& options, std::initializer_list<const char*> names, const char* why) {
  for (const char* name : names)
    if (std::find(options.given.begin(), options.given.end(), name) != options.given.end())
      throw InputError(fmt::format("target: {} {}; leave it out", name, why));
}

using NewFiles = std::vector<std::pair<fs::path, std::string>>;  // with their contents

/// Two numbers separated by `separator`.
Eigen::Vector2d pair_of(const std::string& text, char separator, const std::string& what) {
  Eigen::Vector2d numbers;
  const char *begin = text.data(), *end = begin + text.size();
  const auto first = std::from_chars(begin, end, numbers[0]);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == separator) {
    const auto second = std::from_chars(first.ptr + 1, end, numbers[1]);
    if (second.ec == std::errc() && second.ptr == end && numbers.allFinite()) return numbers;
  }
  throw InputError(fmt::format("{}, and is `{}`", what, text));
}

constexpr std::size_t largest_replaced_toml = 1 << 20;  // bytes; a target file has some thousand

bool is_own_target(const fs::path& toml) {
  return file_exists(toml) && is_written_target(read_file(toml, largest_replaced_toml));
}

/// Before anything is written: refuses the files of a target whose place another file has. Images beside a target file that this
/// command wrote are of that target.
void refuse_to_replace_files(const NewFiles& files, const fs::path& toml, const std::string& image) {
  const bool is_own = is_own_target(toml);
  for (const auto& [file, content] : files) {
    std::error_code none;
    if (!image.empty() && fs::equivalent(file, image, none))
      throw InputError(fmt::format(
          "{}: is the photograph, and would be overwritten; choose another name with --out", file.string()));
    if (!is_own && fs::exists(fs::symlink_status(file)))
      throw InputError(fmt::format(
          "{}: exists, and is not of a target that `incognita target` wrote; choose another name with --out, or move it away",
          file.string()));
  }
}

/// Files of a target in the folder of `toml`.
NewFiles new_files(const NewTarget& target, const fs::path& toml) {
  NewFiles files;
  for (const auto& [name, content] : target_files(target, toml.stem().string()))
    files.emplace_back(toml.parent_path() / name, content);
  return files;
}

void write_files(const NewFiles& files) {
  for (const auto& [file, content] : files) write_durably(file, content);
}

/// Reads the target as a run will.
void print_written(const fs::path& toml) {
  const Target read = read_target(toml);
  fmt::print("written: {}, with {} corners and their images beside it\n", toml.string(), read.corners.size());
}

void print_use(const fs::path& toml) {
  fmt::print(
      "use:     [start] from = \"target\", target = \"{}\" in a scenario beside it (docs/start-from-a-target.md)\n",
      toml.filename().string());
}

/// The target file for the name of an output: `sheet`, `sheet.toml` or `sheet.pdf`.
fs::path toml_of(const std::string& out) {
  fs::path toml = out;
  if (toml.extension() == ".toml" || toml.extension() == ".pdf") toml.replace_extension();
  if (toml.filename().empty())
    throw InputError(fmt::format("--out {}: must be the name of a target, as sheet", out));
  if (toml.has_parent_path() && !fs::is_directory(toml.parent_path()))
    throw InputError(toml.parent_path().string() +
                     ": is no folder; create it, or choose another one with --out");
  toml += ".toml";
  return toml;
}

int print_target(const TargetOptions& options) {
  if (!options.image.empty()) throw InputError("target: IMAGE or --print, not both");
  refuse_unused(options, {"--size", "--corners", "--camera"},
                "is for a target from a photograph, and --print has a size of its own");
  const Paper paper = *paper_of(options.paper);
  const fs::path toml = toml_of(options.out.empty() ? "target.pdf" : options.out);
  fs::path pdf = toml;
  pdf.replace_extension(".pdf");
  NewFiles files = new_files(printed_target(paper), toml);
  files.emplace_back(pdf, target_pdf(paper));
  refuse_to_replace_files(files, toml, "");
  write_files(files);
  fmt::print(
      "written: {}, {} landscape: print it at 100 % (not `fit to page`), and measure the line of 100 mm\n",
      pdf.string(), paper.name);
  print_written(toml);
  print_use(toml);
  return 0;
}

TargetCut cut_of(const TargetOptions& options, const Image& photograph) {
  TargetCut cut;
  if (options.corners.size() != 4)
    throw InputError(
        fmt::format("--corners: must be 4 corners u,v in px, clockwise from the upper left, and {} are given",
                    options.corners.size()));
  for (std::size_t i = 0; i < 4; ++i)
    cut.corners_px[i] = pair_of(options.corners[i], ',',
                                fmt::format("--corners: corner {} must be u,v in px, as 120.5,80", i));
  if (options.size.empty())
    throw InputError("--size is required: width and height between the corners, m, as 0.21x0.149");
  const Eigen::Vector2d size =
      pair_of(options.size, 'x', "--size: must be width and height between the corners, m, as 0.21x0.149");
  if (!(size.minCoeff() >= 0.005 && size.maxCoeff() <= 100))
    throw InputError(fmt::format("--size {}: must be in m, 0.005 to 100", options.size));
  cut.width_m = size.x(), cut.height_m = size.y();
  if (options.camera.empty()) return cut;
  const CameraSettings camera = read_calibration(options.camera);
  if (camera.width_px != photograph.width() || camera.height_px != photograph.height())
    throw InputError(fmt::format("{}: is for images of {}x{} px, and {} has {}x{}", options.camera,
                                 camera.width_px, camera.height_px, options.image, photograph.width(),
                                 photograph.height()));
  cut.camera = make_camera(camera);
  return cut;
}

int cut_from_photograph(const TargetOptions& options) {
  if (options.image.empty()) throw InputError("target: IMAGE is required, or --print for a target to print");
  refuse_unused(options, {"--paper"}, "is for --print");
  const fs::path toml = toml_of(options.out.empty() ? "target" : options.out);
  Image photograph;
  try {
    photograph = read_image(options.image);
  } catch (const std::runtime_error& error) {
    throw InputError(error.what());
  }
  const TargetCut cut = cut_of(options, photograph);
  if (!cut.camera)
    print_message(
        "target: without --camera the photograph must be free of distortion: straight edges must be straight in it\n");
  try {
    CutTarget made = cut_target(photograph, cut);
    made.target.comment = fmt::format(
        "Cut by `incognita target` from {}, {} m between the corners. Its center is the origin of the world.",
        fs::path(options.image).filename().string(), options.size);
    const NewFiles files = new_files(made.target, toml);
    refuse_to_replace_files(files, toml, options.image);
    for (const std::string& note : made.notes) print_message("target: {}\n", note);
    write_files(files);
    print_written(toml);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", options.image, error.what()));
  }
  print_use(toml);
  return 0;
}

}  // namespace

CLI::App* add_target(CLI::App& app, std::function<int()>& job) {
  CLI::App* command = app.add_subcommand(
      "target", "A target of known size to start from: one to print, or one cut from a photograph");
  const auto o = std::make_shared<TargetOptions>();
  command->add_option("IMAGE", o->image,
                      "Photograph of a flat rectangle of known size: a poster, a book, a screen");
  command->add_flag("--print", o->print,
                    "A target to print, as PDF at true scale, with its target file beside it");
  command->add_option("--paper", o->paper, "a4 or letter")
      ->check(CLI::IsMember({"a4", "letter"}))
      ->capture_default_str();
  command
      ->add_option("--corners", o->corners,
                   "Corners u,v of the rectangle in the photograph, px, clockwise from the upper left")
      ->expected(4);
  command->add_option("--size", o->size, "Width and height between the corners, m: 0.21x0.149");
  command->add_option("--camera", o->camera, "Calibration file of the camera that took the photograph");
  command->add_option("--out", o->out, "Name of the target, in an existing folder [target]");
  command->footer(
      "Examples:\n  incognita target --print --out sheet.pdf\n  incognita target poster.jpg --corners 120,80 520,84 515,360 118,350 --size "
      "0.42x0.297 --camera camera.toml --out poster\n\ndocs/start-from-a-target.md has the steps.\n");
  command->callback([o, command, &job] {
    for (const CLI::Option* option : command->get_options())
      if (option->count() > 0) o->given.push_back(option->get_name());
    job = [o] { return o->print ? print_target(*o) : cut_from_photograph(*o); };
  });
  return command;
}

}  // namespace incognita
