// The published range-bearing recordings, where they are present.
#include "incognita/io/recordings/range_recording.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "incognita/io/formats/data_folder.hpp"
#include "incognita/messages/errors.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;

/// Scans of the first seconds after the first message of any sensor.
struct Beginning {
  std::size_t scans = 0, seeing = 0, detections = 0, most = 0;
};

Beginning beginning_of(const RangeRecording& recording, double duration_s) {
  const double first =
      std::min({recording.odometry.front().t, recording.scans.front().t, recording.truth.front().t});
  Beginning beginning;
  for (const RangeRecording::Scan& scan : recording.scans) {
    if (scan.t - first > duration_s) continue;
    ++beginning.scans;
    beginning.seeing += scan.detections.empty() ? 0 : 1;
    beginning.detections += scan.detections.size();
    beginning.most = std::max(beginning.most, scan.detections.size());
  }
  return beginning;
}

std::filesystem::path published(const std::string& folder) {
  try {
    return find_data(folder, "", "test");
  } catch (const InputError& error) {
    std::printf("%s\n", error.what());
    return {};
  }
}

TEST(PublishedRecordings, AreNamedWhereTheyAreMissing) {
  const auto complaint = [](const char* path) { return message_of([&] { find_data(path, "", "x"); }); };
  EXPECT_HAS(complaint("acfr_car_park/none"), "github.com/yuzehai1995/hwork_SLAM");
  EXPECT_HAS(complaint("mrclam/none"), "asrl.utias.utoronto.ca/datasets/mrclam");
}

TEST(PublishedCarPark, HasTheNumberOfDetectionsInTheLiterature) {
  const std::filesystem::path folder = published("acfr_car_park");
  if (folder.empty()) GTEST_SKIP() << "the recording is missing";
  const RangeRecording recording = read_range_recording(folder, "auto");
  EXPECT_EQ(recording.odometry.size(), 5001u);
  EXPECT_EQ(recording.truth.size(), 626u);
  EXPECT_EQ(recording.scans.size(), 586u);
  EXPECT_EQ(recording.landmarks.size(), 15u);
  const Beginning beginning = beginning_of(recording, 112);
  EXPECT_EQ(beginning.scans, 524u);
  EXPECT_EQ(beginning.detections, 830u);
  EXPECT_EQ(beginning.seeing, 462u);
  EXPECT_EQ(beginning.most, 4u);
}

TEST(PublishedMrclam, IsReadForEveryRobot) {
  const std::filesystem::path folder = published("mrclam/MRCLAM_Dataset7");
  if (folder.empty()) GTEST_SKIP() << "the recording is missing";
  const std::size_t odometry[] = {58598, 60936, 55085, 62207, 59787};
  const std::size_t detections[] = {2578, 3818, 4425, 1822, 3424};
  for (int robot = 1; robot <= 5; ++robot) {
    const RangeRecording recording = read_range_recording(folder, "auto", robot);
    EXPECT_EQ(recording.odometry.size(), odometry[robot - 1]);
    EXPECT_EQ(beginning_of(recording, 1e9).detections, detections[robot - 1]);
    EXPECT_EQ(recording.landmarks.size(), 15u);
  }
}

}  // namespace
}  // namespace incognita
