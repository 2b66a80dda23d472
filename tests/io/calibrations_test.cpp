// Calibration files of every format: what they mean, what is written, and every kind of invalid file.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "incognita/io/calibrations/read_calibration.hpp"
#include "incognita/io/calibrations/write_calibration.hpp"
#include "incognita/io/formats/data_folder.hpp"
#include "incognita/io/scenario/camera.hpp"
#include "tests/io/damage.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

/// Of the wiki of Kalibr, two cameras.
const std::string camchain =
    "cam0:\n  cam_overlaps: [1]\n  camera_model: pinhole\n"
    "  distortion_coeffs: [-0.2834, 0.0739, 0.0001, 1.76e-05]\n  distortion_model: radtan\n"
    "  intrinsics: [461.629, 460.152, 362.680, 246.049]\n  resolution: [752, 480]\n  rostopic: /cam0/image_raw\n"
    "cam1:\n  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, -0.11]\n  - [0.0, 1.0, 0.0, 0.0]\n  - [0.0, 0.0, 1.0, 0.0]\n"
    "  - [0.0, 0.0, 0.0, 1.0]\n  cam_overlaps: [0]\n  camera_model: pinhole\n"
    "  distortion_coeffs: [0.01, -0.02, 0.03, -0.004]\n  distortion_model: equidistant\n"
    "  intrinsics: [190.97, 190.96, 254.93, 256.89]\n  resolution: [512, 512]\n  rostopic: /cam1/image_raw\n";

/// As camera_calibration of ROS writes it.
const std::string camera_info =
    "image_width: 640\nimage_height: 480\ncamera_name: narrow_stereo\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
    "  data: [535.9, 0., 342.2, 0., 536.1, 235.5, 0., 0., 1.]\ndistortion_model: plumb_bob\n"
    "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [-0.266, -0.0386, 0.00178, -0.00028, 0.238]\n"
    "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1., 0., 0., 0., 1., 0., 0., 0., 1.]\n"
    "projection_matrix:\n  rows: 3\n  cols: 4\n  data: [500., 0., 340., 0., 0., 510., 230., 0., 0., 0., 1., 0.]\n";

/// As the calibration sample of OpenCV writes it.
const std::string opencv_yaml =
    "%YAML:1.0\n---\ncalibration_time: \"Tue 01 Jan\"\nimage_width: 640\nimage_height: 480\nfisheye_model: 0\n"
    "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 5.3591573396163199e+02, 0., 3.4228315473308373e+02, 0.,\n"
    "       5.3591573396163199e+02, 2.3557082909788173e+02, 0., 0., 1. ]\n"
    "distortion_coefficients: !!opencv-matrix\n   rows: 5\n   cols: 1\n   dt: d\n"
    "   data: [ -2.6637260909660682e-01, -3.8588898922304653e-02,\n"
    "       1.7831947042852964e-03, -2.8122100441115472e-04,\n       2.3839153080878486e-01 ]\n";

const std::string opencv_xml =
    "<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_width>640</image_width>\n<image_height>480</image_height>\n"
    "<camera_matrix type_id=\"opencv-matrix\">\n  <rows>3</rows>\n  <cols>3</cols>\n  <dt>d</dt>\n"
    "  <data>\n    535.5 0. 342.25 0. 536.5 235.5 0. 0. 1.</data></camera_matrix>\n"
    "<distortion_coefficients type_id=\"opencv-matrix\">\n  <rows>5</rows>\n  <cols>1</cols>\n  <dt>d</dt>\n"
    "  <data>\n    -0.25 0.5 0.125 -0.0625 1.5</data></distortion_coefficients>\n</opencv_storage>\n";

const std::string kitti =
    "P0: 7.188560000000e+02 0.0e+00 6.071928000000e+02 0.0e+00 0.0e+00 7.188560000000e+02 1.852157000000e+02 0.0e+00 0.0e+00 0.0e+00 "
    "1.0e+00 0.0e+00\n"
    "P2: 7.070912000000e+02 0 6.018873000000e+02 -1.818708e+02 0 7.070912000000e+02 1.831104000000e+02 1.2e+00 0 0 1 0.4\n";

