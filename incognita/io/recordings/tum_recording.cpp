#include <fmt/format.h>

#include "incognita/io/formats/files.hpp"
#include "incognita/io/formats/number_table.hpp"
#include "incognita/io/recordings/recording_formats.hpp"
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
  for (const TableLine& line : read_table(folder / "groundtruth.txt")) {
    const Eigen::Vector4d q(line.number(7), line.number(4), line.number(5), line.number(6));
    const double t = line.number(0);
    if (std::abs(q.norm() - 1) > 1e-2) {
      throw InputError(fmt::format("{}: columns 5 to 8 must be a unit quaternion, their norm is {}",
                                   line.where, q.norm()));
    }
    if (!recording.truth.empty() && t < recording.truth.back().t) {
      throw InputError(fmt::format("{}: the stamps must not decrease, {} does", line.where, line.text(0)));
    }
    recording.truth.push_back({t, {line.number(1), line.number(2), line.number(3)}, q.normalized()});
  }
  return recording;
}

}  // namespace incognita
