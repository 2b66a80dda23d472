#include "incognita/io/cameras/network_video.hpp"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "incognita/messages/stream_times.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace incognita {
namespace {

constexpr double network_timeout_s = 5;
constexpr std::int64_t most_probing_us = 2'000'000;

struct FreeFfmpeg {
  void operator()(AVFormatContext* format) const { avformat_close_input(&format); }
  void operator()(AVCodecContext* decoder) const { avcodec_free_context(&decoder); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* conversion) const { sws_freeContext(conversion); }
};
template <class T>
using FfmpegPtr = std::unique_ptr<T, FreeFfmpeg>;

/// Limits how long FFmpeg waits for the network.
struct Patience {
  std::shared_ptr<const std::atomic<bool>> stop;
  double until_s = 0;
  bool is_closing = false;

  void renew() { until_s = steady_s() + network_timeout_s; }
  /// An RTSP server is told that nobody watches any more, or it goes on sending until it notices.
  void close() {
    constexpr double farewell_s = 0.2;
    is_closing = true;
    until_s = steady_s() + farewell_s;
  }
  bool is_over() const { return (*stop && !is_closing) || steady_s() > until_s; }
  static int interrupts(void* self) { return static_cast<const Patience*>(self)->is_over(); }
};

std::string ffmpeg_text(int error) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(error, text, sizeof text);
  return text;
}

std::string reason_and_remedy(int error) {
  switch (error) {
    case AVERROR_HTTP_UNAUTHORIZED:
    case AVERROR_HTTP_FORBIDDEN:
      return "user or password is wrong or missing; they belong into the address: rtsp://user:password@host/path";
    case AVERROR_HTTP_NOT_FOUND:
      return "the server answers and has nothing at this path; the manual of the camera says which it has";
    case AVERROR_INVALIDDATA:
      return "what answers sends no video that FFmpeg knows; is this the address of a page, or of another server?";
    case AVERROR_PROTOCOL_NOT_FOUND:
      return "FFmpeg knows no addresses of this kind; rtsp:// and http:// are usual";
    case AVERROR_EXIT:
    case AVERROR(ETIMEDOUT):
      return fmt::format("nothing came for {:.0f} s; is it on, and does `ping` reach it?", network_timeout_s);
    case AVERROR(EIO):
      return "its host is not found, or ends the connection at once; is its name right?";
    case AVERROR_EOF:
      return "the stream broke off";
    default:
      return ffmpeg_text(error) +
             "; is it on, is its name right, and does `ffplay` show it from this machine?";
  }
}

[[noreturn]] void fail_with(int error) { throw std::runtime_error(reason_and_remedy(error)); }

/// Of a video of known length, before the first image of it.
[[noreturn]] void fail_to_begin() {
  throw std::runtime_error(
      "its server sends it from the begin only, and what describes the images comes after them; make an MP4 "
      "with `-movflags faststart`");
}

/// `address` without `?udp` at its end, which FFmpeg would send as part of the path.
std::string take_transport(std::string address, AVDictionary*& options) {
  constexpr std::string_view udp = "?udp";
  if (!address.starts_with("rtsp") || !address.ends_with(udp)) {
    av_dict_set(&options, "rtsp_flags", "prefer_tcp", 0);  // passes every firewall
    return address;
  }
  av_dict_set(&options, "rtsp_transport", "udp", 0);
  address.resize(address.size() - udp.size());
  return address;
}

/// RTSP describes its streams beforehand, and a sequence of JPEG files needs no description. Anything else must be read for that,
/// which costs up to two seconds.
bool is_described(const AVFormatContext& format) {
  if (!(format.iformat->flags & (AVFMT_NOFILE | AVFMT_NOTIMESTAMPS))) return false;
  for (unsigned k = 0; k < format.nb_streams; ++k) {
    const AVCodecParameters& codec = *format.streams[k]->codecpar;
    if (codec.codec_type == AVMEDIA_TYPE_VIDEO && codec.codec_id != AV_CODEC_ID_NONE) return true;
  }
  return false;
}

class NetworkVideo final : public VideoConnection {
 public:
  NetworkVideo(const std::string& address, std::shared_ptr<const std::atomic<bool>> stop)
      : patience_{std::move(stop)},
        frame_(av_frame_alloc()),
        gray_(av_frame_alloc()),
        packet_(av_packet_alloc()) {
    if (!frame_ || !gray_ || !packet_) throw std::bad_alloc();
    av_log_set_level(
        AV_LOG_PANIC);  // the reasons are in the exceptions; damaged images are not worth a line each
    patience_.renew();
    open_format(address);
    open_decoder();
  }
  ~NetworkVideo() override { patience_.close(); }
  NetworkVideo(const NetworkVideo&) = delete;
  NetworkVideo& operator=(const NetworkVideo&) = delete;

  bool grab() override {
    patience_.renew();
    is_damaged_ = false;
    while (!is_damaged_) {
      const int received = avcodec_receive_frame(decoder_.get(), frame_.get());
      if (received == 0) return true;
      if (received == AVERROR_EOF && !is_recorded()) fail_with(AVERROR_EOF);
      if (received == AVERROR_EOF) return false;
      is_damaged_ = received != AVERROR(EAGAIN) || !read_packet();
    }
    return true;
  }

  double reported_s() const override {
    const std::int64_t t = frame_->best_effort_timestamp;
    const bool is_counted =
        format_->iformat->flags & AVFMT_NOTIMESTAMPS;  // as if there were 25 images per second
    return is_counted || t == AV_NOPTS_VALUE ? 0 : static_cast<double>(t) * av_q2d(stream_->time_base);
  }

