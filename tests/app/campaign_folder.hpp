// Campaigns of short runs for tests of the command `incognita campaign`.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/program.hpp"
#include "tests/record/schema.hpp"
#include "tests/scratch.hpp"

namespace incognita::testing {

namespace fs = std::filesystem;

inline constexpr const char* tables[] = {"runs.csv", "table.csv", "campaign.json"};
inline constexpr const char* vary = "plant.sigma_speed_m_s=0.05,0.2";

/// A folder with a scenario whose runs take a few milliseconds.
class CampaignFolder : public Scratch {
 public:
  CampaignFolder() {
    write("small.toml",
          "[world]\ntype = \"points\"\n[sensor]\ntype = \"range-bearing\"\n[run]\n"
          "rate_hz = 10\nduration_s = 2\n[vehicle]\nmodel = \"differential-drive\"\n"
          "sensor_forward_m = 0.3\nsensor_left_m = 0\n");
  }

  Words words(const Words& more, const char* out = "c") const {
    Words all = {"campaign", "small.toml", "--out", out};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  Ended campaign(const Words& more, const char* out = "c") const {
    return testing::incognita(words(more, out), folder());
  }
  std::string read(const std::string& file, const char* out = "c") const {
    return contents(*this / out / file);
  }

  /// Files of runs, without those that identify their campaign.
  std::vector<fs::path> results(const char* out = "c") const {
    std::vector<fs::path> found;
    if (!fs::exists(*this / out)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(*this / out)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("seed-") && name.ends_with(".json")) found.push_back(entry.path());
    }
    return found;
  }
};

inline void expect_same_tables(const CampaignFolder& campaigns, const char* a, const char* b) {
  for (const char* table : tables) {
    EXPECT_NE(campaigns.read(table, a), "") << table;
    EXPECT_EQ(campaigns.read(table, a), campaigns.read(table, b)) << table;
  }
}

inline Json schema() {
  return Json::parse(contents(fs::path(INCOGNITA_SOURCE_DIR) / "docs/schemas/campaign.schema.json"));
}

inline void wait_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

inline std::vector<pid_t> children_of(pid_t process) {
  std::vector<pid_t> found;
  for (const auto& task : fs::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
    std::istringstream list(contents(task.path() / "children"));
    for (pid_t child = 0; list >> child;) found.push_back(child);
  }
  return found;
}

/// A process that makes a run of the only campaign started by this process.
inline pid_t process_of_a_run() {
  for (int i = 0; i < 1000; ++i, wait_ms(10)) {
    const std::vector<pid_t> ours = children_of(::getpid());
    if (ours.empty()) continue;
    const std::vector<pid_t> theirs = children_of(ours.front());
    if (!theirs.empty()) return theirs.front();
  }
  return 0;
}

}  // namespace incognita::testing
