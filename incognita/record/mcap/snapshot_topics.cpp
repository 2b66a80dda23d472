#include "incognita/record/mcap/snapshot_topics.hpp"

#include <array>
#include <cmath>

#include "incognita/record/mcap/message_schemas.hpp"
#include "incognita/record/mcap/run_message.hpp"
#include "incognita/record/mcap/snapshot_message.hpp"
#include "incognita/record/mcap/viewer_messages.hpp"
#include "incognita/record/snapshot/series.hpp"

namespace incognita {
namespace {

constexpr std::uint64_t map_every_ns = 1'000'000'000;
constexpr std::uint64_t picture_every_ns = 45'000'000;  // every other image at 30 Hz, every image at 20 Hz
constexpr const char* world = "world";

enum { run, snapshots, transforms, estimated_poses, true_poses, images, annotations, maps };

const std::array<Topic, 8> topics{
    {{"/run", "incognita.Run", message_schemas::run},
     {"/snapshot", "incognita.Snapshot", message_schemas::snapshot},
     {"/tf", "foxglove.FrameTransform", message_schemas::frame_transform},
     {"/estimate/pose", "foxglove.PoseInFrame", message_schemas::pose_in_frame},
     {"/truth/pose", "foxglove.PoseInFrame", message_schemas::pose_in_frame},
     {"/camera/image", "foxglove.CompressedImage", message_schemas::compressed_image},
     {"/camera/annotations", "foxglove.ImageAnnotations", message_schemas::image_annotations},
     {"/map", "foxglove.SceneUpdate", message_schemas::scene_update}}};

std::uint64_t nanoseconds(double t_s) {
  return t_s > 0 ? static_cast<std::uint64_t>(std::llround(t_s * 1e9)) : 0;
}

/// Also true after the clock has jumped back.
bool is_due(std::uint64_t now_ns, const std::optional<std::uint64_t>& last_ns, std::uint64_t every_ns) {
  return !last_ns || now_ns < *last_ns || now_ns - *last_ns >= every_ns;
}

bool finite(const StampedPose& pose) { return pose.position.allFinite() && pose.orientation.allFinite(); }

/// Writes a message only if someone wants it.
template <class Write>
void put(TopicSink& sink, const Topic& topic, std::uint64_t time_ns, Write write) {
  if (sink.wants(topic)) sink.put(topic, time_ns, write());
}

}  // namespace

std::span<const Topic> all_topics() { return topics; }

SnapshotTopics::SnapshotTopics(const RunInfo& info)
    : run_(run_message(info)),
      true_world_(same_frame_as_truth(info) ? world : "true_world"),
      body_(info.body),
      patch_size_px_(info.patch_size_px) {}

/// Frames of the bodies: vehicle, vehicle_2, ..., true_vehicle, true_vehicle_2, ...
void SnapshotTopics::put_poses(const Snapshot& snapshot, TopicSink& sink) const {
  const std::uint64_t at = time_ns_;
  for (std::size_t i = 0; i < snapshot.bodies.size(); ++i) {
    const SnapshotBody& body = snapshot.bodies[i];
    const std::string frame = i == 0 ? body_ : body_ + "_" + std::to_string(i + 1);
    if (has_pose(body) && finite(body.estimate)) {
      put(sink, topics[transforms], at, [&] { return frame_transform(at, world, frame, body.estimate); });
      if (i == 0)
        put(sink, topics[estimated_poses], at, [&] { return pose_in_frame(at, world, body.estimate); });
    }
    if (!body.truth || !finite(*body.truth)) continue;
    put(sink, topics[transforms], at,
        [&] { return frame_transform(at, true_world_, "true_" + frame, *body.truth); });
    if (i == 0)
      put(sink, topics[true_poses], at, [&] { return pose_in_frame(at, true_world_, *body.truth); });
  }
}

void SnapshotTopics::put_picture(const Snapshot& snapshot, TopicSink& sink) {
  if (!snapshot.image || snapshot.image->empty()) return;
  if (!is_due(time_ns_, picture_time_ns_, picture_every_ns)) return;
  picture_time_ns_ = time_ns_;
  put(sink, topics[images], time_ns_, [&] { return compressed_image(time_ns_, body_, *snapshot.image); });
  put(sink, topics[annotations], time_ns_,
      [&] { return image_annotations(time_ns_, matches_of_first_camera(snapshot), patch_size_px_); });
}

void SnapshotTopics::publish(const Snapshot& snapshot, TopicSink& sink) {
  time_ns_ = nanoseconds(snapshot.tick.t);
  const bool with_map = is_due(time_ns_, map_time_ns_, map_every_ns);
  if (run_is_due_) put(sink, topics[run], time_ns_, [&] { return run_; });
  run_is_due_ = false;
  put_poses(snapshot, sink);
  put_picture(snapshot, sink);
  put(sink, topics[snapshots], time_ns_,
      [&] { return snapshot_message(snapshot, with_map, ParticleLists::flat); });
  if (!with_map) return;
  put(sink, topics[maps], time_ns_, [&] { return scene_update(time_ns_, world, snapshot.landmarks); });
  map_time_ns_ = time_ns_;
}

void SnapshotTopics::finish(const std::vector<SnapshotLandmark>& map, TopicSink& sink) {
  if (map_time_ns_ && *map_time_ns_ != time_ns_)
    put(sink, topics[maps], time_ns_, [&] { return scene_update(time_ns_, world, map); });
}

void SnapshotTopics::repeat() {
  run_is_due_ = true;
  map_time_ns_.reset(), picture_time_ns_.reset();
}

}  // namespace incognita