const std::string plain =
    "fx 420.506712\nfy 420.610940\ncx 355.208298\ncy 250.336787\nk1 -0.296681\nk2 0.080857\np1 0\np2 0\nk3 0\n"
    "width 752\nheight 480\n# source: K.txt\n";

CalibrationFile read(const std::string& name, const std::string& text,
                     const CalibrationRequest& request = {}) {
  const Scratch scratch;
  return read_calibration_file(scratch.write(name, text), request);
}

std::string complaint(const std::string& name, const std::string& text,
                      const CalibrationRequest& request = {}) {
  const Scratch scratch;
  return message_of([&] { read_calibration(scratch.write(name, text), request); });
}

std::string with(std::string text, const std::string& piece, const std::string& other) {
  return text.replace(text.find(piece), piece.size(), other);
}

std::string notes_of(const CalibrationFile& file) {
  std::string notes;
  for (const std::string& note : file.notes) notes += note + "\n";
  return notes;
}

void expect_lens(const CameraSettings& camera, const std::vector<double>& five) {
  const auto* lens = std::get_if<PinholeLens>(&camera.model);
  ASSERT_TRUE(lens);
  EXPECT_EQ((std::vector<double>{lens->k1, lens->k2, lens->p1, lens->p2, lens->k3}), five);
}

TEST(KalibrCalibration, OfTheFirstCameraIsRead) {
  const CalibrationFile file = read("camchain.yaml", camchain);
  EXPECT_EQ(file.format, CalibrationFormat::kalibr);
  const CameraSettings& c = file.calibrated.camera;
  EXPECT_EQ(c.width_px, 752);
  EXPECT_EQ(c.height_px, 480);
  EXPECT_EQ(c.fu_px, 461.629);
  EXPECT_EQ(c.fv_px, 460.152);
  EXPECT_EQ(c.u0_px, 362.680);
  EXPECT_EQ(c.v0_px, 246.049);
  expect_lens(c, {-0.2834, 0.0739, 0.0001, 1.76e-05, 0});
  EXPECT_HAS(notes_of(file), "has 2 cameras (cam0, cam1); cam0 is taken");
}

TEST(KalibrCalibration, OfAChosenCameraMayBeAFisheye) {
  const CalibrationFile file = read("camchain.yaml", camchain, {"cam1", {}});
  const auto& lens = std::get<FisheyeLens>(file.calibrated.camera.model);
  EXPECT_EQ(file.calibrated.camera.width_px, 512);
  EXPECT_EQ(lens.k1, 0.01);
  EXPECT_EQ(lens.k4, -0.004);
  EXPECT_HAS(notes_of(file), "the extrinsics are not used");
  EXPECT_HAS(complaint("c.yaml", camchain, {"cam2", {}}),
             "cam2 is none of the cameras of the file (cam0, cam1)");
}

TEST(KalibrCalibration, OfOtherModelsIsRefused) {
  EXPECT_HAS(complaint("c.yaml", with(camchain, "camera_model: pinhole", "camera_model: omni")),
             "c.yaml: camera_model is `omni`, which no camera model supports; undistort the images");
  EXPECT_HAS(complaint("c.yaml", with(camchain, "radtan", "fov")), "distortion_model is `fov`");
  EXPECT_HAS(complaint("c.yaml", with(camchain, "[461.629,", "[461,629,")),
             "c.yaml:6: intrinsics must be fu, fv");
  EXPECT_HAS(complaint("c.yaml", with(camchain, "[-0.2834,", "[")),
             "c.yaml:4: distortion_coeffs must have 4 numbers, and has 3");
  EXPECT_HAS(complaint("c.yaml", with(camchain, "  resolution: [752, 480]\n", "")),
             "resolution must be a list");
}

