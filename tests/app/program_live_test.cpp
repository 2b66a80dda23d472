// Runs whose images come from a camera: a video in real time, and a stream of the network. What they record is kept, and repeats them.
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <thread>

#include "tests/app/program.hpp"
#include "tests/mjpeg_server.hpp"
#include "tests/numbered_images.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::Circumstances;
using testing::Ended;
using testing::incognita;
using testing::MjpegServer;
using testing::Program;
using testing::Scratch;
using testing::Words;

/// Images of a run in the rendered room, as a video of 15 images/s.
void write_clip(const Scratch& scratch) {
  ASSERT_EQ(
      incognita({"run", "room", "--duration", "3", "--save-recording", "--no-figures", "--out", "rendered"},
                scratch.folder())
          .code,
      0);
  cv::VideoWriter video((scratch / "clip.mkv").string(), cv::CAP_FFMPEG,
                        cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 15, cv::Size(320, 240));
  ASSERT_TRUE(video.isOpened());
  for (const std::string& line : testing::lines(scratch / "rendered/recording/rgb.txt"))
    if (!line.starts_with("#"))
      video.write(cv::imread((scratch / "rendered/recording" / line.substr(line.find(' ') + 1)).string()));
}

Words live(const std::string& source, const std::string& out) {
  return {"run",
          "hand",
          "--no-figures",
          "--out",
          out,
          "--duration",
          "60",
          "--set",
          "live.source=\"" + source + "\"",
          "--set",
          "camera.model=\"wide-angle\"",
          "--set",
          "camera.width_px=320",
          "--set",
          "camera.height_px=240",
          "--set",
          "camera.fu_px=195",
          "--set",
          "camera.fv_px=195",
          "--set",
          "camera.u0_px=159.5",
          "--set",
          "camera.v0_px=119.5",
          "--set",
          "start.from=\"target\"",
          "--set",
          "start.target=\"targets/sheet.toml\""};
}

TEST(ProgramLive, TracksRecordsAndIsRepeatedByTheSameBytes) {
  const Scratch scratch;
  write_clip(scratch);
  const Ended run = incognita(live((scratch / "clip.mkv").string(), "seen"), scratch.folder());
  // On a busy machine so many images may be dropped that the run is lost: it must be repeated all the same
  ASSERT_TRUE(run.code == 0 || run.code == 1) << run.err;
  const auto summary = testing::summary_of(scratch / "seen");
  const std::size_t used = testing::lines(scratch / "seen/recording/rgb.txt").size() - 1;
  EXPECT_EQ(summary["frames"].get<std::size_t>(), used);
  EXPECT_GT(used, 5u);
  EXPECT_EQ(used + summary["camera_dropped_images"].get<std::size_t>(),
            testing::lines(scratch / "rendered/recording/rgb.txt").size() - 1)
      << "used or counted as dropped";
  EXPECT_LT(summary["lost_frames"].get<std::size_t>(), used) << "it starts, at least";
  EXPECT_EQ(incognita({"run", "seen/replay.toml", "--no-figures", "--out", "again"}, scratch.folder()).code,
            run.code);
  for (const char* table : {"estimate.tum", "covariance.csv", "map.csv", "measurements.csv", "actions.csv"})
    EXPECT_EQ(testing::contents(scratch / "again" / table), testing::contents(scratch / "seen" / table))
        << table;

  // What a camera saw cannot be had again
  const Ended over = incognita({"run", "seen/replay.toml", "--out", "seen"}, scratch.folder());
  EXPECT_EQ(over.code, 2);
  EXPECT_SAYS(over.err, "seen holds the recording of this run");
  const Ended second = incognita(live((scratch / "clip.mkv").string(), "seen"), scratch.folder());
  EXPECT_EQ(second.code, 2);
  EXPECT_SAYS(second.err, "seen holds what a camera saw in an earlier run");
  EXPECT_EQ(testing::lines(scratch / "seen/recording/rgb.txt").size() - 1, used);
}

TEST(ProgramLive, IsInterruptedWhileItWaits) {
  const Scratch scratch;
  Words words = live("browser", "waits");
  words.insert(words.end(), {"--view=0"});
  Program program(words, Circumstances{scratch.folder()});
  ASSERT_TRUE(testing::has_lines(scratch / "waits/effective.toml", 10));
  program.signal(SIGINT);
  EXPECT_EQ(program.wait().code, 1);
  EXPECT_EQ(testing::summary_of(scratch / "waits")["status"], "interrupted");
}

Words from_network(const MjpegServer& server, const std::string& give_up_s) {
  Words words = live(server.address(), "seen");
  words.insert(words.end(), {"--set", "live.give_up_s=" + give_up_s});
  return words;
}

