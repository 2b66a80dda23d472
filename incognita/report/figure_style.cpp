#include "incognita/report/figure_style.hpp"

#include <fmt/format.h>

namespace incognita {

std::string figure_head(const std::string& name, int width_px, int height_px) {
  // The palette of Okabe and Ito, which is safe for color-blind readers.
  return fmt::format(R"(# Draw again, in the folder above this one: gnuplot figures/{0}.gp
set terminal svg size {1},{2} dynamic rounded font 'DejaVu Sans,13' background '#ffffff' linewidth 1.2
set output 'figures/{0}.svg'
set encoding utf8
set datafile separator ','
set datafile missing 'nan'
set border 3 linecolor '#555555' linewidth 0.8
set tics nomirror out scale 0.6 textcolor '#333333'
set grid linecolor '#e4e4e4' linetype 1 linewidth 0.6
set key textcolor '#222222' samplen 2.2 spacing 1.15
blue = '#0072b2'; orange = '#d55e00'; green = '#009e73'; sky = '#56b4e9'; amber = '#e69f00'; pink = '#cc79a7'
ink = '#222222'; gray = '#9a9a9a'
)",
                     name, width_px, height_px);
}

}  // namespace incognita
