#include "incognita/app/campaign/campaign_progress.hpp"

#include <fmt/format.h>

#include "incognita/app/console/print_message.hpp"

namespace incognita {

CampaignProgress::CampaignProgress(const CampaignPlan& plan, std::size_t runs)
    : plan_(plan),
      runs_(runs),
      line_(static_cast<std::int64_t>(runs), "runs"),
      reported_(std::chrono::steady_clock::now()) {}

void CampaignProgress::report(std::size_t run, const RunResult& result) {
  ++ended_;
  if (result.status != "done") {
    ++failed_;
    print_message("{}, seed {}: {}: {}\n", plan_.variant_of(run).name, plan_.seed_of(run), result.status,
                  result.reason);
  }
  line_.show(static_cast<std::int64_t>(ended_), fmt::format("{} failed", failed_));
  const auto now = std::chrono::steady_clock::now();
  if (line_.on_terminal() || now - reported_ < std::chrono::seconds(10)) return;
  reported_ = now;
  print_message("{} of {} runs, {} failed\n", ended_, runs_, failed_);
}

void CampaignProgress::report_trouble(std::size_t run, const std::string& why) {
  print_message("{}, seed {}: no result: {}\n", plan_.variant_of(run).name, plan_.seed_of(run), why);
}

}  // namespace incognita
