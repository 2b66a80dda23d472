// Every experiment, in the thesis' order. The file of one defines the constant of that name.
#pragma once

#include "incognita/report/experiment.hpp"

// clang-format off
#define INCOGNITA_EXPERIMENTS(EACH) \
  EACH(text_chapters_1_to_3) EACH(example_3_1) EACH(example_3_2) EACH(example_3_3) \
  EACH(example_3_4) EACH(example_3_5) EACH(example_3_6) EACH(example_3_7) EACH(example_3_8) \
  EACH(example_3_9) EACH(example_3_10) EACH(example_3_11) EACH(text_chapter_4) EACH(example_4_1) \
  EACH(example_4_2) EACH(example_4_3) EACH(example_4_4) EACH(example_4_5) EACH(example_4_6) \
  EACH(example_5_1) EACH(example_5_2) EACH(example_5_3) EACH(mrclam) EACH(example_5_4) \
  EACH(section_6_1) EACH(section_6_3) EACH(section_6_3_images) EACH(section_6_3_2) \
  EACH(section_6_4_equations) EACH(section_6_4) EACH(section_6_4_3) EACH(points_claims) \
  EACH(appendix_c_claims) EACH(appendix_c_runs) EACH(consistency)
// clang-format on

namespace incognita {

#define INCOGNITA_DECLARE(name) extern const Experiment name;
INCOGNITA_EXPERIMENTS(INCOGNITA_DECLARE)
#undef INCOGNITA_DECLARE

}  // namespace incognita
