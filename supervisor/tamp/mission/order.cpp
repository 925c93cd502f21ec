#include "supervisor/tamp/mission/order.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "supervisor/lisp/token_stream.h"

namespace stepwright::tamp::mission {
namespace {

using lisp::TokenKind;

constexpr double kSeen_m = 0.005;
constexpr const char* kElsewhere = "elsewhere";  // where nothing is put
constexpr const char* kExample = "(in cup1 red-region), or (and (in can1 tray) (in can2 tray))";
constexpr std::size_t kMostWanted = 64;

class OrderReader {
 public:
  OrderReader(const scene::RobotCell& cell, lisp::TokenStream& tokens) : cell_(cell), tokens_(tokens) {}

  bool read(std::vector<Wanted>& wanted) {
    if (!tokens_.expect(TokenKind::Open, "'('")) return false;
    std::string word;
    lisp::Place place;
    if (!tokens_.expect_name("'in' or 'and'", word, place)) return false;
    if (word == "in") return read_in(wanted) && tokens_.expect(TokenKind::End, "the end of the goal");
    if (word != "and") return refuse(place, "a goal begins with 'in' or 'and'");
    while (tokens_.accept(TokenKind::Open)) {
      if (!tokens_.expect_name("'in'", word, place)) return false;
      if (word != "in") return refuse(place, "'" + word + "' is nothing that can be wanted of things");
      if (!read_in(wanted)) return false;
    }
    if (wanted.empty()) return refuse(place, "nothing is wanted");
    return tokens_.expect(TokenKind::Close, "')'") && tokens_.expect(TokenKind::End, "the end of the goal");
  }

 private:
  bool refuse(lisp::Place place, std::string why) {
    tokens_.reporter().error("G0401", place, std::move(why), kExample);
    return false;
  }

  bool read_in(std::vector<Wanted>& wanted) {
    std::string thing, where;
    lisp::Place thing_at, where_at;
    if (!tokens_.expect_name("a thing", thing, thing_at) ||
        !tokens_.expect_name("a place", where, where_at) || !tokens_.expect(TokenKind::Close, "')'"))
      return false;
    Wanted each{cell_.thing(thing), cell_.surface(where), -1};
    if (each.thing < 0) return refuse(thing_at, "the cell has no thing '" + thing + "'");
    if (each.surface < 0) each.on = cell_.thing(where);
    if (each.surface < 0 && each.on < 0) return refuse(where_at, "the cell has no region '" + where + "'");
    if (each.on >= 0 && !cell_.things[at(each.on)].carries)
      return refuse(where_at, "nothing can be put on '" + where + "'");
    if (each.on == each.thing) return refuse(where_at, "nothing stands on itself");
    if (std::ranges::find(wanted, each.thing, &Wanted::thing) != wanted.end())
      return refuse(thing_at, "'" + thing + "' is wanted in two places");
    if (wanted.size() == kMostWanted) return refuse(thing_at, "more than 64 things are wanted");
    wanted.push_back(each);
    return true;
  }

  const scene::RobotCell& cell_;
  lisp::TokenStream& tokens_;
};

bool is_name(const std::string& text) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !text.empty() && text.front() >= 'a' && text.front() <= 'z' && std::ranges::all_of(text, good);
}

// Where the thing is, as one fact: in the region that is wanted for it, on a thing, or in the smallest region
// that it lies in.
std::string place_of(const scene::RobotCell& cell, const ArmsOrder& order, const scene::GeometricState& state,
                     std::size_t thing) {
  const auto wanted = std::ranges::find(order.wanted, static_cast<int>(thing), &Wanted::thing);
  if (wanted != order.wanted.end() && is_met(cell, state, *wanted))
    return wanted->surface >= 0 ? cell.surfaces[at(wanted->surface)].name : cell.things[at(wanted->on)].name;
  for (std::size_t on = 0; on < cell.things.size(); ++on)
    if (on != thing && cell.things[on].carries &&
        is_met(cell, state, {static_cast<int>(thing), -1, static_cast<int>(on)}))
      return cell.things[on].name;
  std::string found = kElsewhere;
  double least_m2 = 1e9;
  for (std::size_t k = 0; k < cell.surfaces.size(); ++k) {
    const scene::Surface& each = cell.surfaces[k];
    const double size_m2 = each.size_x_m * each.size_y_m;
    // What stands in the region that it is wanted in, but not well, is somewhere else.
    const bool own = wanted != order.wanted.end() && wanted->surface == static_cast<int>(k);
    if (own || size_m2 >= least_m2 ||
        !is_met(cell, state, {static_cast<int>(thing), static_cast<int>(k), -1}))
      continue;
    least_m2 = size_m2;
    found = each.name;
  }
  return found;
}

}  // namespace

