// `incognita calibrate` as a user runs it: from images, and from calibration files.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "incognita/io/calibrations/read_calibration.hpp"
#include "incognita/models/sensors/pinhole_camera.hpp"
#include "tests/app/program.hpp"
#include "tests/record/schema.hpp"
#include "tests/scratch.hpp"
#include "tests/vision/rendered_board.hpp"

namespace incognita {
namespace {

using testing::BoardPhotographer;
using testing::Ended;
using testing::Scratch;
using testing::Words;
using Json = nlohmann::json;

const PinholeCamera true_camera{320, 240, 260, 258, 163, 117.5, -0.25, 0.08, 0.001, -0.0005, 0};
const BoardSize true_board{9, 6};

void save(const Image& image, const std::filesystem::path& file) {
  cv::Mat pixels(image.height(), image.width(), CV_8U);
  std::memcpy(pixels.data, image.row(0), pixels.total());
  ASSERT_TRUE(cv::imwrite(file.string(), pixels));
}

/// A folder with images of a board, rendered once.
const Scratch& photographs() {
  static const Scratch scratch;
  static const bool made = [] {
    std::filesystem::create_directories(scratch / "photos");
    const BoardPhotographer photographer(true_camera, true_board);
    int number = 0;
    for (const testing::BoardPlace& place : testing::careful_places(260.0 / 320, 9))
      save(photographer.take(place), scratch / ("photos/view" + std::to_string(number++) + ".png"));
    save(photographer.take({{0, 0, 13}, 0.3, 0.2, 0}, {.blur_px = 3}), scratch / "photos/view10-blurred.png");
    scratch.write("photos/view11-cut.png", "\x89PNG");
    save(Image(320, 240, 99), scratch / "gray.png");
    return true;
  }();
  EXPECT_TRUE(made);
  return scratch;
}

Ended calibrate(Words words) {
  words.insert(words.begin(), "calibrate");
  return testing::incognita(words, photographs().folder());
}

void expect_valid(const Json& answer) {
  const Json schema = Json::parse(
      testing::contents(std::filesystem::path(INCOGNITA_SOURCE_DIR) / "docs/schemas/calibrate.schema.json"));
  EXPECT_EQ(testing::problems(answer, schema), "");
}

TEST(ProgramCalibrate, FindsTheCameraAndWritesIt) {
  const Ended done = calibrate({"photos", "--square", "0.025", "--out", "camera.toml"});
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_SAYS(done.out, "board      9x6 inner corners (guessed: ");
  EXPECT_SAYS(done.out, "view10-blurred.png: refused: blurred: the edges of its squares are ");
  EXPECT_SAYS(done.out, "view11-cut.png: refused: ");
  EXPECT_SAYS(done.out, "coverage ");
  EXPECT_SAYS(done.err, "written: camera.toml ([camera] of a scenario)");
  const CameraSettings camera = read_calibration(photographs() / "camera.toml");
  EXPECT_NEAR(camera.fu_px, 260, 1);
  EXPECT_NEAR(camera.v0_px, 117.5, 1);
  EXPECT_SAYS(testing::contents(photographs() / "camera.toml"), "Standard deviations: fu_px ");
}

TEST(ProgramCalibrate, AnswersInJson) {
  const Ended done =
      calibrate({"photos", "--board", "9x6", "--square", "0.025", "--model", "pinhole", "--json"});
  EXPECT_EQ(done.code, 0) << done.err;
  const Json answer = Json::parse(done.out);
  expect_valid(answer);
  EXPECT_EQ(answer["status"], "done");
  EXPECT_EQ(answer["board"]["source"], "given");
  EXPECT_NEAR(answer["parameters"]["fu_px"]["value"].get<double>(), 260, 1);
  EXPECT_GT(answer["parameters"]["fu_px"]["sigma"].get<double>(), 0);
  EXPECT_NEAR(answer["views"][0]["distance_m"].get<double>(),
              0.025 * answer["views"][0]["distance_squares"].get<double>(), 1e-9);
  EXPECT_FALSE(answer["views"].back()["used"].get<bool>());
}

TEST(ProgramCalibrate, WritesTheOtherFormats) {
  for (const auto& [file, format] : {std::pair{"camchain.yaml", CalibrationFormat::kalibr},
                                     {"ros.yaml", CalibrationFormat::ros},
                                     {"camera.yml", CalibrationFormat::opencv}}) {
    const Ended done = calibrate({"photos", "--board", "9x6", "--out", file});
    EXPECT_EQ(done.code, 0) << done.err;
    const CalibrationFile read = read_calibration_file(photographs() / file);
    EXPECT_EQ(read.format, format);
    EXPECT_NEAR(read.calibrated.camera.fv_px, 258, 1);
  }
}

/// The photographs as a video of one image per second, without loss.
std::filesystem::path film() {
  const std::filesystem::path file = photographs() / "film.mkv";
  if (std::filesystem::exists(file)) return file;
  cv::VideoWriter video(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 1,
                        cv::Size(true_camera.width, true_camera.height));
  for (int number = 0; number < 9; ++number)
    video.write(cv::imread((photographs() / ("photos/view" + std::to_string(number) + ".png")).string()));
  return file;
}

TEST(ProgramCalibrate, TakesTheImagesOfAVideo) {
  ASSERT_TRUE(std::filesystem::exists(film()));
  const Ended done = calibrate({"film.mkv", "--json"});
  EXPECT_EQ(done.code, 0) << done.err;
  const Json answer = Json::parse(done.out);
  expect_valid(answer);
  EXPECT_EQ(answer["views"].size(), 9u);
  EXPECT_EQ(answer["views"][3]["name"], "film.mkv at 3.00 s");
  EXPECT_NEAR(answer["parameters"]["fu_px"]["value"].get<double>(), 260, 1);
  const Ended larger = calibrate({"film.mkv", "--board", "10x7"});
  EXPECT_EQ(larger.code, 1);
  EXPECT_SAYS(larger.err, "film.mkv at 0.00 s shows a board of 9x6 inner corners: use --board 9x6");
}

TEST(ProgramCalibrate, RefusesWithTheReason) {
  const Ended one = calibrate({"photos/view1.png", "--out", "one.toml"});
  EXPECT_EQ(one.code, 1);
  EXPECT_SAYS(one.err, "calibrate: refused: one view does not determine a focal length");
  EXPECT_SAYS(one.err, "nothing is written");
  EXPECT_FALSE(std::filesystem::exists(photographs() / "one.toml"));
  const Ended gray = calibrate({"gray.png", "--json"});
  EXPECT_EQ(gray.code, 1);
  EXPECT_SAYS(gray.err, "calibrate: refused: no image shows a chessboard");
  const Json answer = Json::parse(gray.out);
  expect_valid(answer);
  EXPECT_EQ(answer["status"], "refused");
  const Ended larger = calibrate({"photos", "--board", "10x7"});
  EXPECT_EQ(larger.code, 1);
  EXPECT_SAYS(larger.err, "shows a board of 9x6 inner corners: use --board 9x6");
  const Ended blurred = calibrate({"photos/view10-blurred.png", "--board", "9x6", "--json"});
  EXPECT_EQ(blurred.code, 1);
  expect_valid(Json::parse(blurred.out));
}

TEST(ProgramCalibrate, UsageErrorsSayWhatToDo) {
  const auto refused = [](const Words& words) {
    const Ended ended = calibrate(words);
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_EQ(ended.out, "");
    return ended.err;
  };
  EXPECT_SAYS(refused({}), "IMAGES are required");
  EXPECT_SAYS(refused({"nowhere"}), "nowhere: there is no such file or folder");
  EXPECT_SAYS(refused({"photos", "--board", "9"}), "--board 9: must be the inner corners per row and column");
  EXPECT_SAYS(refused({"photos", "--board", "7x5"}), "show a board of 9x6 inner corners: use --board 9x6");
  EXPECT_SAYS(refused({"photos", "--out", "nowhere/camera.toml"}), "nowhere: is no folder");
  EXPECT_SAYS(refused({"photos", "--out", "camera.png"}), "the ending tells no format");
  EXPECT_SAYS(refused({"photos", "--format", "ros"}), "--format needs the file to write");
  EXPECT_SAYS(refused({"photos", "--model", "omni"}), "--model");
}

std::string refusal_of(const Words& words) {
  const Ended ended = calibrate(words);
  EXPECT_EQ(ended.code, 2) << ended.err;
  return ended.err;
}

TEST(ProgramCalibrate, NeverReplacesAScenario) {
  photographs().write("cam.txt", "fx 420\nfy 420\ncx 320\ncy 240\nwidth 640\nheight 480\n");
  const auto out = [](const char* file, const std::string& before) {
    photographs().write(file, before);
    const std::string why = refusal_of({"--convert", "cam.txt", "--out", file, "--format", "incognita"});
    EXPECT_EQ(testing::contents(photographs() / file), before);
    return why;
  };
  EXPECT_SAYS(out("mine.toml", "[camera]\nwidth_px = 640\n[loop]\nseed = 1\n"),
              "--out mine.toml: exists, and has more than the section [camera] (`loop` in line 3)");
  EXPECT_SAYS(out("mine.toml", "seed = 1\n"),
              "choose another file with --out, and copy the section [camera]");
  EXPECT_SAYS(out("mine.toml", "[camera\n"), "--out mine.toml: exists, and cannot be read as a calibration");
  EXPECT_SAYS(out("notes.txt", "my notes\n"), "--out notes.txt: exists, and cannot be read as a calibration");
  photographs().write("mine.toml", "base = \"room\"\n");
  EXPECT_SAYS(refusal_of({"photos", "--out", "mine.toml"}), "(`base` in line 1)");
  EXPECT_SAYS(refusal_of({"photos", "--out", "mine.toml", "--format", "ros"}), "(`base` in line 1)");
  photographs().write("mine.toml", "# old\n[camera]\nwidth_px = 320\n");
  EXPECT_EQ(calibrate({"--convert", "cam.txt", "--out", "mine.toml"}).code, 0);
  EXPECT_EQ(read_calibration(photographs() / "mine.toml").width_px, 640);
}

TEST(ProgramCalibrate, NeverReplacesTheFileThatItConverts) {
  const std::string two_cameras =
      "cam0:\n  camera_model: pinhole\n  distortion_coeffs: [0, 0, 0, 0]\n  distortion_model: radtan\n"
      "  intrinsics: [420, 420, 320, 240]\n  resolution: [640, 480]\n"
      "cam1:\n  camera_model: pinhole\n  distortion_coeffs: [0, 0, 0, 0]\n  distortion_model: radtan\n"
      "  intrinsics: [430, 430, 320, 240]\n  resolution: [640, 480]\n";
  const std::filesystem::path file = photographs().write("camchain.yaml", two_cameras);
  std::filesystem::create_symlink("camchain.yaml", photographs() / "link.yaml");
  for (const std::string& out : {std::string("camchain.yaml"), file.string(), std::string("link.yaml")}) {
    EXPECT_SAYS(refusal_of({"--convert", "camchain.yaml", "--out", out}),
                "--out " + out + ": is the file to convert, and is not replaced");
    EXPECT_EQ(testing::contents(file), two_cameras);
  }
  EXPECT_EQ(calibrate({"--convert", "camchain.yaml", "--camera", "cam1", "--out", "cam1.yaml"}).code, 0);
  EXPECT_EQ(read_calibration(photographs() / "cam1.yaml").fu_px, 430);
}

TEST(ProgramCalibrate, RefusesOptionsThatDoNotApply) {
  photographs().write("cam.txt", "fx 420\nfy 420\ncx 320\ncy 240\nwidth 640\nheight 480\n");
  EXPECT_SAYS(refusal_of({"--convert", "cam.txt", "--board", "9x6"}),
              "--board is for a calibration from images");
  EXPECT_SAYS(refusal_of({"--convert", "cam.txt", "--model", "auto"}),
              "--model is for a calibration from images");
  EXPECT_SAYS(refusal_of({"--convert", "cam.txt", "--square", "0.02"}),
              "--square is for a calibration from images");
  EXPECT_SAYS(refusal_of({"--convert", "cam.txt", "--json"}), "--json is for a calibration from images");
  EXPECT_SAYS(refusal_of({"photos", "--camera", "cam1"}), "--camera is for a file to --convert");
  EXPECT_SAYS(
      refusal_of({"--convert", "cam.txt", "--camera", "cam1"}),
      "cam.txt: is read as a key and its number per line, which has one camera: leave out --camera cam1");
  EXPECT_SAYS(refusal_of({"photos", "--image-size", "320x240"}), "--image-size is for a file to --convert");
  EXPECT_SAYS(refusal_of({"photos", "--view"}), "images or --view, not both");
  EXPECT_SAYS(refusal_of({"photos", "--https"}), "--https is for the page, with --view");
  EXPECT_SAYS(refusal_of({"--view", "--camera", "cam1"}), "--camera is for a file to --convert");
  EXPECT_SAYS(refusal_of({"--view", "--board", "9"}), "--board 9: must be the inner corners");
  EXPECT_SAYS(refusal_of({"--view", "--image-size", "640"}), "--image-size 640: must be width and height");
  EXPECT_SAYS(refusal_of({"--phone", "--out", "gone/camera.toml"}), "gone: is no folder");
  EXPECT_SAYS(refusal_of({"--convert", "camchain.yaml", "--view"}), "--view takes images of a camera");
}

TEST(ProgramCalibrate, ConvertsFiles) {
  photographs().write("calib.txt", "P0: 718.856 0 607.1928 0 0 718.856 185.2157 0 0 0 1 0\n");
  const Ended shown = calibrate({"--convert", "calib.txt", "--image-size", "1241x376"});
  EXPECT_EQ(shown.code, 0) << shown.err;
  EXPECT_SAYS(shown.err, "calib.txt: recognized as KITTI calib.txt");
  EXPECT_SAYS(shown.out, "[camera]\nmodel = \"pinhole\"\n");
  EXPECT_SAYS(shown.out, "\nwidth_px = 1241\nheight_px = 376\n");
  const Ended written = calibrate(
      {"--convert", "calib.txt", "--image-size", "1241x376", "--out", "kitti.yaml", "--format", "ros"});
  EXPECT_EQ(written.code, 0) << written.err;
  EXPECT_EQ(read_calibration(photographs() / "kitti.yaml").u0_px, 607.1928);
  const auto refused = [](const Words& words) {
    const Ended ended = calibrate(words);
    EXPECT_EQ(ended.code, 2) << ended.err;
    return ended.err;
  };
  EXPECT_SAYS(refused({"--convert", "calib.txt"}), "calib.txt: has no image size");
  EXPECT_SAYS(refused({"--convert", "calib.txt", "--image-size", "1241"}),
              "--image-size 1241: must be width and height");
  EXPECT_SAYS(refused({"--convert", "gone.yaml"}), "gone.yaml: cannot be read");
  EXPECT_SAYS(refused({"--convert", "calib.txt", "photos"}), "images or --convert, not both");
  EXPECT_SAYS(refused({"--convert", "calib.txt", "--out", "x.xml"}),
              "--out x.xml: the ending tells no format");
}

}  // namespace
}  // namespace incognita
