#include "supervisor/ltl/mission/train_journal.h"

#include <cmath>
#include <utility>

#include "supervisor/run/internal/journal_json.h"

namespace stepwright::ltl {
namespace {

using run::internal::json;

constexpr run::internal::JournalForm kForm{"train's journal", 1};

json blocked_json(const Area& area) {
  json corners = json::array();
  for (const geometry::Point p : area.ring) corners.push_back({p.x_m, p.y_m});
  return {{"name", area.name}, {"corners_m", std::move(corners)}};
}

const char* own_from(const json& document, TrainJournal& journal) {
  journal.task = document.at("task");
  journal.watched = document.value("watched", journal.task);
  journal.state = document.at("state");
  for (const json& each : document.at("blocked")) {
    Area area{.name = each.at("name"), .ring = {}, .where = {}};
    for (const json& p : each.at("corners_m")) area.ring.push_back({p.at(0), p.at(1)});
    if (area.ring.size() < 3) return "a place that is blocked has fewer than three corners";
    for (const geometry::Point p : area.ring)
      if (!std::isfinite(p.x_m) || !std::isfinite(p.y_m)) return "a corner that is no place";
    journal.blocked.push_back(std::move(area));
  }
  return nullptr;
}

}  // namespace

result::Result<void> write_train_journal(const std::filesystem::path& file, const TrainJournal& journal) {
  json blocked = json::array();
  for (const Area& area : journal.blocked) blocked.push_back(blocked_json(area));
  return run::internal::write_journal(file, kForm, journal,
                                      {{"task", journal.task},
                                       {"watched", journal.watched},
                                       {"state", journal.state},
                                       {"blocked", std::move(blocked)}});
}

result::Result<std::optional<TrainJournal>> read_train_journal(const std::filesystem::path& file) {
  return run::internal::read_journal<TrainJournal>(file, kForm, own_from);
}

}  // namespace stepwright::ltl
