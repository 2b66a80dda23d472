#include "experiments/list.hpp"

namespace incognita {

const std::vector<Experiment>& all_experiments() {
#define INCOGNITA_COPY(name) name,
  // made at the first call, when every file's constants are there
  static const std::vector<Experiment> all = {INCOGNITA_EXPERIMENTS(INCOGNITA_COPY)};
#undef INCOGNITA_COPY
  return all;
}

}  // namespace incognita
