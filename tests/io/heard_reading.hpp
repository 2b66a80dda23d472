// What readers report of their progress.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "incognita/io/formats/reading_progress.hpp"

namespace incognita::testing {

class HeardReading final : public ReadingListener {
 public:
  struct Heard {
    Reading reading;
    std::vector<std::uint64_t> done;
    bool ended = false;
  };
  std::vector<Heard> heard;  ///< one after the other

  void progressed(const Reading& reading, std::uint64_t done) override {
    if (heard.empty() || heard.back().ended) heard.push_back({reading, {}});
    heard.back().done.push_back(done);
  }
  void ended(const Reading&) override { heard.back().ended = true; }

  /// "bytes of x.bag, messages of x.bag"; of those that increased and ended.
  std::string in_words() const {
    std::string words;
    for (const Heard& one : heard) {
      const bool increases = std::is_sorted(one.done.begin(), one.done.end(),
                                            [](std::uint64_t a, std::uint64_t b) { return a <= b; });
      words += (words.empty() ? "" : ", ") + one.reading.unit + " of " +
               one.reading.file.filename().string() +
               (increases && one.ended ? "" : " (does not increase, or has no end)");
    }
    return words;
  }
};

}  // namespace incognita::testing
