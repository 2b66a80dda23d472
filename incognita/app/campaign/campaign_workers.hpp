// Distributes runs over processes on this machine and over the ranks started by mpirun.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "incognita/app/campaign/campaign_run.hpp"
#include "incognita/app/campaign/ranks.hpp"

namespace incognita {

/// Executes one run and returns its answer like make_run(), in a process of its own.
using MakeRun = std::function<std::string(std::size_t run)>;
/// The same on another rank; refuses if the digest of its plan differs.
using MakeRunOf = std::function<std::string(std::size_t run, const std::string& plan_digest)>;

/// Rank 0: assigns the listed runs to free processes and collects the answers. It ends when `taken` returns
/// false or `stopping`, which is polled, returns true; runs in progress are then dropped.
struct CampaignLead {
  std::size_t jobs = 1;
  std::vector<std::size_t> runs;
  std::string plan_digest;
  MakeRun make;
  std::function<bool(std::size_t run, const RunEnd& end)> taken;
  std::function<bool()> stopping;
};
void lead_workers(Ranks& ranks, const CampaignLead& lead);

/// Other ranks: execute assigned runs until told to stop.
void serve_as_worker(Ranks& ranks, std::size_t jobs, const MakeRunOf& make);

/// In rank 0: on every exit path, stops the other ranks and waits until they have ended.
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