result::Result<ArmsOrder> read_order(const scene::RobotCell& cell, const std::string& name,
                                     const std::string& goal, const std::string& file) {
  lisp::Reporter reporter({file});
  lisp::TokenStream tokens(lisp::tokens_of(goal, 0, reporter), reporter);
  ArmsOrder order{name, goal, {}};
  OrderReader(cell, tokens).read(order.wanted);
  if (reporter.failed()) return tl::unexpected(reporter.take());
  return order;
}

result::Result<void> check_names(const scene::RobotCell& cell) {
  std::vector<std::string> names;
  for (const auto& each : cell.arms) names.push_back(each.name);
  for (const auto& each : cell.surfaces) names.push_back(each.name);
  for (const auto& each : cell.things) names.push_back(each.name);
  for (const std::string& each : names)
    if (!is_name(each) || each == kElsewhere)
      return result::fail("G0402", {}, "'" + each + "' is no name for arms, regions and things of orders",
                          "small letters, digits, - and _; a letter first");
  return {};
}

std::string text_of(const scene::RobotCell& cell, const Wanted& wanted) {
  const std::string& thing = cell.things[at(wanted.thing)].name;
  return wanted.surface >= 0 ? thing + " in " + cell.surfaces[at(wanted.surface)].name
                             : thing + " on " + cell.things[at(wanted.on)].name;
}

bool is_met(const scene::RobotCell& cell, const scene::GeometricState& state, const Wanted& wanted) {
  const scene::ThingState& thing = state.things[at(wanted.thing)];
  if (thing.holder >= 0) return false;
  const scene::Form& form = cell.things[at(wanted.thing)].form;
  if (wanted.surface >= 0) {
    const scene::Surface& surface = cell.surfaces[at(wanted.surface)];
    return std::abs(thing.pose.z_m - surface.middle.z_m) <= kSeen_m &&
           lies_within(surface, form, thing.pose, kSeen_m);
  }
  const scene::ThingState& below = state.things[at(wanted.on)];
  const double top_m = below.pose.z_m + cell.things[at(wanted.on)].form.height_m;
  return below.holder < 0 && std::abs(thing.pose.z_m - top_m) <= kSeen_m &&
         std::hypot(thing.pose.x_m - below.pose.x_m, thing.pose.y_m - below.pose.y_m) <=
             radius_around(cell.things[at(wanted.on)].form);
}

std::string not_yet(const scene::RobotCell& cell, const scene::GeometricState& state,
                    const ArmsOrder& order) {
  for (const Wanted& each : order.wanted)
    if (!is_met(cell, state, each)) return text_of(cell, each);
  return {};
}

std::string problem_text(const scene::RobotCell& cell, const ArmsOrder& order,
                         const scene::GeometricState& state, const std::vector<int>* exchange) {
  std::string arms, things, places = kElsewhere, init, goal;
  for (const auto& each : cell.arms) {
    arms += each.name + " ";
    init += " (empty " + each.name + ")";
  }
  const auto moves = [&](std::size_t thing) {
    return exchange == nullptr || std::ranges::any_of(order.wanted, [&](const Wanted& each) {
             return at(each.thing) == thing || (each.on >= 0 && at(each.on) == thing);
           });
  };
  const auto goes = [&](int surface) {
    return exchange == nullptr || exchange->empty() ||
           std::ranges::find(*exchange, surface) != exchange->end() ||
           std::ranges::find(order.wanted, surface, &Wanted::surface) != order.wanted.end();
  };
  for (int k = 0; k < static_cast<int>(cell.surfaces.size()); ++k)
    if (goes(k)) places += " " + cell.surfaces[at(k)].name;
  for (std::size_t k = 0; k < cell.things.size(); ++k) {
    if (!moves(k)) continue;
    // What stands in a region or on a thing that is left out stands elsewhere.
    std::string place = place_of(cell, order, state, k);
    const int surface = cell.surface(place), on = cell.thing(place);
    if ((surface >= 0 && !goes(surface)) || (on >= 0 && !moves(at(on)))) place = kElsewhere;
    things += cell.things[k].name + " ";
    init += " (in " + cell.things[k].name + " " + place + ")";
  }
  for (const Wanted& each : order.wanted)
    goal += " (in " + cell.things[at(each.thing)].name + " " +
            (each.surface >= 0 ? cell.surfaces[at(each.surface)].name : cell.things[at(each.on)].name) + ")";
  return "(define (problem order)\n  (:domain stacking-arms)\n  (:objects " + arms + "- arm top - grasp " +
         things + "- thing " + places + " - place)\n  (:init" + init + ")\n  (:goal (and" + goal + ")))\n";
}

}  // namespace stepwright::tamp::mission
