// The state of what this module holds.
#include <cereal/types/array.hpp>
#include <locale>
#include <sstream>

#include "incognita/math/chart.hpp"
#include "incognita/math/random.hpp"
#include "incognita/math/saved_state/matrices.hpp"

namespace incognita {

/// The words of the engine as its standard writes them.
void RandomStream::state(StateArchive& archive) {
  auto& [engine, spare, has_spare] = *this;
  std::ostringstream saved;
  saved.imbue(std::locale::classic());
  saved << engine;
  std::string words = saved.str();
  archive(words, spare, has_spare);
  if (!archive.restores()) return;
  std::istringstream from(words);
  from.imbue(std::locale::classic());
  if (!(from >> engine)) throw DamagedState("the words of a random stream");
}

void Chart::state(StateArchive& archive) {
  auto& [parts, count, ambient, tangent] = *this;
  archive(count);
  if (count < 0 || count > max_parts) throw DamagedState("a chart of " + std::to_string(count) + " parts");
  Chart restored{};
  for (int i = 0; i < count; ++i) {
    Part& part = parts[static_cast<std::size_t>(i)];
    archive(part.kind, part.size);
    if (part.kind > Kind::quaternion || part.size < 0 || part.size > (1 << 20))
      throw DamagedState("a part of a chart");
    restored.parts_[static_cast<std::size_t>(i)] = part;
    restored.ambient_ += part.size;
    restored.tangent_ += part.kind == Kind::quaternion ? 3 : part.size;
  }
  ambient = restored.ambient_;
  tangent = restored.tangent_;
}

}  // namespace incognita
