#include <fmt/format.h>

#include <Eigen/LU>
#include <system_error>

#include "incognita/io/calibrations/kitti_projection.hpp"
#include "incognita/io/calibrations/read_calibration.hpp"
#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/image_file.hpp"
#include "incognita/io/formats/image_names.hpp"
#include "incognita/io/formats/number_table.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/io/recordings/true_poses.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {
namespace {

namespace fs = std::filesystem;

constexpr int most_cameras = 4;  // 0 and 1 gray, 2 and 3 in color; 0 and 2 left

fs::path image_folder_of(const fs::path& folder, int camera) {
  return folder / fmt::format("image_{}", camera);
}

std::vector<int> cameras_in(const fs::path& folder) {
  std::vector<int> found;
  std::error_code ignored;
  for (int camera = 0; camera < most_cameras; ++camera)
    if (fs::is_directory(image_folder_of(folder, camera), ignored)) found.push_back(camera);
  return found;
}

std::optional<KittiProjection> projection_of(const fs::path& folder, int camera) {
  const fs::path file = folder / "calib.txt";
  return file_exists(file) ? kitti_projection(file, fmt::format("P{}", camera)) : std::nullopt;
}

std::optional<CalibratedCamera> camera_in(const fs::path& folder, int camera,
                                          const std::vector<fs::path>& images) {
  if (!projection_of(folder, camera) || images.empty()) return std::nullopt;
  const auto header = read_image_header(images.front());
  if (!header) return std::nullopt;
  const CalibrationRequest request{fmt::format("P{}", camera), std::pair{header->width, header->height}};
  return read_calibration_file(folder / "calib.txt", request).calibrated;
}

/// poses.txt in the folder, else where the benchmark has it: sequences/07 and poses/07.txt.
std::optional<fs::path> truth_of(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  const fs::path named = whole.has_filename() ? whole : whole.parent_path();
  const fs::path published =
      named.parent_path().parent_path() / "poses" / (named.filename().string() + ".txt");
  for (const fs::path& file : {folder / "poses.txt", published})
    if (file_exists(file)) return file;
  return std::nullopt;
}

/// The poses are those of camera 0; the others are beside it, with the same axes.
void read_truth(const fs::path& folder, int camera, Recording& recording) {
  const auto file = truth_of(folder);
  if (!file) {
    recording.notes.emplace_back(
        "there is neither poses.txt nor ../../poses/NN.txt with the number of the sequence: the truth is unknown");
    return;
  }
  recording.truth = read_matrix_poses(*file, recording.frames);
  recording.notes.push_back(fmt::format("the truth is {}", file->string()));
  const auto p = projection_of(folder, camera);
  if (camera == 0) return;
  if (!p) {
    recording.notes.push_back(fmt::format(
        "the truth is that of camera 0, not of camera {}: there is no P{} in calib.txt", camera, camera));
    return;
  }
  const Eigen::Vector3d in_camera_0 = -p->leftCols<3>().inverse() * p->col(3);
  for (RecordedPose& pose : recording.truth)
    pose.position += rotation_matrix(pose.world_from_camera) * in_camera_0;
}

void read_frames(const fs::path& folder, const std::vector<fs::path>& images, Recording& recording) {
  const std::vector<TableLine> lines = read_table(folder / "times.txt");
  if (images.size() != lines.size())
    throw InputError(fmt::format(
        "{}: has {} stamps for {} images in {}", (folder / "times.txt").string(), lines.size(), images.size(),
        images.empty() ? "the image folder" : images.front().parent_path().string()));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double t = lines[i].number(0);
    if (!recording.frames.empty() && t <= recording.frames.back().t)
      throw InputError(
          fmt::format("{}: the stamps must increase, {} does not", lines[i].where, lines[i].text(0)));
    recording.frames.push_back({t, images[i]});
  }
  if (recording.frames.empty())
    throw InputError(fmt::format("{}: lists no images", (folder / "times.txt").string()));
}

void note_cameras(const std::vector<int>& cameras, Recording& recording) {
  std::string others;
  for (std::size_t i = 1; i < cameras.size(); ++i) others += fmt::format(" image_{}", cameras[i]);
  recording.notes.push_back(fmt::format("the images are those of image_{}{}{}", cameras.front(),
                                        others.empty() ? "" : "; not used are", others));
}

}  // namespace

bool looks_like_kitti(const fs::path& folder) {
  return file_exists(folder / "times.txt") && !cameras_in(folder).empty();
}

std::optional<CalibratedCamera> camera_in_kitti(const fs::path& folder) {
  const std::vector<int> cameras = cameras_in(folder);
  if (cameras.empty()) return std::nullopt;
  return camera_in(folder, cameras.front(), images_in(image_folder_of(folder, cameras.front())));
}

Recording read_kitti(const fs::path& folder) {
  const std::vector<int> cameras = cameras_in(folder);
  if (cameras.empty())
    throw InputError(fmt::format("{}: has none of the folders image_0 to image_3", folder.string()));
  const int camera = cameras.front();
  const std::vector<fs::path> images = images_in(image_folder_of(folder, camera));
  Recording recording{"kitti", folder, {}, {}, {}, {}};
  read_frames(folder, images, recording);
  note_cameras(cameras, recording);
  recording.camera = camera_in(folder, camera, images);
  if (!recording.camera)
    recording.notes.push_back(fmt::format("no P{} in calib.txt: the camera is not compared", camera));
  read_truth(folder, camera, recording);
  return recording;
}

}  // namespace incognita