  std::optional<Image> image() override {
    if (shows_damage()) return std::nullopt;
    const int width = frame_->width, height = frame_->height;
    prepare_gray(width, height);
    if (const int rows = sws_scale(to_gray_.get(), frame_->data, frame_->linesize, 0, height, gray_->data,
                                   gray_->linesize);
        rows < 0)
      fail_with(rows);
    Image image(width, height);
    for (int v = 0; v < height; ++v)
      std::memcpy(image.row(v), gray_->data[0] + static_cast<std::ptrdiff_t>(v) * gray_->linesize[0],
                  static_cast<std::size_t>(width));
    return image;
  }

  bool is_recorded() const override { return format_->duration > 0; }

 private:
  void open_format(const std::string& address) {
    AVFormatContext* format = avformat_alloc_context();
    if (!format) throw std::bad_alloc();
    format->interrupt_callback = {Patience::interrupts, &patience_};
    format->max_analyze_duration = most_probing_us;
    AVDictionary* options = nullptr;
    const std::string url = take_transport(address, options);
    const int error = avformat_open_input(&format, url.c_str(), nullptr, &options);
    av_dict_free(&options);
    if (error < 0) fail_with(error);  // the context is freed
    format_.reset(format);
    if (is_described(*format)) return;
    if (const int found = avformat_find_stream_info(format, nullptr); found < 0) fail_with(found);
  }

  void open_decoder() {
    const AVCodec* codec = nullptr;
    const int index = av_find_best_stream(format_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (index < 0 || !codec) throw std::runtime_error("what comes has no video that FFmpeg can decode");
    stream_ = format_->streams[index];
    for (unsigned k = 0; k < format_->nb_streams; ++k)
      if (format_->streams[k] != stream_) format_->streams[k]->discard = AVDISCARD_ALL;
    decoder_.reset(avcodec_alloc_context3(codec));
    if (!decoder_) throw std::bad_alloc();
    avcodec_parameters_to_context(decoder_.get(), stream_->codecpar);
    decoder_->pkt_timebase = stream_->time_base;
    // Threads that decode images side by side each hold one back; those for the slices of an image do not look for damage in H.264.
    decoder_->thread_count = 1;
    if (codec->id == AV_CODEC_ID_MJPEG) decoder_->err_recognition |= AV_EF_EXPLODE;  // no half images
    if (const int error = avcodec_open2(decoder_.get(), codec, nullptr); error < 0) fail_with(error);
  }

  /// Gives the next one to the decoder. False if that refuses it, since the network damaged it.
  bool read_packet() {
    const int error = av_read_frame(format_.get(), packet_.get());
    if (patience_.is_over())
      fail_with(AVERROR_EXIT);  // even if there is a packet: the one before, which was held back
    if (error == AVERROR(EAGAIN)) return true;
    if (error == AVERROR_EOF && is_recorded()) return avcodec_send_packet(decoder_.get(), nullptr) >= 0;
    if (error == AVERROR(EIO) || error == AVERROR_INVALIDDATA)
      is_recorded() && !has_begun_ ? fail_to_begin() : fail_with(AVERROR_EOF);
    if (error < 0) fail_with(error);
    const bool is_image = packet_->stream_index == stream_->index &&
                          packet_->size > 0;  // to the decoder, an empty one would be the end
    if (is_image) patience_.renew(), has_begun_ = true;
    const int refused = is_image ? avcodec_send_packet(decoder_.get(), packet_.get()) : 0;
    av_packet_unref(packet_.get());
    return refused >= 0;
  }

  /// Whether what was grabbed is damaged, or was predicted from what was: all up to the next key frame. Cameras that send none
  /// refresh their images bit by bit.
  bool shows_damage() {
    constexpr double refresh_s = 2;
    const double now_s = steady_s();
    const bool is_bad = is_damaged_ || frame_->flags & AV_FRAME_FLAG_CORRUPT || frame_->decode_error_flags;
    if (is_bad)
      damaged_at_s_ = now_s;
    else if (frame_->key_frame)
      damaged_at_s_.reset();
    return damaged_at_s_ && now_s < *damaged_at_s_ + refresh_s;
  }

  void prepare_gray(int width, int height) {
    const auto kind = static_cast<AVPixelFormat>(frame_->format);
    to_gray_.reset(sws_getCachedContext(to_gray_.release(), width, height, kind, width, height,
                                        AV_PIX_FMT_GRAY8, SWS_BILINEAR, nullptr, nullptr, nullptr));
    if (!to_gray_) throw std::runtime_error("its images are of a kind that FFmpeg does not convert to gray");
    if (gray_->width == width && gray_->height == height) return;
    av_frame_unref(gray_.get());
    gray_->format = AV_PIX_FMT_GRAY8, gray_->width = width, gray_->height = height;
    if (av_frame_get_buffer(gray_.get(), 0) < 0) throw std::bad_alloc();
  }

  Patience patience_;
  FfmpegPtr<AVFrame> frame_, gray_;
  FfmpegPtr<AVPacket> packet_;
  FfmpegPtr<AVFormatContext> format_;
  AVStream* stream_ = nullptr;  ///< of format_
  FfmpegPtr<AVCodecContext> decoder_;
  FfmpegPtr<SwsContext> to_gray_;
  bool has_begun_ = false;              ///< an image was received
  bool is_damaged_ = false;             ///< what was grabbed
  std::optional<double> damaged_at_s_;  ///< steady_s() at the last damage since the last key frame
};

}  // namespace

std::unique_ptr<VideoConnection> open_network(const std::string& address,
                                              std::shared_ptr<const std::atomic<bool>> stop) {
  return std::make_unique<NetworkVideo>(address, std::move(stop));
}

}  // namespace incognita
