#include "incognita/decision/actions.hpp"

namespace incognita {

std::vector<Translation> seven_translations() {
  return {{"go_forward", {1, 0, 0}}, {"go_backwards", {-1, 0, 0}}, {"go_right", {0, -1, 0}},
          {"go_left", {0, 1, 0}},    {"go_up", {0, 0, 1}},         {"go_down", {0, 0, -1}},
          {"stay", {0, 0, 0}}};
}

}  // namespace incognita