TEST(RosCalibration, IsReadOfTheImagesAsTheyCome) {
  const CalibrationFile file = read("ost.yaml", camera_info);
  EXPECT_EQ(file.format, CalibrationFormat::ros);
  const CameraSettings& c = file.calibrated.camera;
  EXPECT_EQ(c.fu_px, 535.9);
  EXPECT_EQ(c.fv_px, 536.1);
  EXPECT_EQ(c.u0_px, 342.2);
  EXPECT_EQ(c.v0_px, 235.5);
  expect_lens(c, {-0.266, -0.0386, 0.00178, -0.00028, 0.238});
  EXPECT_HAS(notes_of(file), "projection_matrix, of rectified images, is not used");
}

TEST(RosCalibration, MayBeAFisheyeOrRational) {
  const std::string four =
      with(camera_info, "-0.266, -0.0386, 0.00178, -0.00028, 0.238", "0.1, 0.2, 0.3, 0.4");
  const CameraSettings c = read("c.yaml", with(four, "plumb_bob", "equidistant")).calibrated.camera;
  EXPECT_EQ(std::get<FisheyeLens>(c.model).k3, 0.3);
  const std::string rational = with(camera_info, "plumb_bob", "rational_polynomial");
  expect_lens(read("c.yaml", with(rational, "0.238]", "0.238, 0, 0, 0]")).calibrated.camera,
              {-0.266, -0.0386, 0.00178, -0.00028, 0.238});
  EXPECT_HAS(complaint("c.yaml", with(rational, "0.238]", "0.238, 0.1, 0, 0]")),
             "there are 8 distortion coefficients, and those beyond the first 5 are not 0");
  EXPECT_HAS(complaint("c.yaml", with(camera_info, "plumb_bob", "thin_prism")),
             "distortion_model is `thin_prism`");
}

TEST(OpencvCalibration, IsReadFromYaml) {
  const CalibrationFile file = read("left_intrinsics.yml", opencv_yaml);
  EXPECT_EQ(file.format, CalibrationFormat::opencv);
  EXPECT_EQ(file.calibrated.camera.fu_px, 5.3591573396163199e+02);
  EXPECT_EQ(file.calibrated.camera.v0_px, 2.3557082909788173e+02);
  expect_lens(file.calibrated.camera,
              {-2.6637260909660682e-01, -3.8588898922304653e-02, 1.7831947042852964e-03,
               -2.8122100441115472e-04, 2.3839153080878486e-01});
}

TEST(OpencvCalibration, IsReadFromXmlAndJson) {
  const CalibrationFile xml = read("out_camera_data.xml", opencv_xml);
  EXPECT_EQ(xml.format, CalibrationFormat::opencv);
  EXPECT_EQ(xml.calibrated.camera.fu_px, 535.5);
  EXPECT_EQ(xml.calibrated.camera.height_px, 480);
  expect_lens(xml.calibrated.camera, {-0.25, 0.5, 0.125, -0.0625, 1.5});
  const std::string json =
      "{ \"image_width\": 640, \"image_height\": 480, \"fisheye_model\": 1,\n \"camera_matrix\": { \"type_id\": \"opencv-matrix\", "
      "\"rows\": 3, \"cols\": 3, \"dt\": \"d\", \"data\": [ 300.5, 0.0, 320.0, 0.0, 301.5, 240.0, 0.0, 0.0, 1.0 ] },\n"
      " \"distortion_coefficients\": { \"data\": [ 0.1, 0.01, 0.0, 0.0 ] } }";
  const CameraSettings camera = read("c.json", json).calibrated.camera;
  EXPECT_EQ(camera.fv_px, 301.5);
  EXPECT_EQ(std::get<FisheyeLens>(camera.model).k2, 0.01);
  EXPECT_HAS(complaint("c.xml", with(opencv_xml, "</opencv_storage>", "")),
             "c.xml:16: is truncated: </opencv_storage> is missing");
  EXPECT_HAS(complaint("c.xml", with(opencv_xml, "536.5 ", "")),
             "c.xml:5: camera_matrix must have 9 numbers, and has 8");
  EXPECT_HAS(complaint("c.xml", with(opencv_xml, "536.5 ", "wide ")),
             "c.xml:5: camera_matrix must hold numbers only");
  EXPECT_HAS(complaint("c.xml", "<svg></svg>"), "c.xml:1: is not XML of OpenCV");
}

