#include "incognita/app/campaign/campaign_progress.hpp"

#include <fmt/format.h>

#include "incognita/app/console/say.hpp"

namespace incognita {

CampaignProgress::CampaignProgress(const CampaignPlan& plan, std::size_t runs)
    : plan_(plan),
      runs_(runs),
      line_(static_cast<std::int64_t>(runs), "runs"),
      told_(std::chrono::steady_clock::now()) {}

void CampaignProgress::tell(std::size_t run, const RunResult& result) {
  ++ended_;
  if (result.status != "done") {
    ++failed_;
    say("{}, seed {}: {}: {}\n", plan_.variant_of(run).name, plan_.seed_of(run), result.status,
        result.reason);
  }
  line_.show(static_cast<std::int64_t>(ended_), fmt::format("{} failed", failed_));
  const auto now = std::chrono::steady_clock::now();
  if (line_.on_terminal() || now - told_ < std::chrono::seconds(10)) return;
  told_ = now;
  say("{} of {} runs, {} failed\n", ended_, runs_, failed_);
}

void CampaignProgress::tell_trouble(std::size_t run, const std::string& why) {
  say("{}, seed {}: no result: {}\n", plan_.variant_of(run).name, plan_.seed_of(run), why);
}

}  // namespace incognita