/// Some of the numbers, 1/15 s apart.
void serve_numbers(MjpegServer::Viewer& viewer, int from, int to) {
  viewer.accept_request();
  for (int k = from; k < to; ++k)
    if (!viewer.send_image(testing::numbered_jpeg(k, 320, 240)) || !viewer.wait_for(1 / 15.0)) return;
}

struct RecordedImage {
  double t = 0;
  int number = 0;
};

std::vector<RecordedImage> recorded_images(const std::filesystem::path& recording) {
  std::vector<RecordedImage> images;
  for (const std::string& line : testing::lines(recording / "rgb.txt")) {
    if (line.starts_with("#")) continue;
    const std::string file = (recording / line.substr(line.find(' ') + 1)).string();
    images.push_back(
        {std::stod(line), testing::number_of(cv::imread(file, cv::IMREAD_GRAYSCALE).at<std::uint8_t>(5, 5))});
  }
  return images;
}

TEST(ProgramLive, TakesItsImagesFromTheNetworkUntilTheStreamHasEndedForGood) {
  const Scratch scratch;
  std::atomic<int> connections = 0;
  MjpegServer server([&](MjpegServer::Viewer& viewer) {
    switch (connections++) {
      case 0:
        return serve_numbers(viewer, 0, 12);
      case 1:
        return serve_numbers(viewer, 12, 24);
      default:
        viewer.refuse("404 Not Found");
    }
  });
  const Ended run = incognita(from_network(server, "2.5"), scratch.folder());
  EXPECT_EQ(run.code, 1);
  EXPECT_SAYS(run.err, server.address() + ": gives no image any more: the stream broke off; trying again");
  EXPECT_SAYS(run.err, server.address() + ": gives images again");
  const auto summary = testing::summary_of(scratch / "seen");
  EXPECT_EQ(summary["status"], "failed");
  EXPECT_SAYS(summary["reason"].get<std::string>(), "no image for 2.");
  EXPECT_SAYS(summary["reason"].get<std::string>(),
              server.address() + ": the server answers and has nothing at this path");
  EXPECT_EQ(summary["camera_connections"], 2);

  const auto images = recorded_images(scratch / "seen/recording");
  ASSERT_GE(images.size(), 4u);
  EXPECT_EQ(summary["frames"].get<std::size_t>(), images.size());
  EXPECT_LT(images.front().number, 12);
  EXPECT_GE(images.back().number, 12) << "also from the second connection";
  for (std::size_t k = 1; k < images.size(); ++k) {
    EXPECT_GT(images[k].number, images[k - 1].number);
    EXPECT_GT(images[k].t, images[k - 1].t);
  }
  const double shown_s =
      (images.back().number - images.front().number) / 15.0 + 1;  // a second until it is tried again
  EXPECT_NEAR(images.back().t - images.front().t, shown_s, 1);
}

TEST(ProgramLive, GivesUpAStreamThatStalls) {
  const Scratch scratch;
  MjpegServer server([](MjpegServer::Viewer& viewer) {
    serve_numbers(viewer, 0, 5);
    viewer.wait_for(60);
  });
  const Ended run = incognita(from_network(server, "1.5"), scratch.folder());
  EXPECT_EQ(run.code, 1);
  EXPECT_SAYS(testing::summary_of(scratch / "seen")["reason"].get<std::string>(),
              server.address() + ": is connected, and gives no image");
  EXPECT_FALSE(recorded_images(scratch / "seen/recording").empty());
}

TEST(ProgramLive, IsInterruptedWhileTheNetworkStalls) {
  const Scratch scratch;
  std::atomic<bool> stalls = false;
  MjpegServer server([&](MjpegServer::Viewer& viewer) {
    serve_numbers(viewer, 0, 5);
    stalls = true;
    viewer.wait_for(60);
  });
  Program program(from_network(server, "60"), Circumstances{scratch.folder()});
  ASSERT_TRUE(testing::has_lines(scratch / "seen/effective.toml", 10));
  while (!stalls) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  program.signal(SIGINT);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(program.wait().code, 1);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 4);
  EXPECT_EQ(testing::summary_of(scratch / "seen")["status"], "interrupted");
}

TEST(ProgramLive, SaysWhichCameraCannotBeUsed) {
  const Scratch scratch;
  const auto refusal = [&](const std::string& source) {
    const Ended ended = incognita(live(source, "out"), scratch.folder());
    EXPECT_EQ(ended.code, 2) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(scratch / "out"));
    return ended.err;
  };
  EXPECT_SAYS(refusal("browser"), "run with --view");
  EXPECT_SAYS(refusal("/dev/video-none"), "/dev/video-none: cannot be opened");
  EXPECT_SAYS(refusal("none.mp4"), "live.source: none.mp4");
  const Ended checked = incognita({"config", "hand", "--check"}, scratch.folder());
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_SAYS(checked.out, "the camera, browser, is not tried");
}

}  // namespace
}  // namespace incognita
