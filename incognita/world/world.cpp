#include "incognita/world/world.hpp"

#include <stdexcept>

namespace incognita {

void World::displace(const DisplaceBody&) {
  throw std::invalid_argument("the bodies of this world cannot be displaced: they are recorded or real");
}

void World::push(const PushBody&) {
  throw std::invalid_argument("the bodies of this world cannot be pushed: they are recorded or real");
}

}  // namespace incognita