TEST(OpencvCalibration, WithoutASizeAsksForIt) {
  const std::string stereo =
      "%YAML:1.0\nM1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   data: [ 530., 0., 340., 0., 531., 230., 0., 0., 1. ]\n"
      "D1: !!opencv-matrix\n   rows: 1\n   cols: 4\n   dt: d\n   data: [ -0.2, 0.1, 0., 0. ]\nM2: !!opencv-matrix\n   rows: 3\n";
  EXPECT_HAS(complaint("intrinsics.yml", stereo), "has no image size");
  EXPECT_HAS(complaint("intrinsics.yml", stereo), "--image-size WIDTHxHEIGHT");
  const CalibrationFile file = read("intrinsics.yml", stereo, {"", {{640, 480}}});
  EXPECT_EQ(file.calibrated.camera.width_px, 640);
  expect_lens(file.calibrated.camera, {-0.2, 0.1, 0, 0, 0});
  EXPECT_HAS(notes_of(file), "are taken for k1 k2 p1 p2");
  EXPECT_HAS(notes_of(file), "M2, D2");
  EXPECT_HAS(complaint("c.yml", opencv_yaml, {"", {{320, 240}}}),
             "is for images of 640x480 px, and --image-size is 320x240");
}

TEST(OpencvCalibration, ErrorsNameTheLine) {
  EXPECT_HAS(complaint("c.yml", with(opencv_yaml, "5.3591573396163199e+02, 0.", "wide, 0.")),
             "c.yml:11: camera_matrix must hold numbers only, and has `wide`");
  EXPECT_HAS(
      complaint("c.yml", with(opencv_yaml, "5.3591573396163199e+02, 0.", "5.3591573396163199e+02, 7.")),
      "c.yml:7: camera_matrix has a skew of 7");
  EXPECT_HAS(complaint("c.yml", with(opencv_yaml, "0., 0., 1. ]", "0., 1. ]")),
             "camera_matrix must have 9 numbers, and has 8");
  EXPECT_HAS(complaint("c.yml", with(opencv_yaml, "image_width: 640", "image_width: wide")),
             "c.yml:4: image_width must be a number, and is `wide`");
  EXPECT_HAS(complaint("c.yml", with(opencv_yaml, "image_width: 640", "image_width: 64.5")),
             "must be of whole pixels");
}

TEST(KittiCalibration, TakesTheSizeFromTheUser) {
  EXPECT_HAS(complaint("calib.txt", kitti), "calib.txt: has no image size");
  const CalibrationFile file = read("calib.txt", kitti, {"", {{1241, 376}}});
  EXPECT_EQ(file.format, CalibrationFormat::kitti);
  EXPECT_EQ(file.calibrated.camera.fu_px, 718.856);
  EXPECT_EQ(file.calibrated.camera.u0_px, 607.1928);
  expect_lens(file.calibrated.camera, {0, 0, 0, 0, 0});
  EXPECT_HAS(notes_of(file), "has 2 cameras (P0, P2); P0 is taken");
  EXPECT_EQ(read("calib.txt", kitti, {"P2", {{1226, 370}}}).calibrated.camera.fv_px, 707.0912);
  EXPECT_HAS(complaint("calib.txt", kitti, {"P1", {{1241, 376}}}),
             "P1 is none of the cameras of the file (P0, P2)");
  EXPECT_HAS(
      complaint("calib.txt", with(kitti, "7.188560000000e+02 0.0e+00", "0.0e+00"), {"", {{1241, 376}}}),
      "calib.txt:1: P0 must be followed by 12 numbers, and has 11");
  EXPECT_HAS(
      complaint("calib.txt", with(kitti, "7.188560000000e+02 0.0e+00", "7.1x 0.0e+00"), {"", {{1241, 376}}}),
      "must be followed by finite numbers, and has `7.1x`");
}

