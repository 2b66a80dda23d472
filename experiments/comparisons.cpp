#include "experiments/comparisons.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace incognita {

std::string condition(const std::string& less_than, const std::vector<Comparison>& all) {
  std::vector<std::string> parts;
  for (const auto& [answer, begin] : {std::pair{Answer::shown, less_than},
                                      {Answer::refuted, "not " + less_than},
                                      {Answer::undecided, "undecided against"}}) {
    std::vector<std::string> rivals;
    for (const Comparison& one : all)
      if (one.answer == answer) rivals.push_back(one.rival);
    if (!rivals.empty()) parts.push_back(fmt::format("{} {}", begin, fmt::join(rivals, ", ")));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace incognita
