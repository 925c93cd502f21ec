#include "supervisor/htn/task/declarations.h"

#include <algorithm>

#include "supervisor/lisp/name_hints.h"

namespace stepwright::htn {
namespace {

constexpr std::size_t kMostTypes = 1000;
constexpr std::size_t kMostObjects = 50'000;

const std::vector<std::string> kRequirements = {":strips",
                                                ":typing",
                                                ":hierarchy",
                                                ":htn",
                                                ":method-preconditions",
                                                ":methods-preconditions",
                                                ":negative-preconditions",
                                                ":disjunctive-preconditions",
                                                ":equality",
                                                ":existential-preconditions",
                                                ":universal-preconditions",
                                                ":quantified-preconditions",
                                                ":conditional-effects",
                                                ":adl",
                                                ":action-costs",
                                                ":numeric-fluents"};

// Objects are of declared types.
bool is_of(const std::vector<int>& types, const std::vector<bool>& below) {
  return std::ranges::any_of(types, [&](int type) { return below[static_cast<std::size_t>(type)]; });
}

}  // namespace

void Declarations::requirements(const std::vector<lisp::RequirementFlag>& flags) {
  for (const lisp::RequirementFlag& flag : flags) {
    if (std::ranges::find(kRequirements, flag.name) != kRequirements.end()) continue;
    reporter_.warning("P0112", flag.at, "the requirement '" + flag.name + "' is not known here",
                      lisp::did_you_mean(flag.name, kRequirements));
  }
}

void Declarations::repeated(const std::string& what, const std::string& name, Place at) {
  reporter_.error("P0108", at, "the " + what + " '" + name + "' is declared twice");
}

// A supertype that is used and nowhere declared is taken as declared: many published domains do so.
bool Declarations::types(const std::vector<TypedName>& list) {
  task_.types.push_back({"object", {}, {}});
  names_.types.emplace("object", 0);
  std::vector<Place> places(1);
  const auto declare = [&](const std::string& name, Place at) {
    const auto [known, added] = names_.types.emplace(name, static_cast<int>(task_.types.size()));
    if (added) {
      task_.types.push_back({name, {}, {}});
      places.push_back(at);
    }
    return known->second;
  };
  for (const TypedName& type : list) {
    if (names_.types.contains(type.name) && type.name != "object")
      reporter_.warning("P0108", type.at, "the type '" + type.name + "' is declared twice",
                        "it has the supertypes of both declarations");
    declare(type.name, type.at);
  }
  std::vector<std::vector<int>> parents(task_.types.size());
  for (const TypedName& type : list) {
    if (type.name == "object") continue;
    std::vector<std::string> above = type.either;
    if (above.empty()) above.push_back(type.type_name);
    for (const std::string& name : above) {
      const int parent = declare(name, type.type_at);
      parents.resize(task_.types.size());
      parents[static_cast<std::size_t>(names_.types.at(type.name))].push_back(parent);
    }
  }
  if (task_.types.size() > kMostTypes) {
    reporter_.error("P0606", list.back().at, "there are more than " + std::to_string(kMostTypes) + " types");
    return false;
  }
  close_types(parents, places);
  return true;
}

void Declarations::close_types(const std::vector<std::vector<int>>& parents,
                               const std::vector<Place>& places) {
  const std::size_t count = task_.types.size();
  for (Type& type : task_.types) type.below.assign(count, false);
  for (std::size_t type = 0; type < count; ++type) {
    std::vector<int> line{static_cast<int>(type)};  // the type and its ancestors
    task_.types[type].below[type] = true;
    bool circle = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      for (const int parent : parents[static_cast<std::size_t>(line[i])]) {
        circle = circle || parent == static_cast<int>(type);
        std::vector<bool>& below = task_.types[static_cast<std::size_t>(parent)].below;
        if (!below[type]) line.push_back(parent);
        below[type] = true;
      }
    }
    task_.types[0].below[type] = true;
    if (circle)
      reporter_.error("P0109", places[type], "the type '" + task_.types[type].name + "' is its own ancestor");
  }
}

