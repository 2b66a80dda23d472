#include "experiments/experiment.hpp"
#include "experiments/list.hpp"

namespace incognita {

const std::vector<Experiment>& all_experiments() {
  // made at the first call, when every file's constants are there
  static const std::vector<Experiment> all = {example_3_2, example_3_5,  example_3_7,
                                              example_3_9, example_3_11, consistency};
  return all;
}

}  // namespace incognita
