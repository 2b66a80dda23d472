#include "experiments/list.hpp"
#include "incognita/report/experiment.hpp"

namespace incognita {

const std::vector<Experiment>& all_experiments() {
  // made at the first call, when every file's constants are there
  static const std::vector<Experiment> all = {
      text_chapters_1_to_3, example_3_1, example_3_2,   example_3_3, example_3_4,   example_3_5,
      example_3_6,          example_3_7, example_3_8,   example_3_9, example_3_10,  example_3_11,
      text_chapter_4,       example_4_1, example_4_2,   example_4_3, example_4_4,   example_4_5,
      example_4_6,          example_5_1, example_5_2,   example_5_3, mrclam,        example_5_4,
      section_6_1,          section_6_3, section_6_3_2, section_6_4, section_6_4_3, consistency};
  return all;
}

}  // namespace incognita
