#include "supervisor/tamp/mission/arms_journal.h"

#include <cmath>
#include <utility>

#include "supervisor/run/internal/journal_json.h"

namespace stepwright::tamp::mission {
namespace {

using run::internal::json;

constexpr run::internal::JournalForm kForm{"journal of two arms", 1};

const char* own_from(const json& document, ArmsJournal& journal) {
  journal.order = document.at("order");
  journal.looks = document.at("looks");
  journal.held = document.at("held").get<std::map<std::string, std::string>>();
  journal.tries = document.at("tries").get<std::map<std::string, int>>();
  for (const auto& [name, place] : document.at("believed").items()) {
    const scene::Pose pose{place.at(0), place.at(1), place.at(2), place.at(3)};
    for (const double each : {pose.x_m, pose.y_m, pose.z_m, pose.angle_rad})
      if (!std::isfinite(each)) return "a thing that is nowhere";
    journal.believed[name] = pose;
  }
  return nullptr;
}

}  // namespace

result::Result<void> write_arms_journal(const std::filesystem::path& file, const ArmsJournal& journal) {
  json believed = json::object();
  for (const auto& [name, pose] : journal.believed)
    believed[name] = {pose.x_m, pose.y_m, pose.z_m, pose.angle_rad};
  return run::internal::write_journal(file, kForm, journal,
                                      {{"order", journal.order},
                                       {"looks", journal.looks},
                                       {"held", journal.held},
                                       {"tries", journal.tries},
                                       {"believed", std::move(believed)}});
}

result::Result<std::optional<ArmsJournal>> read_arms_journal(const std::filesystem::path& file) {
  return run::internal::read_journal<ArmsJournal>(file, kForm, own_from);
}

}  // namespace stepwright::tamp::mission
