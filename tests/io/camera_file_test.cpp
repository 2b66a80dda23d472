// camera.file: a scenario takes its camera from a calibration file.
#include <gtest/gtest.h>

#include "incognita/io/scenario/load_scenario.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::Scratch;

const std::string kalibr =
    "cam0:\n  camera_model: pinhole\n  intrinsics: [420.5, 421.25, 322, 241]\n  distortion_model: equidistant\n"
    "  distortion_coeffs: [0.01, -0.02, 0.003, -0.001]\n  resolution: [640, 480]\n";
const std::string live = "[start]\nfrom = \"free\"\n[world]\ntype = \"live\"\n";
const std::string from_file = live + "[camera]\nfile = \"camchain.yaml\"\n";

struct Folder {
  Scratch scratch;
  std::string scenario;

  explicit Folder(const std::string& toml, const std::string& calibration = kalibr) {
    scenario = scratch.write("mine.toml", toml).string();
    if (!calibration.empty()) scratch.write("camchain.yaml", calibration);
  }
  LoadedScenario load(const std::vector<std::string>& sets = {}) const {
    return load_scenario(scenario, sets);
  }
  std::string complaint(const std::vector<std::string>& sets = {}) const {
    return message_of([&] { load(sets); });
  }
};

void expect_camera_of_file(const Scenario& scenario) {
  const CameraSettings& camera = scenario.camera;
  EXPECT_EQ(camera.width_px, 640);
  EXPECT_EQ(camera.fu_px, 420.5);
  EXPECT_EQ(camera.fv_px, 421.25);
  EXPECT_EQ(camera.u0_px, 322);
  ASSERT_TRUE(std::holds_alternative<FisheyeLens>(camera.model));
  EXPECT_EQ(std::get<FisheyeLens>(camera.model).k2, -0.02);
}

TEST(CameraFile, GivesTheWholeCamera) {
  const Folder folder(from_file);
  const LoadedScenario loaded = folder.load();
  expect_camera_of_file(loaded.scenario);
  EXPECT_HAS(loaded.source_of("camera.fu_px"), "as ");
  EXPECT_HAS(loaded.source_of("camera.fu_px"), "camchain.yaml");
  EXPECT_HAS(loaded.source_of("camera.file"), "mine.toml:6");
}

TEST(CameraFile, IsNotNeededByTheEffectiveSettings) {
  const Folder folder(from_file);
  const std::string effective = effective_toml(folder.load());
  const Scratch elsewhere;
  expect_camera_of_file(load_scenario(elsewhere.write("again.toml", effective).string()).scenario);
}

TEST(CameraFile, OfEveryWorldWithACamera) {
  const std::string file = "[camera]\nfile = \"camchain.yaml\"\n", start = "[start]\nfrom = \"free\"\n";
  for (const std::string& toml : {"[world]\ntype = \"room\"\n" + start, "[world]\ntype = \"robot\"\n" + start,
                                  std::string("[world]\ntype = \"points\"\n")})
    expect_camera_of_file(Folder(toml + file).load().scenario);
}

TEST(CameraFile, BesideOtherValuesInTheSameScenarioIsRefused) {
  const Folder folder(from_file + "fu_px = 500\nmodel = \"pinhole\"\n");
  const std::string complaint = folder.complaint();
  EXPECT_HAS(complaint, "mine.toml:7: camera.fu_px: the camera is that of camera.file (");
  EXPECT_HAS(complaint, "mine.toml:8: camera.model: the camera is that of camera.file (");
}

TEST(CameraFile, OfTheCommandLineReplacesTheCameraOfTheScenario) {
  const Folder folder(live + "[camera]\nmodel = \"pinhole\"\nwidth_px = 320\nk1 = 0.1\n");
  const LoadedScenario loaded = folder.load({"camera.file=camchain.yaml"});
  expect_camera_of_file(loaded.scenario);
  std::string notes;
  for (const std::string& line : loaded.overrides) notes += line + "\n";
  for (const char* key : {"camera.model", "camera.width_px", "camera.k1"})
    EXPECT_HAS(notes, std::string(key) + " (");
  EXPECT_HAS(notes, "is left out: camera.file (--set) replaces it");
}

TEST(CameraFile, YieldsToTheCommandLine) {
  const LoadedScenario loaded = Folder(from_file).load({"camera.fu_px=500"});
  EXPECT_EQ(loaded.scenario.camera.fu_px, 500);
  EXPECT_EQ(loaded.scenario.camera.fv_px, 421.25);
  const LoadedScenario without = Folder(from_file, "").load({"camera.file=\"\""});
  EXPECT_EQ(without.scenario.camera.fu_px, CameraSettings{}.fu_px);
}

TEST(CameraFile, ThatIsMissingOrDamagedIsRefusedWithItsPlace) {
  EXPECT_HAS(Folder(from_file, "").complaint(),
             "mine.toml:6: camera.file = \"camchain.yaml\": there is no such file");
  const std::string damaged = Folder(from_file, "cam0:\n  intrinsics: [1, 2]\n").complaint();
  EXPECT_HAS(damaged, "mine.toml:6: camera.file = \"camchain.yaml\": ");
  EXPECT_HAS(damaged, "camchain.yaml");
  EXPECT_HAS(Folder(live + "[camera]\nfile = 3\n").complaint(), "camera.file = 3: must be a text");
}

TEST(CameraFile, SaysWhatOfItIsNotUsed) {
  std::string second = kalibr;
  second.replace(0, 4, "cam1");
  std::string notes;
  for (const std::string& line : Folder(from_file, kalibr + second).load().overrides) notes += line + "\n";
  EXPECT_HAS(notes, "camchain.yaml: has 2 cameras");
}

TEST(CameraFile, WithoutASizeIsRefusedWithARemedyThatARunHas) {
  const std::string complaint =
      Folder(live + "[camera]\nfile = \"camchain.yaml\"\n", "fx: 420\nfy: 420\ncx: 320\ncy: 240\n")
          .complaint();
  EXPECT_HAS(complaint, "has no image size");
  EXPECT_HAS(complaint, "convert it with `incognita calibrate --convert FILE");
}

TEST(CameraFile, OfTheCommandLineMayLieInTheWorkingFolder) {
  const Folder folder(live);
  const Scratch elsewhere;
  elsewhere.write("cam.yaml", kalibr);
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(elsewhere.folder());
  const LoadedScenario loaded = folder.load({"camera.file=cam.yaml"});
  std::filesystem::current_path(here);
  expect_camera_of_file(loaded.scenario);
}

TEST(CameraFile, ThatIsEmptyIsAsIfNoneWereGiven) {
  for (const char* empty : {"\"\"", "''", ""}) {
    const LoadedScenario loaded = Folder(from_file).load({std::string("camera.file=") + empty});
    EXPECT_EQ(loaded.scenario.camera.fu_px, CameraSettings{}.fu_px) << empty;
    EXPECT_EQ(loaded.source_of("camera.file"), "default") << empty;
  }
}

TEST(CameraFile, DoesNotHideASettingOfAnotherLens) {
  EXPECT_HAS(Folder(from_file + "kd1_per_px2 = 1e-6\n").complaint(),
             "camera.kd1_per_px2: the camera is that of camera.file");
  EXPECT_HAS(Folder(from_file).complaint({"camera.kd1_per_px2=1e-6"}), "camera.kd1_per_px2");
}

}  // namespace
}  // namespace incognita
