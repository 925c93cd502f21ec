#include "cell/campaign/campaign.h"

#include <algorithm>
#include <utility>

#include "cell/campaign/spread.h"

namespace stepwright::campaign {
namespace {

void count(const CellRun& run, Tally& tally) {
  ++tally.runs;
  ++tally.of[static_cast<std::size_t>(run.verdict)];
}

void add(CellRun run, Campaign& campaign) {
  count(run, campaign.by_kind["all"]);
  count(run, campaign.by_kind[run.disturbance.kind()]);
  for (const DrawnFault& fault : run.disturbance.faults) count(run, campaign.by_fault[fault.name]);
  if (run.verdict == Verdict::GoalReached) return;
  ++campaign.causes[std::string(to_string(run.verdict)) + ": " + run.cause];
  if (run.verdict != Verdict::SafeStop) campaign.failures.push_back(std::move(run));
}

}  // namespace

std::uint64_t Campaign::runs() const {
  const auto all = by_kind.find("all");
  return all == by_kind.end() ? 0 : all->second.runs;
}

Campaign run_campaign(const CellBase& base, const CampaignOptions& options,
                      const std::function<void(std::uint64_t done)>& told, const std::atomic<bool>* cancel) {
  Campaign campaign;
  campaign.cell = base.cell.file.string();
  campaign.options = options;
  campaign.planned = base.planned;
  campaign.offered = base.offered.size();
  campaign.without_range = base.without_range;
  campaign.undisturbed = run_cell(base, 0, {});
  campaign.horizon_s = base.planned ? campaign.undisturbed.time_s : base.cell.seconds;
  const std::vector<OfferedFault> none;
  const auto run = [&](std::uint64_t i) {
    const std::uint64_t seed = options.first + i;
    return run_cell(base, seed, draw(seed, options.disturbed ? base.offered : none, campaign.horizon_s));
  };
  const auto take = [&](CellRun result) {
    campaign.last = result;
    add(std::move(result), campaign);
  };
  campaign.wall_s = spread(options.runs, options.jobs, told, cancel, run, take);
  std::ranges::sort(campaign.failures, {}, &CellRun::seed);
  return campaign;
}

}  // namespace stepwright::campaign