TEST(KittiCalibration, OfNoLensIsRefused) {
  EXPECT_HAS(complaint("calib.txt", "P0: 700 0 600 0 0 -700 180 0 0 0 1 0\n", {"", {{1241, 376}}}),
             "calib.txt:1: P0 must have focal lengths of more than 0, and has 700 and -700");
  EXPECT_HAS(complaint("calib.txt", "P0: 700 2 600 0 0 700 180 0 0 0 1 0\n", {"", {{1241, 376}}}),
             "calib.txt: line 1: P0 without its last column has a skew of 2, which no camera model supports");
}

TEST(KittiCalibration, OfRawDataHasItsSize) {
  const std::string raw =
      "calib_time: 09-Jan-2012 13:57:47\nS_rect_00: 1.242000e+03 3.750000e+02\nP_rect_00: 721.5 0 609.5 0 0 721.5 "
      "172.8 0 0 0 1 0\n";
  const CameraSettings camera = read("calib_cam_to_cam.txt", raw).calibrated.camera;
  EXPECT_EQ(camera.width_px, 1242);
  EXPECT_EQ(camera.height_px, 375);
  EXPECT_EQ(camera.v0_px, 172.8);
}

TEST(PlainCalibration, IsRead) {
  const CalibrationFile file = read("calibration.txt", plain);
  EXPECT_EQ(file.format, CalibrationFormat::plain);
  EXPECT_EQ(file.calibrated.camera.fu_px, 420.506712);
  EXPECT_EQ(file.calibrated.camera.height_px, 480);
  expect_lens(file.calibrated.camera, {-0.296681, 0.080857, 0, 0, 0});
  EXPECT_HAS(complaint("c.txt", with(plain, "k3", "k4")), "c.txt:9: k4 is no such key; the nearest is `k1`");
  EXPECT_HAS(complaint("c.txt", with(plain, "fy 420.610940\n", "")), "c.txt: fy is missing");
  EXPECT_HAS(complaint("c.txt", with(plain, "fy 420.610940", "fx 420.610940")), "c.txt:2: fx is given twice");
  EXPECT_HAS(complaint("c.txt", with(plain, "fy 420.610940", "fy 420,61")),
             "c.txt:2: fy must be followed by finite numbers");
  EXPECT_HAS(complaint("c.txt", with(plain, "fy 420.610940", "fy")),
             "c.txt:2: fy must be followed by 1 number, and has 0");
}

TEST(PlainCalibration, OfThePublishedSequencesIsRead) {
  std::filesystem::path folder;
  try {
    folder = find_data("sequences", "", "test");
  } catch (const InputError& error) {
    GTEST_SKIP() << error.what();
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path file = entry.path() / "calibration.txt";
    if (!std::filesystem::exists(file)) continue;
    EXPECT_GT(read_calibration(file).fu_px, 100) << file;
  }
}

TEST(TomlCalibration, IsTheCameraOfAScenario) {
  const std::string text =
      "[camera]\nmodel = \"pinhole\"\nwidth_px = 640\nheight_px = 480\nfu_px = 517.3\nfv_px = 516.5\nu0_px = 318.6\nv0_px = 255.3\nk1 = "
      "0.25\n";
  const CalibrationFile file = read("mine.toml", text + "[run]\nseed = 3\n");
  EXPECT_EQ(file.format, CalibrationFormat::incognita);
  EXPECT_EQ(file.calibrated.camera.fu_px, 517.3);
  expect_lens(file.calibrated.camera, {0.25, 0, 0, 0, 0});
  EXPECT_HAS(notes_of(file), "only its section [camera] is used");
  EXPECT_EQ(complaint("m.toml", text, {"", {{640, 480}}}), "(none)");
  EXPECT_HAS(complaint("m.toml", text, {"", {{640, 481}}}),
             "m.toml: is for images of 640x480 px, and --image-size is 640x481");
  EXPECT_HAS(complaint("m.toml", "[run]\nseed = 3\n"), "m.toml: has no section [camera]");
  EXPECT_HAS(complaint("m.toml", with(text, "k1 =", "kd1 =")),
             "m.toml:9: there is no setting `camera.kd1` with this model; the nearest is `camera.k1`");
  EXPECT_HAS(complaint("m.toml", with(text, "fv_px = 516.5\n", "")), "m.toml: camera.fv_px is missing");
  EXPECT_HAS(complaint("m.toml", with(text, "516.5", "\"wide\"")), "m.toml:6: ");
}

