// What all figures have in common: paper, ink and a palette that colour-blind readers can tell apart too.
#pragma once

#include <string>

namespace incognita {

/// First lines of a gnuplot script that draws `figures/NAME.svg`, to be run in the folder that `figures` is
/// in.
std::string figure_head(const std::string& name, int width_px, int height_px);

}  // namespace incognita
