#include "incognita/record/mcap/snapshot_log.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "file_size_limit.hpp"
#include "incognita/messages/errors.hpp"
#include "incognita/record/files/image_text.hpp"
#include "incognita/record/mcap/snapshot_message.hpp"
#include "incognita/record/snapshot/series.hpp"
#include "mcap_reader.hpp"
#include "schema.hpp"
#include "synthetic_run.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::contents;
using testing::Json;
using testing::McapContents;
using testing::McapMessage;
using testing::Scratch;
using testing::SyntheticRun;

RunInfo info() {
  RunInfo info;
  info.version = "0.1.0";
  return info;
}

std::shared_ptr<const Image> image_of(int frame) {
  auto image = std::make_shared<Image>(64, 48, std::uint8_t{90});
  for (int v = 10; v < 30; ++v)
    for (int u = 10; u < 40; ++u) (*image)(u, v) = static_cast<std::uint8_t>(100 + frame);
  return image;
}

Snapshot with_image(const SyntheticRun& run, int frame, double pace_ms = 5) {
  Snapshot snapshot = testing::synthetic_snapshot(run, frame, pace_ms);
  snapshot.image = image_of(frame);
  return snapshot;
}

McapContents log(const std::filesystem::path& path, const SyntheticRun& run = {},
                 const RunInfo& about = info()) {
  SnapshotLog log(path, about);
  Snapshot last;
  for (int i = 0; i < run.frames; ++i) log.publish(last = with_image(run, i));
  log.close(last.landmarks);
  return testing::read_mcap(contents(path));
}

Json parsed(const McapMessage& message) { return Json::parse(message.data); }

std::string unbase64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8));
  }
  return bytes;
}

TEST(SnapshotLog, HasTopicsAndSchemasOfViewers) {
  const Scratch scratch;
  const McapContents read = log(scratch / "run.mcap");
  const std::map<std::string, std::string> expected{{"/tf", "foxglove.FrameTransform"},
                                                    {"/estimate/pose", "foxglove.PoseInFrame"},
                                                    {"/truth/pose", "foxglove.PoseInFrame"},
                                                    {"/map", "foxglove.SceneUpdate"},
                                                    {"/camera/image", "foxglove.CompressedImage"},
                                                    {"/camera/annotations", "foxglove.ImageAnnotations"},
                                                    {"/snapshot", "incognita.Snapshot"},
                                                    {"/run", "incognita.Run"}};
  EXPECT_EQ(read.schema_of_topic, expected);
  EXPECT_EQ(read.library, "incognita 0.1.0");
  EXPECT_EQ(read.count("/run"), 1u);
  EXPECT_EQ(read.messages.front().topic, "/run");
  EXPECT_EQ(read.count("/snapshot"), 120u);
  EXPECT_EQ(read.count("/truth/pose"), 120u);
  EXPECT_EQ(read.count("/estimate/pose"), 117u);  // none while starting
  EXPECT_EQ(read.count("/tf"), 237u);
  EXPECT_EQ(read.count("/camera/image"), 60u);  // every other
  EXPECT_EQ(read.count("/camera/annotations"), 60u);
  EXPECT_EQ(read.count("/map"), 5u);  // at 0, 1, 2, 3 s and at the end
}

TEST(SnapshotLog, EveryMessageConformsToItsSchema) {
  const Scratch scratch;
  SyntheticRun run;
  run.lost_from = 40;
  run.lost_to = 50;
  const McapContents read = log(scratch / "run.mcap", run);
  std::map<std::string, Json> schemas;
  for (const auto& [name, text] : read.schemas) {
    schemas[name] = Json::parse(text);
    EXPECT_EQ(schemas[name]["title"], name);
  }
  for (const McapMessage& message : read.messages)
    ASSERT_EQ(testing::problems(parsed(message), schemas[read.schema_of_topic.at(message.topic)]), "")
        << message.topic << ": " << message.data;
}

/// Viewers that convert JSON schemas into types accept one type per field, and no field that is only a
/// reference.
void expect_simple(const Json& schema, const std::string& at) {
  ASSERT_TRUE(schema.contains("type") && schema["type"].is_string()) << at;
  if (schema["type"] == "array") {
    ASSERT_NE(schema["items"].value("type", ""), "array") << at;
    expect_simple(schema["items"], at + "[]");
  }
  if (schema["type"] != "object") return;
  ASSERT_TRUE(schema["properties"].is_object()) << at;
  for (const auto& [key, part] : schema["properties"].items()) expect_simple(part, at + "." + key);
}