TEST(Calibration, ThatContradictsItselfIsRefused) {
  EXPECT_HAS(complaint("c.txt", with(plain, "cx 355.2", "cx 955.2")),
             "c.txt: camera.u0_px must lie inside the image");
  EXPECT_HAS(complaint("c.txt", with(plain, "fx 420.5", "fx -420.5")),
             "c.txt: camera.fu_px would be -420.506712, and must be more than 0");
  EXPECT_HAS(complaint("c.txt", with(plain, "width 752", "width 75200")),
             "c.txt: camera.width_px would be 75200");
  EXPECT_HAS(complaint("c.txt", with(plain, "k1 -0.29", "k1 -29")),
             "must leave a ray to every pixel half-way to the edges");
}

TEST(Calibration, OfNoKnownFormatListsThem) {
  EXPECT_HAS(complaint("c.yaml", "a: 1\n"),
             "c.yaml: has none of the keys of a calibration; known are Kalibr's");
  EXPECT_HAS(complaint("c.yaml", ""), "c.yaml: is empty");
  EXPECT_HAS(complaint("c.yaml", "- a list\n"), "c.yaml:1: must be a list of `key: value`");
  EXPECT_HAS(complaint("c.yaml", "a: [1\n"), "c.yaml:");
  EXPECT_HAS(message_of([] { read_calibration("/nowhere/c.yaml"); }), "/nowhere/c.yaml: cannot be read");
}

CameraSettings pinhole(double k3) {
  CameraSettings camera;
  camera.model = PinholeLens{-0.28, 0.1, 1e-5, -2e-7, k3};
  camera.width_px = 640, camera.height_px = 480;
  camera.fu_px = 536, camera.fv_px = 1.0 / 3 + 536, camera.u0_px = 342.25, camera.v0_px = 235.125;
  return camera;
}

CameraSettings fisheye() {
  CameraSettings camera = pinhole(0);
  camera.model = FisheyeLens{0.02, -0.01, 3e-6, -0.001};
  return camera;
}

void expect_same(const CameraSettings& a, const CameraSettings& b) {
  EXPECT_EQ(calibration_text(a, CalibrationFormat::incognita),
            calibration_text(b, CalibrationFormat::incognita));
}

TEST(Calibration, OfOneCameraHasNoOtherToChoose) {
  const std::string scenario = calibration_text(pinhole(0), CalibrationFormat::incognita);
  const std::string euroc =
      "camera_model: pinhole\nintrinsics: [458.6, 457.3, 367.2, 248.4]\nresolution: [752, 480]\n";
  for (const auto& [name, text, format] : {std::tuple{"ost.yaml", camera_info, "ROS camera_info"},
                                           {"o.yml", opencv_yaml, "OpenCV FileStorage"},
                                           {"o.xml", opencv_xml, "OpenCV FileStorage"},
                                           {"sensor.yaml", euroc, "EuRoC sensor.yaml"},
                                           {"c.txt", plain, "a key and its number per line"},
                                           {"mine.toml", scenario, "[camera] of a scenario"}}) {
    EXPECT_EQ(complaint(name, text), "(none)") << name;
    EXPECT_HAS(complaint(name, text, {"cam1", {}}), std::string(name) + ": is read as " + format +
                                                        ", which has one camera: leave out --camera cam1");
  }
}

