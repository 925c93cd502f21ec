#include "supervisor/tamp/predicates/names.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "supervisor/lisp/name_hints.h"
#include "supervisor/tamp/predicates/name_places.h"
#include "supervisor/tamp/scene/starts.h"

namespace stepwright::tamp::predicates {

namespace {

// A predicate that says where a thing is: the places of thing and place among its terms.
struct PlacePredicate {
  int predicate = 0;
  std::size_t thing = 0, place = 0;
};

class NameCheck {
 public:
  NameCheck(const htn::PlanningTask& task, const scene::RobotCell& cell, const lisp::Source& domain,
            const lisp::Source& problem)
      : task_(task), cell_(cell), places_(domain, problem) {}

  result::Result<void> check() {
    const std::vector<bool> used = used_objects();
    for (std::size_t k = 0; k < task_.objects.size(); ++k) check_object(static_cast<int>(k), used[k]);
    if (wrong_.empty())
      for (const PlacePredicate& each : place_predicates()) check_facts(each);
    if (!wrong_.empty()) return tl::unexpected(std::move(wrong_));
    return {};
  }

 private:
  // Whether geometry may be asked about it as this parameter: the `at`-th, or the last.
  bool is_asked(int object, const char* predicate, std::size_t at, bool last) const {
    for (const htn::Symbol& each : task_.predicates) {
      if (!each.external || each.name != predicate || each.parameter_types.size() <= at) continue;
      const int type = last ? each.parameter_types.back() : each.parameter_types[at];
      if (type != 0 && task_.is_of_type(object, type)) return true;
    }
    return false;
  }

  // Of what is to be done.
  std::vector<bool> used_objects() const {
    std::vector<bool> used(task_.objects.size(), false);
    const auto use = [&](const std::vector<htn::Term>& terms) {
      for (const htn::Term term : terms)
        if (term < 0) used[static_cast<std::size_t>(~term)] = true;
    };
    for (const htn::Subtask& each : task_.methods[task_.root].subtasks) use(each.terms);
    for (const htn::ExternalLiteral& each : task_.external_goals) use(each.terms);
    std::vector<const htn::Condition*> open{&task_.goal};
    while (!open.empty()) {
      const htn::Condition* const next = open.back();
      open.pop_back();
      use(next->terms);
      for (const htn::Condition& part : next->parts) open.push_back(&part);
    }
    return used;
  }

  void check_object(int object, bool used) {
    const std::string& name = task_.objects[static_cast<std::size_t>(object)].name;
    const bool thing =
        is_asked(object, "can-move-pick", 0, true) || is_asked(object, "can-move-place", 0, true);
    if (is_asked(object, "can-move-pick", 0, false)) {
      if (cell_.arm(name) < 0) missing(name, "arm", names_of(cell_.arms));
    } else if (thing) {
      if (cell_.thing(name) < 0) missing(name, "thing", names_of(cell_.things));
    } else if (used && is_asked(object, "can-move-place", 1, false) && cell_.surface(name) < 0 &&
               cell_.thing(name) < 0) {
      missing(name, "region or thing", names_of(cell_.surfaces));
    }
  }

  void missing(const std::string& name, const char* what, const std::vector<std::string>& known) {
    complain("G0104", places_.of(name), std::string("the cell has no ") + what + " '" + name + "'",
             lisp::did_you_mean(name, known));
  }

  void complain(const char* code, result::Location at, std::string message, std::string hint) {
    wrong_.push_back({code, result::Severity::Error, std::move(at), std::move(message), std::move(hint)});
  }

  // What actions that place a thing add about just the thing and its place.
  std::vector<PlacePredicate> place_predicates() const {
    std::vector<PlacePredicate> found;
    for (const htn::Action& action : task_.actions)
      for (const htn::ExternalLiteral& placed : action.external_effects) {
        if (!placed.positive || placed.terms.size() != 3 ||
            task_.predicates[static_cast<std::size_t>(placed.predicate)].name != "is-placed")
          continue;
        for (const htn::Effect& each : action.effects) {
          if (!each.add || each.terms.size() != 2 || !each.variables.empty()) continue;
          if (each.terms[0] == placed.terms[2] && each.terms[1] == placed.terms[1])
            found.push_back({each.predicate, 0, 1});
          if (each.terms[0] == placed.terms[1] && each.terms[1] == placed.terms[2])
            found.push_back({each.predicate, 1, 0});
        }
      }
    return found;
  }

  void check_facts(const PlacePredicate& about) {
    for (const htn::GroundAtom& fact : task_.facts) {
      if (fact.symbol != about.predicate || fact.objects.size() != 2) continue;
      const auto name = [&](std::size_t k) -> const std::string& {
        return task_.objects[static_cast<std::size_t>(fact.objects[k])].name;
      };
      const std::string &thing = name(about.thing), &place = name(about.place);
      const int number = cell_.thing(thing);
      // A place that the cell does not have may be anywhere.
      if (number < 0 || (cell_.surface(place) < 0 && cell_.thing(place) < 0) ||
          scene::starts_on(cell_, static_cast<std::size_t>(number), place))
        continue;
      complain("G0105",
               places_.of({task_.predicates[static_cast<std::size_t>(fact.symbol)].name, name(0), name(1)}),
               "'" + thing + "' does not stand on '" + place + "' at first",
               "its x_m, y_m and z_m in the cell's file, or this fact");
    }
  }

  const htn::PlanningTask& task_;
  const scene::RobotCell& cell_;
  NamePlaces places_;
  result::Diagnostics wrong_;
};

}  // namespace

result::Result<void> check_names(const htn::PlanningTask& task, const scene::RobotCell& cell,
                                 const lisp::Source& domain, const lisp::Source& problem) {
  return NameCheck(task, cell, domain, problem).check();
}

}  // namespace stepwright::tamp::predicates
