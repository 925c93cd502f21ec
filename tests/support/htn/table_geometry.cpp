#include "tests/support/htn/table_geometry.h"

#include <algorithm>

namespace stepwright::htn::test {

TableGeometry::TableGeometry(const PlanningTask& task, TableLimits limits)
    : task_(task), limits_(std::move(limits)), states_(1) {
  for (const GroundAtom& fact : task.facts) {
    if (task.predicates[static_cast<std::size_t>(fact.symbol)].name != "in") continue;
    const auto names = names_of({fact.symbol, fact.objects});
    states_.back()[names[0]] = names[1];
  }
}

std::vector<std::string> TableGeometry::names_of(const ExternalCall& call) const {
  std::vector<std::string> names;
  for (const int object : call.objects) names.push_back(task_.objects[static_cast<std::size_t>(object)].name);
  return names;
}

void TableGeometry::push(const ExternalCall&) {
  states_.push_back(Places(states_.back()));
}

std::string TableGeometry::refusal_of(const std::string& predicate,
                                      const std::vector<std::string>& names) const {
  const Places& places = states_.back();
  const auto reaches = [&](const std::string& place) { return limits_.reach.at(names[0]).contains(place); };
  if (predicate == "can-move-pick" && !reaches(places.at(names[2])))
    return names[0] + " does not reach " + names[2];
  if (predicate != "can-move-place") return "";
  if (!reaches(names[1])) return names[0] + " does not reach " + names[1];
  const auto room = limits_.room.find(names[1]);
  const auto there =
      std::ranges::count_if(places, [&](const auto& thing) { return thing.second == names[1]; });
  return room != limits_.room.end() && there >= room->second ? "no room in " + names[1] : "";
}

std::optional<Refusal> TableGeometry::require(const ExternalCall& atom, bool wanted) {
  const std::string reason =
      refusal_of(task_.predicates[static_cast<std::size_t>(atom.symbol)].name, names_of(atom));
  if (reason.empty() == wanted) return std::nullopt;
  return Refusal{depth(), true, reason};
}

std::optional<Refusal> TableGeometry::change(const ExternalCall& atom, bool) {
  const auto names = names_of(atom);
  const std::string& predicate = task_.predicates[static_cast<std::size_t>(atom.symbol)].name;
  if (predicate == "is-picked") states_.back()[names[2]] = names[0];
  if (predicate == "is-placed") states_.back()[names[2]] = names[1];
  return std::nullopt;
}

std::optional<Fingerprint> TableGeometry::fingerprint() const {
  Fingerprint print;
  for (const auto& [thing, place] : states_.back())
    for (const char c : thing + "@" + place + ",") print = followed_by(print, static_cast<unsigned char>(c));
  return print;
}

}  // namespace stepwright::htn::test