TEST(SnapshotLog, SchemasAreSimpleEnoughForViewers) {
  const Scratch scratch;
  const McapContents read = log(scratch / "run.mcap");
  EXPECT_EQ(read.schemas.size(), 7u);
  for (const auto& [name, text] : read.schemas) expect_simple(Json::parse(text), name);
}

TEST(SnapshotLog, HasTheSnapshotsValues) {
  const Scratch scratch;
  const McapContents read = log(scratch / "run.mcap");
  const Snapshot snapshot = with_image({}, 50);
  const Json json = parsed(*read.of("/snapshot")[50]);
  EXPECT_EQ(json["frame"], 50);
  EXPECT_EQ(json["t"], snapshot.tick.t);  // exactly, as all numbers except those of matches
  EXPECT_EQ(json["state"], "tracking");
  ASSERT_EQ(json["bodies"].size(), 1u);
  const Json& body = json["bodies"][0];
  EXPECT_EQ(body["position"]["x"], snapshot.bodies[0].estimate.position.x());
  EXPECT_EQ(body["orientation"]["w"], snapshot.bodies[0].estimate.orientation[0]);
  EXPECT_EQ(body["orientation"]["z"], snapshot.bodies[0].estimate.orientation[3]);
  ASSERT_EQ(body["pose_covariance"].size(), 36u);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      EXPECT_EQ(body["pose_covariance"][static_cast<std::size_t>(6 * i + j)],
                snapshot.bodies[0].covariance(i, j));
  EXPECT_EQ(json["nis"], snapshot.nis);
  EXPECT_EQ(json["nis_dof"], 10);
  EXPECT_EQ(json["entropy"]["total"], snapshot.entropy.total);
  EXPECT_EQ(body["decision"]["candidates"][2]["action"], "back");
  EXPECT_EQ(body["decision"]["candidates"][2]["score"], snapshot.bodies.at(0).decision.scores[2]);
  EXPECT_EQ(body["decision"]["chosen"], snapshot.bodies.at(0).decision.chosen);
  EXPECT_EQ(body["input"][1], 0.2);
  ASSERT_EQ(json["matches"].size(), 8u);
  EXPECT_NEAR(json["matches"][3]["predicted"][1], snapshot.matches[3].predicted.y(), 1e-4);
  EXPECT_NEAR(json["matches"][3]["measured"][0], snapshot.matches[3].measured->x(), 1e-4);
  EXPECT_EQ(json["matches"][3]["innovation_cov"], Json::parse("[12.0,3.0,6.0]"));
  EXPECT_EQ(json["matches"][5]["outcome"], "not-found");
  EXPECT_FALSE(json["matches"][5].contains("measured"));
  EXPECT_EQ(json["matches"][7]["kind"], "ray");
  EXPECT_EQ(body["truth"]["position"]["y"], snapshot.bodies[0].truth->position.y());
  EXPECT_EQ(body["truth"]["orientation"]["w"], snapshot.bodies[0].truth->orientation[0]);
  EXPECT_EQ(json["landmark_ids"].size(), snapshot.landmarks.size());
  EXPECT_FALSE(json.contains("landmarks"));
  EXPECT_FALSE(json.contains("exploration"));
  const Json with_map = parsed(*read.of("/snapshot")[60]);
  ASSERT_EQ(with_map["landmarks"].size(), 8u);
  // Cells 0 to 60 of 4 x 3 x 7
  EXPECT_EQ(with_map["exploration"],
            Json::parse(R"({"min":[-2.0,-1.5,0.0],"max":[2.0,1.5,3.5],"cell_m":1.0,"cells":[4,3,7],
                            "seen":"/////////x8AAAA="})"));
  EXPECT_EQ(with_map["landmarks"][0]["kind"], "anchor");
  EXPECT_EQ(with_map["landmarks"][5]["covariance"][4],
            testing::synthetic_snapshot({}, 60).landmarks[5].covariance(1, 1));
}

