// Who makes the runs: processes on this machine, and on others those that mpirun started.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "incognita/app/campaign/campaign_run.hpp"
#include "incognita/app/campaign/ranks.hpp"

namespace incognita {

/// Makes one run and says how it ended, as make_run() does. In a process of its own.
using MakeRun = std::function<std::string(std::size_t run)>;
/// The same for someone else, who says what the plan is. Refuses to work by another.
using MakeRunOf = std::function<std::string(std::size_t run, const std::string& plan_digest)>;

/// Rank 0: hands out the runs of the list, one whenever a process is free, and takes in how each ended.
/// `taken` returns false to stop; `stopping` is asked again and again. Runs in progress are dropped then.
struct CampaignLead {
  std::size_t jobs = 1;
  std::vector<std::size_t> runs;
  std::string plan_digest;
  MakeRun make;
  std::function<bool(std::size_t run, const RunEnd& end)> taken;
  std::function<bool()> stopping;
};
void lead_workers(Ranks& ranks, const CampaignLead& lead);

/// Any other rank: makes the runs that it is given until it is sent home.
void serve_as_worker(Ranks& ranks, std::size_t jobs, const MakeRunOf& make);

/// In rank 0, on every way out: tells the others to go, and waits until they have.
class WorkerGuard {
 public:
  explicit WorkerGuard(Ranks& ranks) : ranks_(ranks) {}
  ~WorkerGuard();
  WorkerGuard(const WorkerGuard&) = delete;
  WorkerGuard& operator=(const WorkerGuard&) = delete;

 private:
  Ranks& ranks_;
};

}  // namespace incognita
