#include "incognita/app/campaign/campaign_workers.hpp"

#include <algorithm>
#include <chrono>
#include <deque>
#include <thread>

namespace incognita {
namespace {

enum Kind { wants_work = 1, work, answer, go_home, gone };

using std::chrono::milliseconds;
constexpr milliseconds alone{200}, beside_others{2};  ///< polling intervals

/// Prefixes a text with a run number ("17 text"), and removes it again.
std::string numbered(std::size_t run, const std::string& text) { return std::to_string(run) + " " + text; }

std::size_t take_number(std::string& text) {
  const std::size_t blank = text.find(' ');
  const std::size_t run = std::stoul(text.substr(0, blank));
  text.erase(0, blank + 1);
  return run;
}

/// Progress through the list of runs.
struct Work {
  std::size_t next = 0;  ///< the first unassigned one
  std::size_t ended = 0;
  std::deque<int> idle = {};  ///< ranks waiting for work, once per free process
};

void assign_run(Ranks& ranks, ProcessPool& pool, const CampaignLead& lead, Work& at) {
  while (at.next < lead.runs.size() && pool.has_room()) {
    const std::size_t run = lead.runs[at.next++];
    pool.start(run, [&lead, run] { return lead.make(run); });
  }
  while (at.next < lead.runs.size() && !at.idle.empty()) {
    ranks.send(at.idle.front(), work, numbered(lead.runs[at.next++], lead.plan_digest));
    at.idle.pop_front();
  }
}

}  // namespace

void lead_workers(Ranks& ranks, const CampaignLead& lead) {
  ProcessPool pool(lead.jobs);
  Work at;
  bool stopped = false;
  const auto take = [&](std::size_t run, const std::string& how) {
    ++at.ended;
    stopped = !lead.taken(run, end_of_run(how)) || stopped;
  };
  while (at.ended < lead.runs.size() && !stopped && !lead.stopping()) {
    assign_run(ranks, pool, lead, at);
    for (const JobEnd& end : pool.wait(ranks.size() > 1 ? beside_others : alone))
      take(end.id, answer_of(end));
    while (auto message = ranks.receive()) {
      if (message->kind == wants_work) at.idle.push_back(message->from);
      if (message->kind != answer) continue;
      const std::size_t run = take_number(message->text);
      take(run, message->text);
    }
  }
}

void serve_as_worker(Ranks& ranks, std::size_t jobs, const MakeRunOf& make) {
  {
    ProcessPool pool(jobs);  // its destructor kills running jobs
    for (std::size_t i = 0; i < jobs; ++i) ranks.send(0, wants_work, "");
    for (bool home = false; !home;) {
      for (const JobEnd& end : pool.wait(beside_others)) {
        ranks.send(0, answer, numbered(end.id, answer_of(end)));
        ranks.send(0, wants_work, "");
      }
      while (auto message = ranks.receive()) {
        home = home || message->kind == go_home;
        if (message->kind != work) continue;
        const std::size_t run = take_number(message->text);
        pool.start(run, [&make, run, plan = message->text] { return make(run, plan); });
      }
    }
  }
  ranks.send(0, gone, "");
}

/// Remaining answers are dropped.
WorkerGuard::~WorkerGuard() {
  for (int other = 1; other < ranks_.size(); ++other) ranks_.send(other, go_home, "");
  for (int left = ranks_.size() - 1; left > 0;) {
    if (const auto message = ranks_.receive())
      left -= message->kind == gone;
    else
      std::this_thread::sleep_for(beside_others);
  }
}

}  // namespace incognita
