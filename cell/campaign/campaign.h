#pragma once

// Runs of one cell, each disturbed by its seed, and what came of them.
//
//   auto base = prepare({"cells/bench/cell.toml"});
//   Campaign campaign = run_campaign(*base, {.first = 1, .runs = 100});
//   std::fputs(table(campaign).c_str(), stdout);
//
// Thread rule: run_campaign spreads over threads of its own; the rest is pure.

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "cell/campaign/cell_run.h"

namespace stepwright::campaign {

struct CampaignOptions {
  std::uint64_t first = 1;  // seed of the first run; the next one has the next
  std::uint64_t runs = 100;
  unsigned jobs = 1;
  bool disturbed = true;  // false: nothing goes wrong in any run
};

struct Tally {
  std::uint64_t runs = 0;
  std::array<std::uint64_t, kVerdicts> of{};  // by verdict

  std::uint64_t count(Verdict verdict) const { return of[static_cast<std::size_t>(verdict)]; }
};

struct Campaign {
  std::string cell;
  CampaignOptions options;
  bool planned = false;
  CellRun undisturbed;     // with seed 0: what all others are beside
  CellRun last;            // the run that ended last
  double horizon_s = 0.0;  // within which faults begin
  std::size_t offered = 0;
  std::size_t without_range = 0;
  std::map<std::string, Tally> by_kind;         // "none", "single", "compound", "all"
  std::map<std::string, Tally> by_fault;        // by its name; a compound run counts for each
  std::map<std::string, std::uint64_t> causes;  // of runs that did not reach their goal: "safe: leak"
  std::vector<CellRun> failures;                // lost or violated, by seed
  double wall_s = 0.0;

  std::uint64_t runs() const;
};

// First an undisturbed run with seed 0, which sets the horizon; then the others. `told`
// (may be empty) hears how many are done; once `cancel` (may be null) is set no further one begins.
Campaign run_campaign(const CellBase& base, const CampaignOptions& options,
                      const std::function<void(std::uint64_t done)>& told = {},
                      const std::atomic<bool>* cancel = nullptr);

// For people, and one JSON object.
std::string table(const Campaign& campaign);
std::string to_json(const Campaign& campaign);
// One run in full, for who repeats it by its seed.
std::string story(const CellRun& run);

}  // namespace stepwright::campaign
