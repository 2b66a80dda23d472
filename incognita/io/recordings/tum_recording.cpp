#include <fmt/format.h>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/number_table.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
#include "incognita/io/recordings/true_poses.hpp"
#include "incognita/messages/errors.hpp"

namespace incognita {

bool looks_like_tum(const std::filesystem::path& folder) { return file_exists(folder / "rgb.txt"); }

Recording read_tum(const std::filesystem::path& folder) {
  Recording recording{"tum", folder, {}, {}, {}, {}};
  for (const TableLine& line : read_table(folder / "rgb.txt")) {
    const double t = line.number(0);
    if (!recording.frames.empty() && t <= recording.frames.back().t) {
      throw InputError(fmt::format("{}: the stamps must increase, {} does not", line.where, line.text(0)));
    }
    recording.frames.push_back({t, folder / line.text(1)});
  }
  if (recording.frames.empty())
    throw InputError(fmt::format("{}: lists no images", (folder / "rgb.txt").string()));
  if (!file_exists(folder / "groundtruth.txt")) {
    recording.notes.push_back("there is no groundtruth.txt: the truth is unknown");
    return recording;
  }
  recording.truth = read_tum_poses(folder / "groundtruth.txt");
  return recording;
}

}  // namespace incognita