/// Schemas of viewers have no lists of lists, so the file has one list; a page gets one list per hypothesis.
TEST(SnapshotLog, HasTheDepthHypothesesOfRays) {
  const Scratch scratch;
  const McapContents read = log(scratch / "run.mcap");
  const Json matches = parsed(*read.of("/snapshot")[50])["matches"];
  EXPECT_FALSE(matches[6].contains("particles"));
  EXPECT_EQ(matches[7]["particles"], Json::parse("[285.1,118.0,0.6,289.2,119.0,0.399]"));
  const Json grouped = Json::parse(snapshot_message(with_image({}, 50), false));
  EXPECT_EQ(grouped["matches"][7]["particles"], Json::parse("[[285.1,118.0,0.6],[289.2,119.0,0.399]]"));
}

TEST(SnapshotLog, TruthWithoutOrientationHasNone) {
  Snapshot snapshot = with_image({}, 50);
  snapshot.bodies[0].truth->oriented = false;
  const Json body = Json::parse(snapshot_message(snapshot, false))["bodies"][0];
  EXPECT_TRUE(body["truth"].contains("position"));
  EXPECT_FALSE(body["truth"].contains("orientation"));
}

RunInfo described() {
  RunInfo about = info();
  about.name = "house";
  about.seed = 7;
  about.rate_hz = 30;
  about.camera = {320, 240, 195, 196, 159.5, 119.5};
  about.room = {{{-3, -3, 0}, {3, 3, 2.5}}, {{{1, 1, 0}, {2, 2, 0.75}}}};
  about.terrain = {{-3, -3}, 2, 4, 2, {0, 0.12345, 0, 0, 0, 0, -0.25, 0}};
  return about;
}

TEST(SnapshotLog, DescribesTheRunOnce) {
  const Scratch scratch;
  const McapContents read = log(scratch / "run.mcap", {}, described());
  const Json run = parsed(*read.of("/run")[0]);
  EXPECT_EQ(testing::problems(run, Json::parse(read.schemas.at("incognita.Run"))), "");
  EXPECT_EQ(run["name"], "house");
  EXPECT_EQ(run["seed"], 7);
  EXPECT_EQ(run["rate_hz"], 30);
  EXPECT_EQ(run["camera"],
            Json::parse(R"({"width":320,"height":240,"fx":195,"fy":196,"cx":159.5,"cy":119.5})"));
  EXPECT_EQ(run["room"]["max"], Json::parse("[3,3,2.5]"));
  EXPECT_EQ(run["room"]["boxes"], Json::parse(R"([{"min":[1,1,0],"max":[2,2,0.75]}])"));
  EXPECT_EQ(run["terrain"], Json::parse(R"({"origin":[-3,-3],"step_m":2,"columns":4,"rows":2,
                                            "heights":[0,0.123,0,0,0,0,-0.25,0]})"));
  EXPECT_EQ(run["same_frame_as_truth"], true);
  const Json of_little = parsed(*log(scratch / "little.mcap").of("/run")[0]);
  for (const char* unknown : {"rate_hz", "camera", "room", "terrain"})
    EXPECT_FALSE(of_little.contains(unknown));
}

/// The time line of a recording that counts from 1970 must not begin there.
TEST(SnapshotLog, DescriptionOfTheRunIsAtTheFirstFrame) {
  const Scratch scratch;
  SnapshotLog log(scratch / "run.mcap", info());
  Snapshot snapshot = with_image({}, 0);
  snapshot.tick.t = 1.3e9;
  log.publish(snapshot);
  log.close({});
  const McapContents read = testing::read_mcap(contents(scratch / "run.mcap"));
  EXPECT_EQ(read.of("/run")[0]->log_time_ns, 1'300'000'000'000'000'000u);
}

