// A target to print: a black rectangle of A5 size, 210 x 148.5 mm, with a white rectangle in it that is not in its middle.
//
// The patches of its eight corners look the same from any distance, and the four outer ones differ from each other, so that they are
// found by correlation (slam/features/target_pose.hpp). The inner rectangle gives four more points to the pose, and makes the sheet differ
// from itself upside down, which its picture shows.
#pragma once

#include <optional>
#include <string>

#include "incognita/io/targets/target_files.hpp"

namespace incognita {

struct Paper {
  std::string name;
  double width_mm = 0, height_mm = 0;  ///< landscape
};

/// `a4` or `letter`; nothing for another word.
std::optional<Paper> paper_of(const std::string& word);

/// The sheet at true scale, with a line of 100 mm to check the printer. The same bytes each time.
std::string target_pdf(const Paper& paper);

/// The sheet as pixels, drawn by the same function: gray levels of `black` to `white`. Pixel (0, 0) is the upper left corner of the paper.
Image target_sheet_image(const Paper& paper, double px_per_mm, int black = 20, int white = 235);

/// Corners, patches and picture of the sheet.
NewTarget printed_target(const Paper& paper);

}  // namespace incognita
