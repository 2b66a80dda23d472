#include "incognita/math/random.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace incognita {
namespace {

/// FNV-1a of the name, then splitmix64 of seed and name, so that similar seeds and names give unrelated streams.
std::uint64_t stream_seed(std::uint64_t seed, std::string_view name) {
  std::uint64_t h = 0xcbf29ce484222325ull;
  for (const char c : name) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  std::uint64_t z = h ^ (seed + 0x9e3779b97f4a7c15ull);
  for (int round = 0; round < 2; ++round) {
    z += 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    z ^= z >> 31;
  }
  return z;
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::string_view name) : engine_(stream_seed(seed, name)) {}

double RandomStream::uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }

double RandomStream::normal() {  // Marsaglia's polar method
  if (has_spare_) {
    has_spare_ = false;
    return spare_;
  }
  for (;;) {
    const double a = 2 * uniform() - 1, b = 2 * uniform() - 1, r = a * a + b * b;
    if (r <= 0 || r >= 1) continue;
    const double k = std::sqrt(-2 * std::log(r) / r);
    spare_ = b * k;
    has_spare_ = true;
    return a * k;
  }
}

int RandomStream::below(int count) {
  if (count < 1)
    throw std::invalid_argument("RandomStream::below needs count >= 1, got " + std::to_string(count));
  return static_cast<int>(uniform() * count);
}

}  // namespace incognita