int Declarations::declared_type(const std::string& name, Place at) {
  const auto found = names_.types.find(name);
  if (found != names_.types.end()) return found->second;
  std::vector<std::string> known = lisp::names_of(names_.types);
  std::erase_if(known, [](const std::string& each) { return each.front() == '('; });
  reporter_.error("P0101", at, "unknown type '" + name + "'",
                  reporter_.full() ? "" : lisp::did_you_mean(name, known));
  return 0;
}

int Declarations::type(const TypedName& typed) {
  if (typed.either.empty()) return declared_type(typed.type_name, typed.type_at);
  const auto found = names_.types.find(typed.type_name);
  if (found != names_.types.end()) return found->second;
  Type either{typed.type_name, std::vector<bool>(task_.types[0].below.size(), false), {}};
  for (const std::string& name : typed.either) {
    const std::vector<bool>& below =
        task_.types[static_cast<std::size_t>(declared_type(name, typed.type_at))].below;
    for (std::size_t i = 0; i < below.size(); ++i)
      if (below[i]) either.below[i] = true;
  }
  for (std::size_t object = 0; object < task_.objects.size(); ++object)
    if (is_of(task_.objects[object].types, either.below)) either.objects.push_back(static_cast<int>(object));
  const int id = static_cast<int>(task_.types.size());
  if (task_.types.size() >= 2 * kMostTypes) {
    reporter_.error("P0606", typed.type_at, "there are too many types of the form '(either ...)'");
    return 0;
  }
  task_.types.push_back(std::move(either));
  names_.types.emplace(typed.type_name, id);
  return id;
}

std::vector<int> Declarations::types_of(const std::vector<TypedName>& parameters) {
  std::vector<int> types;
  for (const TypedName& parameter : parameters) types.push_back(type(parameter));
  return types;
}

// Constants are repeated among the objects of many problems.
void Declarations::add_objects(const std::vector<TypedName>& list) {
  for (const TypedName& object : list) {
    std::vector<int> types;
    if (object.either.empty()) types.push_back(declared_type(object.type_name, object.type_at));
    for (const std::string& name : object.either) types.push_back(declared_type(name, object.type_at));
    const auto [known, added] = names_.objects.emplace(object.name, static_cast<int>(task_.objects.size()));
    if (added) {
      task_.objects.push_back({object.name, std::move(types)});
    } else if (task_.objects[static_cast<std::size_t>(known->second)].types == types) {
      reporter_.warning("P0108", object.at, "the object '" + object.name + "' is declared twice",
                        "once is enough");
    } else {
      repeated("object", object.name, object.at);
    }
  }
}

bool Declarations::objects(const std::vector<TypedName>& constants, const std::vector<TypedName>& objects) {
  if (constants.size() + objects.size() > kMostObjects) {
    reporter_.error("P0606", (objects.empty() ? constants : objects).back().at,
                    "there are more than " + std::to_string(kMostObjects) + " objects");
    return false;
  }
  add_objects(constants);
  add_objects(objects);
  for (Type& type : task_.types)
    for (std::size_t object = 0; object < task_.objects.size(); ++object)
      if (is_of(task_.objects[object].types, type.below)) type.objects.push_back(static_cast<int>(object));
  return true;
}

void Declarations::symbols(const std::vector<ParsedSymbol>& parsed, std::vector<Symbol>& table,
                           std::map<std::string, int>& ids, const std::string& what) {
  for (const ParsedSymbol& symbol : parsed) {
    std::vector<int> types = types_of(symbol.parameters);
    const auto [known, added] = ids.emplace(symbol.name, static_cast<int>(table.size()));
    if (added) {
      table.push_back({symbol.name, std::move(types), false, false});
    } else if (table[static_cast<std::size_t>(known->second)].parameter_types == types) {
      reporter_.warning("P0108", symbol.at, "the " + what + " '" + symbol.name + "' is declared twice",
                        "once is enough");
    } else {
      repeated(what, symbol.name, symbol.at);
    }
  }
}

}  // namespace stepwright::htn
