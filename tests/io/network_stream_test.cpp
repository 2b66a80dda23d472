// A camera of the network: what it gives, how it stalls, breaks, comes back and refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "incognita/io/cameras/network_video.hpp"
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
using testing::Scratch;
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

/// Eight images of H.264, of which 0 and 4 are key frames; the left half of the k-th is about 30 k:
///   ffmpeg -f lavfi -i "color=black:s=32x32:r=20:d=0.4,format=gray,geq=lum='if(lt(X,16),30*N,random(1)*160)'"
///     -pix_fmt yuv420p -c:v libx264 -preset fast -bsf:v filter_units=remove_types=6 -g 4 -keyint_min 4
///     -sc_threshold 0 -bf 0 -qp 42 -f h264 numbers.h264
constexpr std::string_view numbers_h264 =
    "000000016764000aacb64b6022000003000200000300501e244dc00000000168eac0412c8b0000016588843ff0d2b813aef8"
    "7783e804d132c9f017d900c8d5cf3ceb47f0c69377f1dd37c019b7c27cc4fdea24bc93101f6d6f5ce90653a8c1313d3ff175"
    "92900bde052344ffc318e6884f6b38c84474373605e6b35a3fe678cf43b1330e95732fd68c7cedfd6f80e3fc95ed4f404183"
    "1e5b75ee7cd7fa503901979773ac4ae56100000001419a3b1ffeaf7cfffff2b745dd033fd7fb7767da5fb071362f6d3a7b69"
    "fe504a1dc23852320fd58c64552d5f5ba68332a62fdb06e7b56139b88b0fc4a3c4b933c80e27766198f1ff45f81f4b0145a0"
    "00000001419a460ffffeaf7cfffd51b56d7ba7f9af6fbdabcff5be52f6ed62415d2552db7f9afc004b0c598c60a92b962e30"
    "3863f72876234de3a09b8b4cbc8728b16b3b00000001419a660ffffeaf7cfdb2310e6239e5e2a4dcaf695146e328576d4724"
    "5549e466f2b251f72c479ffdd7a1e6e3facb54323ea8d9bae2bdbd45cf880cdab28a7e0b22efad0e976a2707c45cc61e7edd"
    "81ffd2000000016764000aacb64b6022000003000200000300501e244dc00000000168eac0412c8b0000016588820fff1676"
    "a4edf8a63380e540dde39eed2efeddccbc3a28d4ee0b85bd15660f9e0bd8871ac8511b1322c3046f06f90e3ff398273f76fc"
    "eee708ef64789b4138dafc38d36bd87e39861a265cb54871fff16eaba4227e84720deccf216408b89bd9a772963d862912b5"
    "f32d241eba8426aff653abe70c689e6398bc69dc72f27500000001419a3b1ffe3db4d94d7941b187236c7b144eb958cb1358"
    "922bef078db25f8b8db2dfbca91aa9145ec7f8ab5109d60ad437e60239c764d316c2ba7b00000001419a460ffffeaf7cff6b"
    "96e047ff3ac93df8b1d24b8b80e85c23fbdbaa4808a358d164f0d2cabf39962e3df873011320d71b37ea6e60afd2e1d115a4"
    "eed41191bc0d215145d68100000001419a660ffffeaf7cfffef2ad56152ff411a84d099f328939f97132d37b1048242d0370"
    "24cab9bbd35eca9996d2e57e6f5ef37b50dd6374b82c0c0c9d2cd211";

std::string from_hexadecimal(std::string_view digits) {
  std::string bytes;
  for (std::size_t k = 0; k < digits.size(); k += 2)
    bytes += static_cast<char>(std::stoi(std::string(digits.substr(k, 2)), nullptr, 16));
  return bytes;
}

/// H.264 with the last third of one image after each key frame lost: of the `lost`-th, counted without the key frames.
std::string damaged_h264(const std::string& bytes, int lost) {
  constexpr std::string_view start("\0\0\1", 3);
  std::string out;
  int number = -1;
  for (std::size_t from = bytes.find(start), to; from < bytes.size(); from = to) {
    to = std::min(bytes.find(start, from + start.size()), bytes.size());
    const int kind = bytes[from + start.size()] & 31;
    if (kind == 5) number = 0;
    const bool is_lost = kind == 1 && ++number == lost;
    out += bytes.substr(from, is_lost ? (to - from) * 2 / 3 : to - from);
  }
  return out;
}

/// Those that can be used, of one connection until it breaks.
std::vector<int> usable_numbers(const std::string& address) {
  const auto video = open_network(address, std::make_shared<std::atomic<bool>>(false));
  std::vector<int> numbers;
  EXPECT_HAS(message_of<std::runtime_error>([&] {
               while (video->grab())
                 if (const auto image = video->image()) numbers.push_back(((*image)(5, 5) + 15) / 30);
             }),
             "the stream broke off");
  return numbers;
}