/// Every number is written so that it reads back exactly.
TEST(Calibration, ReadsBackAsWritten) {
  using enum CalibrationFormat;
  for (const CalibrationFormat format : {kalibr, ros, opencv, incognita}) {
    const std::string name = format == incognita ? "c.toml" : "c.yaml";
    for (const CameraSettings& camera : {pinhole(format == kalibr ? 0 : 0.24), fisheye()}) {
      const CalibrationFile file =
          read(name, calibration_text(camera, format, "a comment: [\n\nof two lines"));
      EXPECT_EQ(file.format, format);
      EXPECT_EQ(file.calibrated.unfit, "");
      expect_same(file.calibrated.camera, camera);
    }
  }
  EXPECT_NO_THROW(make_camera(fisheye()));
}

TEST(Calibration, IsReadByOpencvItself) {
  const std::string text = calibration_text(pinhole(0.24), CalibrationFormat::opencv, "sigma 3 px");
  const cv::FileStorage storage(text, cv::FileStorage::READ | cv::FileStorage::MEMORY);
  cv::Mat K, distortion;
  storage["camera_matrix"] >> K;
  storage["distortion_coefficients"] >> distortion;
  ASSERT_EQ(K.type(), CV_64F);
  EXPECT_EQ(K.at<double>(0, 0), 536);
  EXPECT_EQ(K.at<double>(1, 2), 235.125);
  ASSERT_EQ(distortion.total(), 5u);
  EXPECT_EQ(distortion.at<double>(3), -2e-7);
  EXPECT_EQ(static_cast<int>(storage["image_width"]), 640);
}

TEST(Calibration, ThatAFormatCannotHoldIsRefused) {
  const auto refusal = [](const CameraSettings& camera, CalibrationFormat format) {
    return message_of([&] { calibration_text(camera, format); });
  };
  EXPECT_HAS(refusal(pinhole(0.24), CalibrationFormat::kalibr),
             "Kalibr camchain has no third radial term, and k3 = 0.24");
  CameraSettings wide = pinhole(0);
  wide.model = WideAngleLens{1e-6};
  EXPECT_HAS(refusal(wide, CalibrationFormat::ros), "ROS camera_info has no model `wide-angle`");
  EXPECT_EQ(refusal(wide, CalibrationFormat::incognita), "(none)");
  EXPECT_HAS(refusal(pinhole(0), CalibrationFormat::kitti), "is read only");
}

TEST(Calibration, FormatFollowsFromTheName) {
  EXPECT_EQ(guess_written_format("a/camchain.yaml"), CalibrationFormat::kalibr);
  EXPECT_EQ(guess_written_format("my-camera_info.yaml"), CalibrationFormat::ros);
  EXPECT_EQ(guess_written_format("camera.yml"), CalibrationFormat::opencv);
  EXPECT_EQ(guess_written_format("camera.toml"), CalibrationFormat::incognita);
  EXPECT_EQ(guess_written_format("camera.xml"), std::nullopt);
  EXPECT_EQ(written_format("ros"), CalibrationFormat::ros);
  EXPECT_EQ(written_format("kitti"), std::nullopt);
}

/// Truncated at every byte, and damaged: an InputError with a text, or a camera.
TEST(Calibration, SurvivesDamage) {
  const Scratch scratch;
  for (const auto& [name, text] : {std::pair{"c.yaml", camchain},
                                   {"r.yaml", camera_info},
                                   {"o.yaml", opencv_yaml},
                                   {"x.xml", opencv_xml},
                                   {"k.txt", kitti},
                                   {"p.txt", plain},
                                   {"m.toml", calibration_text(fisheye(), CalibrationFormat::incognita)}}) {
    const auto attempt = [&, file = std::string(name)](const std::string& damaged) {
      read_calibration(scratch.write(file, damaged), {"", {{640, 480}}});
    };
    for (std::size_t end = 0; end < text.size(); ++end) {
      try {
        attempt(text.substr(0, end));
      } catch (const InputError& error) {
        EXPECT_HAS(error.what(), name);
      }
    }
    testing::still_read(text, 400, attempt);
  }
}

}  // namespace
}  // namespace incognita
