#include "incognita/record/mcap/snapshot_log.hpp"

#include <cmath>
#include <utility>

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

std::uint64_t nanoseconds(double t_s) {
  return t_s > 0 ? static_cast<std::uint64_t>(std::llround(t_s * 1e9)) : 0;
}

/// Also true after the clock has jumped back.
bool is_due(std::uint64_t now_ns, const std::optional<std::uint64_t>& last_ns, std::uint64_t every_ns) {
  return !last_ns || now_ns < *last_ns || now_ns - *last_ns >= every_ns;
}

bool finite(const StampedPose& pose) { return pose.position.allFinite() && pose.orientation.allFinite(); }

}  // namespace

const SnapshotLog::Topic SnapshotLog::transforms{"/tf", "foxglove.FrameTransform",
                                                 message_schemas::frame_transform};
const SnapshotLog::Topic SnapshotLog::estimated_poses{"/estimate/pose", "foxglove.PoseInFrame",
                                                      message_schemas::pose_in_frame};
const SnapshotLog::Topic SnapshotLog::true_poses{"/truth/pose", "foxglove.PoseInFrame",
                                                 message_schemas::pose_in_frame};
const SnapshotLog::Topic SnapshotLog::images{"/camera/image", "foxglove.CompressedImage",
                                             message_schemas::compressed_image};
const SnapshotLog::Topic SnapshotLog::annotations{"/camera/annotations", "foxglove.ImageAnnotations",
                                                  message_schemas::image_annotations};
const SnapshotLog::Topic SnapshotLog::maps{"/map", "foxglove.SceneUpdate", message_schemas::scene_update};
const SnapshotLog::Topic SnapshotLog::snapshots{"/snapshot", "incognita.Snapshot", message_schemas::snapshot};
const SnapshotLog::Topic SnapshotLog::run{"/run", "incognita.Run", message_schemas::run};

SnapshotLog::SnapshotLog(const std::filesystem::path& path, const RunInfo& info)
    : file_(path, "incognita " + info.version),
      true_world_(same_frame_as_truth(info) ? world : "true_world"),
      body_(info.body),
      patch_size_px_(info.patch_size_px),
      run_(run_message(info)) {}

void SnapshotLog::put(const Topic& topic, const std::string& message) {
  auto channel = channels_.find(topic.name);
  if (channel == channels_.end())
    channel =
        channels_.emplace(topic.name, file_.add_channel(topic.name, topic.schema_name, topic.schema())).first;
  file_.write(channel->second, time_ns_, message);
}

/// Frames of the bodies: vehicle, vehicle_2, ..., true_vehicle, true_vehicle_2, ...
void SnapshotLog::put_poses(const Snapshot& snapshot) {
  for (std::size_t i = 0; i < snapshot.bodies.size(); ++i) {
    const SnapshotBody& body = snapshot.bodies[i];
    const std::string frame = i == 0 ? body_ : body_ + "_" + std::to_string(i + 1);
    if (has_pose(body) && finite(body.estimate)) {
      put(transforms, frame_transform(time_ns_, world, frame, body.estimate));
      if (i == 0) put(estimated_poses, pose_in_frame(time_ns_, world, body.estimate));
    }
    if (!body.truth || !finite(*body.truth)) continue;
    put(transforms, frame_transform(time_ns_, true_world_, "true_" + frame, *body.truth));
    if (i == 0) put(true_poses, pose_in_frame(time_ns_, true_world_, *body.truth));
  }
}

void SnapshotLog::put_picture(const Snapshot& snapshot) {
  if (!snapshot.image || snapshot.image->empty()) return;
  if (!is_due(time_ns_, picture_time_ns_, picture_every_ns)) return;
  picture_time_ns_ = time_ns_;
  put(images, compressed_image(time_ns_, body_, *snapshot.image));
  put(annotations, image_annotations(time_ns_, matches_of_first_camera(snapshot), patch_size_px_));
}

void SnapshotLog::publish(const Snapshot& snapshot) {
  if (!file_.is_open()) return;
  time_ns_ = nanoseconds(snapshot.tick.t);
  const bool with_map = is_due(time_ns_, map_time_ns_, map_every_ns);
  if (!run_.empty()) put(run, std::exchange(run_, {}));
  put_poses(snapshot);
  put_picture(snapshot);
  put(snapshots, snapshot_message(snapshot, with_map, ParticleLists::flat));
  if (!with_map) return;
  put(maps, scene_update(time_ns_, world, snapshot.landmarks));
  map_time_ns_ = time_ns_;
}

void SnapshotLog::close(const std::vector<SnapshotLandmark>& map) {
  if (file_.is_open() && map_time_ns_ && *map_time_ns_ != time_ns_)
    put(maps, scene_update(time_ns_, world, map));
  file_.close();
}

}  // namespace incognita