TEST(NetworkStream, UsesNoImageThatWasPredictedFromADamagedOne) {
  const std::string bytes = from_hexadecimal(numbers_h264);
  MjpegServer whole([&](Viewer& viewer) { viewer.send_file("video/h264", bytes); });
  EXPECT_EQ(usable_numbers(whole.address()), (std::vector{0, 1, 2, 3, 4, 5, 6, 7}));
  MjpegServer damaged([&](Viewer& viewer) { viewer.send_file("video/h264", damaged_h264(bytes, 2)); });
  EXPECT_EQ(usable_numbers(damaged.address()), (std::vector{0, 1, 4, 5}))
      << "from each key frame to the damage";
}

TEST(NetworkStream, SaysThatTheDescriptionOfAFileBelongsToItsFront) {
  const Scratch scratch;
  cv::VideoWriter video((scratch / "clip.mp4").string(), cv::CAP_FFMPEG,
                        cv::VideoWriter::fourcc('m', 'p', '4', 'v'), 20, cv::Size(320, 240));
  ASSERT_TRUE(video.isOpened());
  cv::Mat image(240, 320, CV_8UC3);
  for (int k = 0; k < 24; ++k) cv::randu(image, 0, 255), video.write(image);
  video.release();
  const std::string clip = testing::contents(scratch / "clip.mp4");
  MjpegServer server([&](Viewer& viewer) { viewer.send_file("video/mp4", clip); });
  const auto opened = open_network(server.address(), std::make_shared<std::atomic<bool>>(false));
  EXPECT_HAS(message_of<std::runtime_error>([&] { opened->grab(); }), "-movflags faststart");
}

/// The line of `request` that begins with `name`, without its end; empty if there is none.
std::string line_of(const std::string& request, const std::string& name) {
  const std::size_t from = request.find(name);
  return from == std::string::npos ? "" : request.substr(from, request.find("\r\n", from) - from);
}

/// Of a camera that agrees to everything.
std::string rtsp_answer(const std::string& request) {
  const std::string description =
      "v=0\r\no=- 0 0 IN IP4 127.0.0.1\r\ns=x\r\nc=IN IP4 0.0.0.0\r\nt=0 0\r\nm=video 0 RTP/AVP 26\r\n";
  std::string answer = "RTSP/1.0 200 OK\r\nSession: 1\r\n" + line_of(request, "CSeq: ") + "\r\n";
  if (const std::string transport = line_of(request, "Transport: "); !transport.empty())
    answer +=
        transport + (transport.find("UDP") == std::string::npos ? "" : ";server_port=7000-7001") + "\r\n";
  if (!request.starts_with("DESCRIBE")) return answer + "\r\n";
  return answer + "Content-Type: application/sdp\r\nContent-Length: " + std::to_string(description.size()) +
         "\r\n\r\n" + description;
}

/// All that is asked of a camera which sends nothing.
std::string rtsp_requests(const std::string& end_of_address) {
  std::string requests;
  std::atomic<bool> has_ended = false;
  MjpegServer server([&](Viewer& viewer) {
    for (std::string request = viewer.receive(); !request.empty(); request = viewer.receive()) {
      requests += request;
      viewer.send(rtsp_answer(request));
    }
    has_ended = true;
  });
  const auto stop = std::make_shared<std::atomic<bool>>(false);
  auto video = open_network("rtsp://" + server.host() + "/x" + end_of_address, stop);
  *stop = true;
  video.reset();
  for (const double start_s = steady_s(); !has_ended && steady_s() < start_s + 5;)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return has_ended ? requests : "";
}

TEST(NetworkStream, TellsAnRtspServerHowToSendAndWhenToEnd) {
  const std::string tcp = rtsp_requests(""), udp = rtsp_requests("?udp");
  EXPECT_HAS(tcp, "Transport: RTP/AVP/TCP");
  EXPECT_HAS(tcp, "TEARDOWN ");
  EXPECT_HAS(udp, "Transport: RTP/AVP/UDP");
  EXPECT_HAS(udp, "TEARDOWN ");
  EXPECT_EQ(udp.find("?udp"), std::string::npos) << "it is no part of the path";
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
  EXPECT_EQ(without_password("rtsp://admin:pa#ss@host/x"), "rtsp://admin:***@host/x");
  EXPECT_EQ(without_password("rtsp://admin:p/a?s@s@host/x"), "rtsp://admin:***@host/x");
  EXPECT_EQ(without_password("rtsp://host/user=admin&password=secret&channel=1"),
            "rtsp://host/user=admin&password=***&channel=1");
  EXPECT_EQ(without_password("rtsp://host:554/user=admin_password=se_cr/et_channel=1.sdp"),
            "rtsp://host:554/user=admin_password=***_channel=1.sdp");
  EXPECT_EQ(without_password("http://host/video?Pwd=secret"), "http://host/video?Pwd=***");
}

}  // namespace
}  // namespace incognita