TEST(SnapshotLog, HasPosesAndFramesOfTheTick) {
  const Scratch scratch;
  const McapContents read = log(scratch / "run.mcap");
  const McapMessage& message = *read.of("/estimate/pose")[47];
  const Snapshot snapshot = with_image({}, 50);
  EXPECT_EQ(message.log_time_ns, 1'666'666'667u);
  const Json pose = parsed(message);
  EXPECT_EQ(pose["timestamp"], Json::parse(R"({"sec":1,"nsec":666666667})"));
  EXPECT_EQ(pose["frame_id"], "world");
  EXPECT_EQ(pose["pose"]["position"]["z"], snapshot.bodies[0].estimate.position.z());
  EXPECT_EQ(pose["pose"]["orientation"]["x"], snapshot.bodies[0].estimate.orientation[1]);
  std::map<std::string, int> frames;
  for (const McapMessage* transform : read.of("/tf")) {
    const Json json = parsed(*transform);
    EXPECT_EQ(json["parent_frame_id"], "world");
    ++frames[json["child_frame_id"]];
  }
  EXPECT_EQ(frames, (std::map<std::string, int>{{"camera", 117}, {"true_camera", 120}}));
}

TEST(SnapshotLog, OmitsUnknownValues) {
  const Scratch scratch;
  SyntheticRun run;
  run.with_truth = false;
  run.lost_from = 100;
  run.lost_to = 110;
  const McapContents read = log(scratch / "run.mcap", run);
  EXPECT_EQ(read.count("/estimate/pose"), 107u);
  EXPECT_EQ(read.count("/tf"), 107u);
  EXPECT_FALSE(read.schema_of_topic.contains("/truth/pose"));
  const Json lost = parsed(*read.of("/snapshot")[105]);
  EXPECT_EQ(lost["state"], "lost");
  EXPECT_FALSE(lost.contains("position"));
  EXPECT_FALSE(lost.contains("pose_covariance"));
  EXPECT_EQ(parsed(*read.of("/snapshot")[0])["entropy"], Json::object());
}

TEST(SnapshotLog, TruthInAnotherFrameHasItsOwnRootFrame) {
  const Scratch scratch;
  RunInfo free = info();
  free.ate_alignment = "sim3";
  const McapContents read = log(scratch / "run.mcap", {}, free);
  EXPECT_EQ(parsed(*read.of("/truth/pose")[0])["frame_id"], "true_world");
  EXPECT_EQ(parsed(*read.of("/estimate/pose")[0])["frame_id"], "world");
}

TEST(SnapshotLog, HasImagesThatDecode) {
  const Scratch scratch;
  const McapContents read = log(scratch / "run.mcap");
  const Json json = parsed(*read.of("/camera/image")[20]);
  EXPECT_EQ(json["format"], "jpeg");
  const std::string bytes = unbase64(json["data"]);
  const cv::Mat picture = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_GRAYSCALE);
  ASSERT_EQ(picture.cols, 64);
  ASSERT_EQ(picture.rows, 48);
  EXPECT_NEAR(picture.at<std::uint8_t>(20, 25), 140, 6);  // frame 40
  EXPECT_NEAR(picture.at<std::uint8_t>(40, 50), 90, 6);
}

TEST(SnapshotLog, DrawsEllipsesAndPatchesAtTheirPixels) {
  const Scratch scratch;
  const McapContents read = log(scratch / "run.mcap");
  const Json points = parsed(*read.of("/camera/annotations")[25])["points"];
  const Snapshot snapshot = with_image({}, 50);
  ASSERT_EQ(points.size(), 7u + 6u);  // seven were searched for, one of them not found
  const SnapshotMatch& match = snapshot.matches[0];
  const Eigen::Matrix2d information = match.innovation_cov.inverse();
  for (const Json& point : points[0]["points"]) {
    const Eigen::Vector2d d =
        Eigen::Vector2d(point["x"], point["y"]) - Eigen::Vector2d(0.5, 0.5) - match.predicted;
    EXPECT_NEAR(std::sqrt(d.dot(information * d)), 3, 0.05);
  }
  ASSERT_EQ(points[1]["points"].size(), 4u);
  EXPECT_NEAR(points[1]["points"][0]["x"].get<double>() + 5, match.measured->x(), 0.051);  // an 11 px square
  EXPECT_NEAR(points[1]["points"][2]["y"].get<double>() - 6, match.measured->y(), 0.051);
  EXPECT_EQ(points[0]["outline_color"]["g"], 0.86);
}

