// The calibration in a EuRoC recording, and the camera of a scenario that uses it.
#include "incognita/io/recordings/euroc_camera.hpp"

#include <gtest/gtest.h>

#include "incognita/io/recordings/camera_of_recording.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

/// As published with the benchmark.
const std::string published =
    "# General sensor definitions.\nsensor_type: camera\ncomment: VI-Sensor cam0 (MT9M034)\n\n"
    "# Sensor extrinsics wrt. the body-frame.\nT_BS:\n  cols: 4\n  rows: 4\n  data: [0.0148655429818, "
    "-0.999880929698, 0.00414029679422, -0.0216401454975,\n         0.999557249008, 0.0149672133247, "
    "0.025715529948, -0.064676986768,\n        -0.0257744366974, 0.00375618835797, 0.999660727178, "
    "0.00981073058949,\n         0.0, 0.0, 0.0, 1.0]\n\n# Camera specific definitions.\nrate_hz: 20\n"
    "resolution: [752, 480]\ncamera_model: pinhole\nintrinsics: [458.654, 457.296, 367.215, 248.375] #fu, "
    "fv, "
    "cu, cv\ndistortion_model: radial-tangential\ndistortion_coefficients: [-0.28340811, 0.07395907, "
    "0.00019359, 1.76187114e-05]\n";

/// With one substring replaced.
std::string with(const std::string& piece, const std::string& other) {
  std::string text = published;
  return text.replace(text.find(piece), piece.size(), other);
}

EurocSensor read(const std::string& text) {
  const Scratch scratch;
  return read_euroc_sensor(scratch.write("sensor.yaml", text));
}

std::string complaint(const std::string& text) {
  return message_of([&] { read(text); });
}

TEST(EurocCamera, IsReadAsPublished) {
  const EurocSensor sensor = read(published);
  ASSERT_TRUE(sensor.camera && sensor.body_from_camera);
  EXPECT_EQ(sensor.camera->unfit, "");
  const CameraSettings& c = sensor.camera->camera;
  const PinholeLens& lens = std::get<PinholeLens>(c.model);
  EXPECT_EQ(c.width_px, 752);
  EXPECT_EQ(c.height_px, 480);
  EXPECT_EQ(c.fu_px, 458.654);
  EXPECT_EQ(c.fv_px, 457.296);
  EXPECT_EQ(c.u0_px, 367.215);
  EXPECT_EQ(c.v0_px, 248.375);
  EXPECT_EQ(lens.k1, -0.28340811);
  EXPECT_EQ(lens.k2, 0.07395907);
  EXPECT_EQ(lens.p1, 0.00019359);
  EXPECT_EQ(lens.p2, 1.76187114e-05);
  EXPECT_EQ(lens.k3, 0);
  EXPECT_EQ((*sensor.body_from_camera)(1, 3), -0.064676986768);
}

TEST(EurocCamera, IsReadInOtherYamlStyles) {
  const EurocSensor sensor = read(
      "%YAML:1.0\nresolution:\n  - 752\n  - 480\ncamera_model: \"pinhole\"\nintrinsics:\n  - 4.5e2\n  - "
      "450\n  - 300\n"
      "  - 200.5\ndistortion_model: radtan\ndistortion_coefficients: [0.1, 0.2, 0.3, 0.4, 0.5]\n");
  ASSERT_TRUE(sensor.camera);
  EXPECT_EQ(sensor.camera->camera.fu_px, 450);
  EXPECT_EQ(sensor.camera->camera.v0_px, 200.5);
  EXPECT_EQ(std::get<PinholeLens>(sensor.camera->camera.model).k3, 0.5);
  EXPECT_FALSE(sensor.body_from_camera);
  EXPECT_FALSE(read("sensor_type: camera\n").camera);
}

TEST(EurocCamera, OfKalibrMayBeAFisheye) {
  const EurocSensor sensor = read(with("radial-tangential", "equidistant"));
  ASSERT_TRUE(sensor.camera);
  EXPECT_EQ(sensor.camera->unfit, "");
  const auto& lens = std::get<FisheyeLens>(sensor.camera->camera.model);
  EXPECT_EQ(lens.k1, -0.28340811);
  EXPECT_EQ(lens.k3, 0.00019359);
  EXPECT_EQ(lens.k4, 1.76187114e-05);
}

TEST(EurocCamera, NamesAnUnsupportedModel) {
  EXPECT_EQ(read(with("radial-tangential", "fov")).camera->unfit, "distortion_model is `fov`");
  EXPECT_EQ(read(with("camera_model: pinhole", "camera_model: omni")).camera->unfit,
            "camera_model is `omni`");
}

TEST(EurocCamera, NamesAMissingKey) {
  EXPECT_EQ(read(with("distortion_model: radial-tangential\n", "")).camera->unfit, "");
  EXPECT_EQ(read(with("camera_model: pinhole\n", "")).camera->unfit, "camera_model is ``");
  EXPECT_HAS(complaint(with("resolution: [752, 480]\n", "")),
             "sensor.yaml: resolution must be a list of numbers");
  EXPECT_HAS(complaint(with("  data: [", "  dates: [")), "T_BS must be a list of numbers");
}

