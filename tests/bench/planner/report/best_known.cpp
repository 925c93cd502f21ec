#include "tests/bench/planner/report/best_known.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

namespace stepwright::bench {

using nlohmann::json;

result::Result<BestKnown> BestKnown::load(const std::string& path) {
  BestKnown best;
  std::ifstream file(path);
  if (!file) return best;
  const json all = json::parse(file, nullptr, false);
  const auto broken = [&](const std::string& what) {
    return result::fail("P0001", {path, 0, 0}, what, "delete the file, or restore it from the repository");
  };
  if (!all.is_object()) return broken("the best known costs are no JSON object");
  for (const auto& [name, entry] : all.items()) {
    if (!entry.is_object() || !entry.contains("digest") || !entry.contains("cost") ||
        !entry.contains("bound"))
      return broken("the entry '" + name + "' lacks its digest, cost or bound");
    best.entries_[name] = {entry["digest"], {entry["cost"], entry["bound"], entry.value("found_by", "")}};
  }
  return best;
}

std::optional<Known> BestKnown::find(const Instance& instance) const {
  const auto found = entries_.find(instance.name());
  if (found == entries_.end() || found->second.digest != instance.digest()) return std::nullopt;
  return found->second.known;
}

void BestKnown::offer(const Instance& instance, double cost, double bound, const std::string& found_by) {
  const std::optional<Known> old = find(instance);
  Known known = old.value_or(Known{cost, bound, found_by});
  if (cost < known.cost - 1e-6) known = {cost, known.bound, found_by};
  known.bound = std::max(known.bound, bound);
  entries_[instance.name()] = {instance.digest(), known};
}

bool BestKnown::save(const std::string& path) const {
  json all = json::object();
  for (const auto& [name, entry] : entries_) {
    all[name] = {{"digest", entry.digest},
                 {"cost", entry.known.cost},
                 {"bound", entry.known.bound},
                 {"proved", entry.known.proved()},
                 {"found_by", entry.known.found_by}};
  }
  std::ofstream file(path);
  file << all.dump(1) << "\n";
  return static_cast<bool>(file);
}

}  // namespace stepwright::bench
