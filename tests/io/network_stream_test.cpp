// A camera of the network: what it gives, how it stalls, breaks, comes back and refuses.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "incognita/io/cameras/video_address.hpp"
#include "incognita/io/cameras/video_stream.hpp"
#include "incognita/messages/stream_times.hpp"
#include "tests/mjpeg_server.hpp"
#include "tests/numbered_images.hpp"
#include "tests/scratch.hpp"

namespace incognita {
namespace {

using testing::message_of;
using testing::MjpegServer;
using testing::numbered_jpeg;
using Viewer = MjpegServer::Viewer;

int number_of(const LiveReading& reading) { return testing::number_of((*reading.image)(5, 5)); }

/// Reads until there are `enough` of them, for 20 s at most.
std::vector<LiveReading> read_until(VideoStream& stream,
                                    const std::function<bool(const std::vector<LiveReading>&)>& enough) {
  std::vector<LiveReading> readings;
  for (const double start_s = steady_s(); !enough(readings) && steady_s() < start_s + 20;)
    if (auto reading = stream.read(0.02)) readings.push_back(*reading);
  return readings;
}

void expect_increasing(const std::vector<LiveReading>& readings) {
  for (std::size_t k = 1; k < readings.size(); ++k) EXPECT_GT(readings[k].t, readings[k - 1].t);
}

std::map<std::string, std::int64_t> counts_of(const VideoStream& stream) {
  const auto counts = stream.counts();
  return {counts.begin(), counts.end()};
}

/// Images with the numbers from 0, `interval_s` apart.
void serve_images(
    Viewer& viewer, int count, double interval_s, const std::function<void(int)>& at = [](int) {}) {
  viewer.accept_request();
  for (int k = 0; k < count; ++k) {
    const std::string jpeg = numbered_jpeg(k);
    at(k);
    if (!viewer.send_image(jpeg) || !viewer.wait_for(interval_s)) return;
  }
}

TEST(NetworkStream, GivesImagesWithTheTimesOfTheirArrival) {
  std::mutex mutex;
  std::map<int, double> sent_s;
  MjpegServer server([&](Viewer& viewer) {
    serve_images(viewer, 20, 0.1, [&](int k) {
      const std::lock_guard lock(mutex);
      sent_s[k] = steady_s();
    });
    viewer.wait_for(60);
  });
  VideoStream stream({server.address()});
  const auto readings =
      read_until(stream, [](const auto& all) { return !all.empty() && number_of(all.back()) >= 18; });
  ASSERT_GE(readings.size(), 3u);
  expect_increasing(readings);
  const std::lock_guard lock(mutex);
  const LiveReading& first = readings.front();
  for (const LiveReading& reading : readings) {
    ASSERT_TRUE(sent_s.contains(number_of(reading)));
    EXPECT_EQ(reading.image->width(), 64);
    EXPECT_NEAR(reading.t - first.t, sent_s[number_of(reading)] - sent_s[number_of(first)], 0.6)
        << "and not as if there were 25 per second";
  }
  EXPECT_GE(static_cast<std::int64_t>(readings.size()) + counts_of(stream)["camera_dropped_images"], 18)
      << "used or counted as dropped";
  EXPECT_EQ(counts_of(stream)["camera_connections"], 1);
}

TEST(NetworkStream, CountsDamagedImagesAndGoesOn) {
  MjpegServer server([](Viewer& viewer) {
    viewer.accept_request();
    for (int k = 0; k < 20; ++k) {
      const std::string jpeg = numbered_jpeg(k);
      if (!viewer.send_image(k % 2 == 0 ? jpeg : jpeg.substr(0, jpeg.size() / 3)) || !viewer.wait_for(0.05))
        return;
    }
    viewer.wait_for(60);
  });
  VideoStream stream({server.address()});
  const auto readings =
      read_until(stream, [](const auto& all) { return !all.empty() && number_of(all.back()) >= 18; });
  ASSERT_GE(readings.size(), 2u);
  for (const LiveReading& reading : readings) EXPECT_EQ(number_of(reading) % 2, 0);
  EXPECT_GE(counts_of(stream)["camera_damaged_images"], 8);
  EXPECT_EQ(counts_of(stream)["camera_connections"], 1);
}

TEST(NetworkStream, IsConnectedAgainAfterItBreaks) {
  std::atomic<int> connections = 0;
  MjpegServer server([&](Viewer& viewer) {
    const int connection = connections++;
    if (connection == 1) return;  // the server is up, and the camera not yet
    serve_images(viewer, connection == 0 ? 5 : 20, 0.05);
    if (connection > 0) viewer.wait_for(60);
  });
  VideoStream stream({server.address()});
  const auto before = read_until(stream, [&](const auto& all) {
    return !all.empty() && stream.problem().find("broke off") != std::string::npos;
  });
  const auto after =
      read_until(stream, [](const auto& all) { return !all.empty() && number_of(all.back()) >= 10; });
  ASSERT_FALSE(before.empty());
  ASSERT_FALSE(after.empty());
  expect_increasing(before);
  expect_increasing(after);
  EXPECT_GT(after.front().t, before.back().t + 0.9) << "the time of the break has passed";
  EXPECT_EQ(stream.problem(), "");
  const auto events = stream.take_events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_HAS(events[0], server.address() + ": gives no image any more: the stream broke off");
  EXPECT_HAS(events[1], server.address() + ": gives images again");
  EXPECT_EQ(counts_of(stream)["camera_connections"], 2);
}

TEST(NetworkStream, SaysThatItStallsAndEndsAllTheSame) {
  MjpegServer server([](Viewer& viewer) {
    serve_images(viewer, 3, 0.05);
    viewer.wait_for(60);
  });
  double end_s = 0;
  {
    VideoStream stream({server.address()});
    const auto readings =
        read_until(stream, [&](const auto& all) { return !all.empty() && !stream.problem().empty(); });
    EXPECT_FALSE(readings.empty());
    EXPECT_HAS(stream.problem(), "is connected, and gives no image");
    EXPECT_FALSE(stream.has_ended());
    end_s = steady_s();
  }
  EXPECT_LT(steady_s() - end_s, 2) << "nobody waits for the network";
}

TEST(NetworkStream, IsNoLongerWaitedForAfterFiveSeconds) {
  MjpegServer silent([](Viewer& viewer) { viewer.wait_for(60); });
  const double start_s = steady_s();
  EXPECT_HAS(message_of([&] { VideoStream({silent.address()}); }), "nothing came for 5 s");
  EXPECT_LT(steady_s() - start_s, 9);
}

TEST(NetworkStream, SaysWhyItIsRefusedAndKeepsThePassword) {
  const auto refusal = [](const std::string& status) {
    MjpegServer server([&](Viewer& viewer) { viewer.refuse(status); });
    return message_of([&] { VideoStream({"http://me:secret@" + server.host() + "/video"}); });
  };
  const std::string unauthorized = refusal("401 Unauthorized");
  EXPECT_HAS(unauthorized, "http://me:***@127.0.0.1:");
  EXPECT_HAS(unauthorized, "cannot be opened: user or password is wrong or missing");
  EXPECT_EQ(unauthorized.find("secret"), std::string::npos);
  EXPECT_HAS(refusal("404 Not Found"), "nothing at this path");
  EXPECT_HAS(refusal("200 OK"), "sends no video that FFmpeg knows");
  EXPECT_HAS(message_of([] { VideoStream({"rstp://127.0.0.1/"}); }), "no addresses of this kind");
}

TEST(NetworkStream, HidesThePasswordOfAnAddressAlone) {
  EXPECT_EQ(without_password("rtsp://me:se:cr@t@host:554/a?b=c:d@e"), "rtsp://me:***@host:554/a?b=c:d@e");
  for (const char* plain :
       {"rtsp://host:554/a@b:c", "rtsp://me@host:554/", "http://[::1]:80/x", "/dev/video0", "a:b@c.mp4"})
    EXPECT_EQ(without_password(plain), plain);
}

}  // namespace
}  // namespace incognita