TEST(SnapshotLog, DrawsLandmarksAsTwoSigmaEllipsoids) {
  const Scratch scratch;
  const McapContents read = log(scratch / "run.mcap");
  const Json entities = parsed(*read.of("/map").back())["entities"];
  ASSERT_EQ(entities.size(), 2u);
  EXPECT_EQ(entities[0]["id"], "anchors");
  EXPECT_EQ(entities[0]["spheres"].size(), 2u);
  const Snapshot last = with_image({}, 119);
  ASSERT_EQ(entities[1]["spheres"].size(), last.landmarks.size() - 2);
  for (std::size_t i = 2; i < last.landmarks.size(); ++i) {
    const Json& sphere = entities[1]["spheres"][i - 2];
    const Json& q = sphere["pose"]["orientation"];
    const Eigen::Matrix3d axes = rotation_matrix<double>(Eigen::Vector4d(q["w"], q["x"], q["y"], q["z"]));
    const Json& size = sphere["size"];
    const Eigen::Vector3d sigma = Eigen::Vector3d(size["x"], size["y"], size["z"]) / 4;
    const Eigen::Matrix3d covariance = axes * sigma.cwiseAbs2().asDiagonal() * axes.transpose();
    EXPECT_TRUE(covariance.isApprox(last.landmarks[i].covariance, 1e-9)) << i;
    EXPECT_EQ(sphere["pose"]["position"]["y"], last.landmarks[i].position.y());
  }
}

TEST(SnapshotLog, AcceptsNonFiniteValues) {
  const Scratch scratch;
  Snapshot snapshot = with_image({}, 50);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  snapshot.bodies[0].estimate.position.setConstant(unknown);
  snapshot.bodies[0].covariance.setConstant(unknown);
  snapshot.matches[0].innovation_cov.setConstant(unknown);
  snapshot.matches[1].predicted.setConstant(1e300);
  snapshot.matches[2].innovation_cov.setZero();
  snapshot.matches[3].measured->setConstant(unknown);
  snapshot.matches[7].particles[0].pixel.setConstant(unknown);
  snapshot.matches[7].particles[1].weight = unknown;
  snapshot.bodies[0].truth->position.setConstant(unknown);
  snapshot.landmarks[3].covariance.setConstant(unknown);
  snapshot.bodies.at(0).decision.scores[1] = -std::numeric_limits<double>::infinity();
  snapshot.status.reason = "\xff\"\n";
  SnapshotLog log(scratch / "run.mcap", info());
  log.publish(snapshot);
  snapshot.tick.t = -1;
  log.publish(snapshot);
  log.close(snapshot.landmarks);
  const McapContents read = testing::read_mcap(contents(scratch / "run.mcap"));
  EXPECT_EQ(read.count("/estimate/pose"), 0u);
  EXPECT_EQ(read.of("/snapshot")[1]->log_time_ns, 0u);
  for (const McapMessage& message : read.messages)
    EXPECT_EQ(testing::problems(parsed(message),
                                Json::parse(read.schemas.at(read.schema_of_topic.at(message.topic)))),
              "");
}

TEST(SnapshotLog, SameRunSameBytesAtAnySpeed) {
  const Scratch scratch;
  for (const double pace_ms : {5.0, 7.0}) {
    SnapshotLog log(scratch / std::to_string(pace_ms), info());
    for (int i = 0; i < 100; ++i) log.publish(with_image({}, i, pace_ms));
    log.close({});
  }
  EXPECT_EQ(contents(scratch / std::to_string(5.0)), contents(scratch / std::to_string(7.0)));
}

TEST(SnapshotLog, OnAFullDiskKeepsItsCompleteChunks) {
  const Scratch scratch;
  const testing::FileSizeLimit limit(1'500'000);
  SnapshotLog log(scratch / "run.mcap", info());
  EXPECT_THROW(for (int i = 0; i < 5000; ++i) log.publish(with_image({}, i)), RecordError);
  EXPECT_NO_THROW(log.publish(with_image({}, 5000)));
  EXPECT_NO_THROW(log.close({}));
  EXPECT_GT(testing::read_mcap(contents(scratch / "run.mcap")).count("/snapshot"), 100u);
}

TEST(Base64, FollowsTheRfc) {
  const std::pair<const char*, const char*> known[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"},
                                                       {"\xff\xfe\xfd", "//79"}};
  for (const auto& [bytes, text] : known) {
    EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
  for (const char* other : {"Zg", "Zg=", "Z===", "====", "Zm9v\n", "Zm 9", "Zm9v*===", "=Zm9", "Zg==Zg=="})
    EXPECT_FALSE(from_base64(other)) << other;
}

}  // namespace
}  // namespace incognita
