// The common style of all figures, with a palette that is safe for color-blind readers.
#pragma once

#include <string>

namespace incognita {

/// First lines of a gnuplot script that draws `figures/NAME.svg`, run in the parent folder of `figures`.
std::string figure_head(const std::string& name, int width_px, int height_px);

}  // namespace incognita