TEST(EurocCamera, ErrorsNameTheLine) {
  EXPECT_HAS(complaint(with("[458.654, 457.296,", "[458.654, 457,296,")),
             "sensor.yaml:18: intrinsics must be fu, fv");
  EXPECT_HAS(complaint(with("457.296", "wide")),
             "sensor.yaml:18: intrinsics must hold numbers only, and has `wide`");
  EXPECT_HAS(complaint(with("[752, 480]", "752x480")),
             "sensor.yaml:16: resolution must be a list of numbers");
  EXPECT_HAS(complaint(with("[752, 480]", "[0, 480]")), "resolution must be width and height in px");
  EXPECT_HAS(complaint(with("0.0, 0.0, 0.0, 1.0]", "0.0, 0.0]")), "T_BS must have 16 numbers, and has 14");
  EXPECT_HAS(complaint(with("0.999557249008", "0.1")), "T_BS must be a rigid transformation");
  EXPECT_HAS(complaint(with("rate_hz: 20", "rate_hz: [20")), "sensor.yaml:");
  EXPECT_HAS(complaint("- a list\n"), "must be a list of `key: value`");
  EXPECT_HAS(complaint(""), "must be a list of `key: value`");
}

/// A EuRoC folder with one image, and a scenario that uses it and adds settings.
class CameraOfRecording : public ::testing::Test {
 protected:
  CameraOfRecording() {
    scratch_.write("mav0/cam0/data.csv", "#timestamp [ns],filename\n1403636579763555584,a.png\n");
    scratch_.write("mav0/cam0/sensor.yaml", published);
  }
  LoadedScenario load(const std::string& more) const {
    const std::string text =
        "[start]\nfrom = \"free\"\n[world]\ntype = \"recording\"\n[recording]\nfolder = \"" +
        scratch_.folder().string() + "\"\n" + more;
    return load_scenario(scratch_.write("mine.toml", text).string());
  }
  std::string differences(const std::string& more) const {
    const LoadedScenario loaded = load(more);
    const Recording recording = read_recording(loaded);
    return message_of([&] { compare_camera(loaded, recording); });
  }
  Scratch scratch_;
};

const std::string typed =
    "[camera]\nmodel = \"pinhole\"\nwidth_px = 752\nheight_px = 480\nfu_px = 458.65\nfv_px = 457.3\nu0_px = "
    "367.2\nv0_px = 248.4\nk1 = -0.2834\nk2 = 0.074\np1 = 0.0002\n";

std::string replaced(std::string text, const std::string& piece, const std::string& other) {
  return text.replace(text.find(piece), piece.size(), other);
}

TEST_F(CameraOfRecording, IsUsedWhereTheScenarioHasNone) {
  const LoadedScenario loaded = load("");
  EXPECT_TRUE(std::holds_alternative<PinholeLens>(loaded.scenario.camera.model));
  EXPECT_EQ(loaded.scenario.camera.fu_px, 458.654);
  EXPECT_HAS(loaded.sources.at("camera.fu_px"), "mav0/cam0/sensor.yaml");
  EXPECT_HAS(compare_camera(loaded, read_recording(loaded)), "the camera is taken from");
  const std::string again = scratch_.write("effective.toml", effective_toml(loaded)).string();
  const LoadedScenario repeated = load_scenario(again);
  EXPECT_EQ(std::get<PinholeLens>(repeated.scenario.camera.model).k1, -0.28340811);
  EXPECT_HAS(compare_camera(repeated, read_recording(repeated)), "the camera agrees with");
}

TEST_F(CameraOfRecording, AgreesWithRoundedValues) { EXPECT_EQ(differences(typed), "(none)"); }

TEST_F(CameraOfRecording, ADifferentCameraIsRefusedWithBothValues) {
  const std::string text = differences(replaced(replaced(typed, "458.65", "517.3"), "k1 = -0.2834\n", ""));
  EXPECT_HAS(text, "mine.toml:11: camera.fu_px = 517.3: ");
  EXPECT_HAS(text, "mav0/cam0/sensor.yaml has 458.654");
  EXPECT_HAS(text, "default: camera.k1 = 0.0: ");
  EXPECT_HAS(text, "has -0.28340811");
  EXPECT_HAS(text, "recording.check_calibration = false");
  EXPECT_EQ(text.find("camera.fv_px"), std::string::npos) << text;
  const std::string without_lens = replaced(typed, "k1 = -0.2834\nk2 = 0.074\np1 = 0.0002\n", "");
  EXPECT_HAS(differences(replaced(without_lens, "pinhole", "wide-angle")), "camera.model = \"wide-angle\": ");
}

TEST_F(CameraOfRecording, IsNotComparedWhereTheScenarioDisablesIt) {
  EXPECT_EQ(differences("check_calibration = false\n" + replaced(typed, "458.65", "517.3")), "(none)");
}

TEST_F(CameraOfRecording, AnUnsupportedModelIsReported) {
  scratch_.write("mav0/cam0/sensor.yaml", with("radial-tangential", "fov"));
  const std::string text = message_of([&] { load(""); });
  EXPECT_HAS(text, "sensor.yaml: distortion_model is `fov`, which no camera model supports");
  EXPECT_HAS(text, "undistort the images");
  const Recording recording = read_recording(load(typed));
  std::string notes;
  for (const std::string& note : recording.notes) notes += note + "\n";
  EXPECT_HAS(notes, "distortion_model is `fov`, which no camera model supports: the camera is not compared");
}

}  // namespace
}  // namespace incognita
