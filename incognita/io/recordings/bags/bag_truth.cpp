#include "incognita/io/recordings/bags/bag_truth.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace incognita {
namespace {

constexpr double ns_per_s = 1e9;

std::int64_t time_of(const BagStamps& stamps, bool by_recorder) {
  return by_recorder ? stamps.recorded_ns : stamps.header_ns;
}

/// Frames that do not move with an estimate: REP 105's world and map, and those of motion capture systems.
bool is_world(std::string frame) {
  static constexpr auto words =
      std::to_array<std::string_view>({"world", "map", "earth", "vicon", "mocap", "optitrack", "qualisys"});
  for (char& c : frame) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return frame.starts_with(word); });
}

bool is_by_odometry(const std::vector<std::string>& chain) {
  return std::any_of(chain.begin(), chain.end(),
                     [](const std::string& frame) { return frame.find("odom") != std::string::npos; });
}

/// How the camera lies in the frame whose poses are the truth; says so.
RigidPose camera_in_body(const bags::PoseMessage& pose, const std::string& camera, const TransformTree& tree,
                         std::vector<std::string>& notes) {
  if (pose.child.empty()) {
    notes.push_back(
        "the truth is taken for the pose of the camera's optical axes: its messages do not say whose it is");
    return {};
  }
  if (pose.child == camera) {
    notes.push_back(fmt::format("the truth is the pose of `{}`, the frame of the images, in `{}`", camera,
                                pose.header.frame));
    return {};
  }
  if (const auto fixed = tree.fixed_pose(pose.child, camera)) {
    notes.push_back(fmt::format(
        "the truth is the pose of `{}` in `{}`, transformed to `{}`, the frame of the images, by TF",
        pose.child, pose.header.frame, camera));
    return *fixed;
  }
  notes.push_back(fmt::format(
      "the truth is that of `{}`, not of the camera: TF has no fixed transform from there to `{}`, the frame of the images",
      pose.child, camera));
  return {};
}

/// In time order; of equal times the first.
void sort_poses(std::vector<RecordedPose>& poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const RecordedPose& a, const RecordedPose& b) { return a.t < b.t; });
  const auto end = std::unique(poses.begin(), poses.end(),
                               [](const RecordedPose& a, const RecordedPose& b) { return a.t == b.t; });
  poses.erase(end, poses.end());
}

RecordedPose recorded(const RigidPose& world_from_camera, std::int64_t time_ns) {
  return {static_cast<double>(time_ns) / ns_per_s, world_from_camera.position,
          world_from_camera.world_from_body};
}

BagTruth truth_of_topic(const BagContents& contents, const std::string& camera, const TransformTree& tree,
                        bool by_recorder) {
  BagTruth truth;
  if (contents.poses.empty()) return truth;
  const bool has_stamps = std::any_of(contents.poses.begin(), contents.poses.end(),
                                      [](const auto& pose) { return pose.stamps.header_ns != 0; });
  if (!has_stamps && !by_recorder)
    truth.notes.push_back("the truth has no time stamps: it has the times of the recorder");
  const RigidPose body_from_camera = camera_in_body(contents.poses.front().pose, camera, tree, truth.notes);
  const bool by_recorded = by_recorder || !has_stamps,
             takes_zero = by_recorded || zero_is_a_time(contents.poses);
  std::size_t invalid = 0, of_others = 0;
  for (const BagContents::Pose& pose : contents.poses) {
    const auto world_from_body = rigid_pose(pose.pose);
    if (!world_from_body || (!takes_zero && pose.stamps.header_ns == 0))
      ++invalid;
    else if (pose.pose.child != contents.poses.front().pose.child)
      ++of_others;
    else
      truth.poses.push_back(
          recorded(composed(*world_from_body, body_from_camera), time_of(pose.stamps, by_recorded)));
  }
  if (invalid > 0)
    truth.notes.push_back(fmt::format(
        "{} true poses are not used: they have no time stamp, no unit quaternion, or are not finite",
        invalid));
  if (of_others > 0)
    truth.notes.push_back(fmt::format("{} true poses are of other frames, and not used", of_others));
  sort_poses(truth.poses);
  return truth;
}

BagTruth truth_of_transforms(const std::vector<std::string>& chain, const TransformTree& tree,
                             const std::vector<std::int64_t>& frames) {
  BagTruth truth;
  for (const std::int64_t t : frames)
    if (const auto pose = tree.pose(chain, t)) truth.poses.push_back(recorded(*pose, t));
  sort_poses(truth.poses);
  truth.notes.push_back(fmt::format("the truth is the pose of the camera by TF, {}: of {} of {} images",
                                    fmt::join(chain.rbegin(), chain.rend(), " > "), truth.poses.size(),
                                    frames.size()));
  return truth;
}

/// What the user could name, since nothing was guessed.
std::string unknown_truth(const ChosenTopics& topics, const std::vector<std::string>& chain) {
  std::vector<std::string> names;
  for (const bags::BagTopic* topic : topics.other_poses)
    names.push_back(topic->name + " (" + topic->type + ")");
  if (chain.size() > 1)
    names.push_back(fmt::format("{} ({})", topics.transforms.front()->name,
                                fmt::join(chain.rbegin(), chain.rend(), " > ")));
  return fmt::format("the truth is unknown{}{}", names.empty() ? "" : ": recording.truth_topic may name ",
                     fmt::join(names, ", "));
}

}  // namespace

BagTruth truth_of_bag(BagContents contents, const ChosenTopics& topics,
                      const std::vector<std::int64_t>& frames, bool by_recorder) {
  contents.transforms.sort(by_recorder);
  const TransformTree& tree = contents.transforms;
  const std::string& camera = contents.images.front().frame;
  const std::vector<std::string> chain = tree.to_root(camera);
  const bool moves = std::any_of(chain.begin(), std::prev(chain.end()),
                                 [&](const std::string& frame) { return !tree.never_changes(frame); });
  const bool is_truth = moves && is_world(chain.back()) && !is_by_odometry(chain);
  BagTruth truth;
  if (topics.truth)
    truth = truth_of_topic(contents, camera, tree, by_recorder);
  else if (chain.size() > 1 && (topics.transforms_named || is_truth))
    truth = truth_of_transforms(chain, tree, frames);
  else if (topics.transforms_named)
    truth.notes.push_back(
        fmt::format("the truth is unknown: TF has no transform to `{}`, the frame of the images", camera));
  else
    truth.notes.push_back(unknown_truth(topics, moves ? chain : std::vector<std::string>{}));
  if (tree.unused() > 0)
    truth.notes.push_back(
        fmt::format("{} transforms are not used: they are not rigid, or to a second parent", tree.unused()));
  return truth;
}

}  // namespace incognita
