#include "supervisor/ltl/route/route_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "supervisor/ltl/guide/task.h"
#include "tests/unit/supervisor/ltl/regions/floors.h"

namespace stepwright::ltl {
namespace {

using geometry::Point;

constexpr double kNever = std::numeric_limits<double>::infinity();

// A random floor, its graph and tasks of its places.
struct Setting {
  explicit Setting(std::uint32_t seed)
      : floor(testing::random_squares(seed).floor()),
        map(make_regions(floor).value()),
        places(floor.propositions),
        walls(floor, {.length_m = 0.4, .width_m = 0.2}),
        graph(floor, places, walls, {.margin_m = 0.2, .wanted_m = 0.6}) {
    for (const Area& each : floor.propositions) names.push_back(each.name);
  }
  std::vector<std::string> tasks() const {
    if (names.empty()) return {};
    std::vector<std::string> found = {"visit " + names[0]};
    if (names.size() > 1) {
      found.push_back("visit " + names[1] + " then visit " + names[0]);
      found.push_back("!" + names[0] + " U " + names[1]);
    }
    if (names.size() > 2)
      found.push_back("visit " + names[0] + ", visit " + names[1] + ", visit " + names[2]);
    return found;
  }

  Floor floor;
  RegionMap map;
  Places places;
  Walls walls;
  RouteGraph graph;
  std::vector<std::string> names;
};

// Reads a word letter by letter; nothing where it breaks the task.
std::optional<std::uint32_t> after(const Automaton& automaton, std::uint32_t state,
                                   const std::vector<Label>& word) {
  for (const Label letter : word) {
    if (automaton.accepting(state)) return state;
    state = automaton.next(state, letter);
    if (automaton.rejecting(state)) return std::nullopt;
  }
  return state;
}

// The cost of the best way, by rounds over all ways of all points and states until none is better.
double slowly_m(const RouteGraph& graph, const Automaton& automaton, Point at, std::uint32_t start) {
  if (automaton.accepting(start)) return 0.0;
  const std::size_t states = automaton.size();
  std::vector<double> cost_m(graph.points().size() * states, kNever);
  RouteGraph::Words own;
  for (std::uint32_t k = 0; k < graph.points().size(); ++k) {
    const auto way = graph.way(at, graph.points()[k], own);
    if (!way) continue;
    if (const auto state = after(automaton, start, own.all[way->word]))
      cost_m[k * states + *state] = way->cost_m;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t k = 0; k < graph.points().size(); ++k) {
      for (std::uint32_t state = 0; state < states; ++state) {
        const double here_m = cost_m[k * states + state];
        if (here_m == kNever || automaton.accepting(state)) continue;
        for (const auto& way : graph.ways(k)) {
          const auto next = after(automaton, state, graph.word(way.word));
          if (!next || here_m + way.cost_m >= cost_m[way.to * states + *next]) continue;
          cost_m[way.to * states + *next] = here_m + way.cost_m;
          changed = true;
        }
      }
    }
  }
  double least = kNever;
  for (std::size_t k = 0; k < cost_m.size(); ++k)
    if (automaton.accepting(static_cast<std::uint32_t>(k % states))) least = std::min(least, cost_m[k]);
  return least;
}

// The graph's way between two of its points, or from the start.
std::optional<RouteGraph::Way> way_of(const RouteGraph& graph, Point from, Point to,
                                      RouteGraph::Words& words) {
  const auto known = std::ranges::find(graph.points(), from);
  if (known == graph.points().end()) return graph.way(from, to, words);
  for (const auto& way : graph.ways(static_cast<std::uint32_t>(known - graph.points().begin())))
    if (graph.points()[way.to] == to) return way;
  return std::nullopt;
}

// The route's cost, after a look at whether it is one: its ways exist, its states are those that they read.
double cost_of(const Setting& setting, const Automaton& automaton, const Route& route) {
  if (route.empty()) return kNever;
  double cost = 0.0;
  RouteGraph::Words words = setting.graph.all_words();
  for (std::size_t k = 0; k + 1 < route.size(); ++k) {
    const auto way = way_of(setting.graph, route[k].at, route[k + 1].at, words);
    if (!way) return -1.0;
    const auto state = after(automaton, route[k].state, words.all[way->word]);
    EXPECT_TRUE(state && *state == route[k + 1].state);
    const auto& through = route[k + 1].through;
    EXPECT_EQ(through.empty() ? route[k].state : through.back(), route[k + 1].state);
    cost += way->cost_m;
  }
  EXPECT_TRUE(automaton.accepting(route.back().state));
  return cost;
}

// Visits each random floor, start and task.
void each_question(std::uint32_t seeds,
                   const std::function<void(Setting&, const Task&, Point, std::uint32_t)>& ask) {
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    Setting setting(seed);
    for (const Point at : {Point{0.9, 0.9}, Point{10.3, 9.7}, Point{18.2, 4.4}}) {
      if (setting.map.locate(at) == kNoRegion) continue;
      for (const std::string& text : setting.tasks()) {
        const auto task = read_task(text, setting.names);
        const Automaton& automaton = task->automaton;
        const std::uint32_t state = automaton.next(automaton.initial, setting.places.label(at));
        if (!automaton.rejecting(state)) ask(setting, *task, at, state);
      }
    }
  }
}

TEST(RouteSearch, WhenTurnsCostNothing_ThenRoutesAreAsCheapAsASlowSearchFinds) {
  int found = 0;
  each_question(25, [&](Setting& setting, const Task& task, Point at, std::uint32_t state) {
    RouteSearch search(setting.graph, TaskStates(task.automaton));
    const Route route = search.route({.at = at, .state = state, .turn_m = 0.0, .close_m = 0.0});
    const double expected = slowly_m(setting.graph, task.automaton, at, state);
    const double cost = cost_of(setting, task.automaton, route);
    EXPECT_EQ(route.empty(), expected == kNever);
    if (route.empty()) return;
    EXPECT_NEAR(cost, expected, 1e-6);
    ++found;
  });
  EXPECT_GT(found, 60);
}

TEST(RouteSearch, WhenThereIsNoWay_ThenTheRouteIsEmpty) {
  Setting setting(1);
  setting.floor.obstacles = {testing::Rectangle{10, 0, 11, 20}.area("wall")};
  setting.floor.propositions = {testing::Rectangle{15, 5, 17, 7}.area("east"),
                                testing::Rectangle{2, 5, 4, 7}.area("west")};
  const Places places(setting.floor.propositions);
  const Walls walls(setting.floor, {});
  const RouteGraph graph(setting.floor, places, walls, {});
  for (const auto& [text, points] :
       {std::pair{"visit east", false}, {"visit west", true}, {"!west U east", false}}) {
    const auto task = read_task(text, {"east", "west"});
    RouteSearch search(graph, TaskStates(task->automaton));
    EXPECT_EQ(!search.route({.at = {7, 10}, .state = task->automaton.initial}).empty(), points) << text;
  }
}

TEST(RouteSearch, WhenAGuideLeads_ThenRoutesAreFoundWithFewerLooks) {
  std::size_t plain = 0, guided = 0;
  double plain_m = 0.0, guided_m = 0.0;
  each_question(25, [&](Setting& setting, const Task& task, Point at, std::uint32_t state) {
    const Guide guide(setting.map, task.automaton);
    RouteSearch one(setting.graph, TaskStates(task.automaton));
    RouteSearch other(setting.graph, TaskStates(task.automaton), {&setting.map, &guide});
    const RouteQuery query{.at = at, .state = state, .turn_m = 0.0, .close_m = 0.0};
    const Route a = one.route(query), b = other.route(query);
    EXPECT_EQ(a.empty(), b.empty());
    plain += one.expanded();
    guided += other.expanded();
    if (a.empty() || b.empty()) return;
    plain_m += cost_of(setting, task.automaton, a);
    guided_m += cost_of(setting, task.automaton, b);
  });
  EXPECT_LT(guided, plain / 2);
  EXPECT_LT(guided_m, 1.1 * plain_m);
}

TEST(RouteSearch, WhenStatesAreThoseOfAProgression_ThenRoutesAreAsCheap) {
  each_question(10, [&](Setting& setting, const Task& task, Point at, std::uint32_t state) {
    RouteSearch table(setting.graph, TaskStates(task.automaton));
    const TaskStates steps(task.formula);
    RouteSearch stepwise(setting.graph, steps);
    const Route a = table.route({.at = at, .state = state, .turn_m = 0.0, .close_m = 0.0});
    const std::uint32_t own = steps.next(steps.start(), setting.places.label(at));
    const Route b = stepwise.route({.at = at, .state = own, .turn_m = 0.0, .close_m = 0.0});
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].at, b[k].at);
  });
}

TEST(RouteSearch, WhenAskedAgainOrWithABound_ThenItAnswersAllTheSame) {
  int asked = 0;
  each_question(10, [&](Setting& setting, const Task& task, Point at, std::uint32_t state) {
    RouteSearch search(setting.graph, TaskStates(task.automaton));
    const RouteQuery query{.at = at, .state = state, .noise = 0.4, .seed = 3};
    const Route first = search.route(query);
    RouteQuery small = query;
    small.most_nodes = 1;
    if (!task.automaton.accepting(state)) {
      EXPECT_TRUE(search.route(small).empty());
      ++asked;
    }
    const Route again = search.route(query);  // rows of states were forgotten in between
    ASSERT_EQ(first.size(), again.size());
    for (std::size_t k = 0; k < first.size(); ++k) EXPECT_EQ(first[k].at, again[k].at);
  });
  EXPECT_GT(asked, 20);
}

TEST(RouteSearch, WhenWhatIsPulledCutsTurns_ThenTheyAreWider) {
  Floor floor;
  floor.border = testing::Rectangle{0, 0, 40, 20}.area("border");
  floor.obstacles = {testing::Rectangle{20, 0, 21, 10}.area("wall")};
  floor.propositions = {testing::Rectangle{28, 1, 31, 4}.area("press")};
  const Places places(floor.propositions);
  const Walls walls(floor, {});
  const RouteGraph graph(floor, places, walls, {.margin_m = 0.4, .wanted_m = 3.0, .weight = 0.0});
  const auto task = read_task("visit press", {"press"});
  RouteSearch search(graph, TaskStates(task->automaton));
  const auto nearest_m = [&](double trail_m) {
    const Route route =
        search.route({.at = {12, 2}, .state = task->automaton.initial, .trail_m = trail_m, .half_m = 0.3});
    EXPECT_GE(route.size(), 3u);
    double least_m = kNever;
    for (std::size_t k = 1; k + 1 < route.size(); ++k)
      least_m = std::min(least_m, geometry::distance(route[k].at, {20.5, 10.0}));
    return least_m;
  };
  EXPECT_LT(nearest_m(0.0), 1.5);
  EXPECT_GT(nearest_m(3.0), 3.0);
}

TEST(RouteSearch, WhenARouteIsTightened_ThenItIsOneStillAndNoLonger) {
  double before_m = 0.0, after_m = 0.0;
  const auto way_m = [](const Route& route) {
    double sum_m = 0.0;
    for (std::size_t k = 1; k < route.size(); ++k) sum_m += geometry::distance(route[k - 1].at, route[k].at);
    return sum_m;
  };
  each_question(8, [&](Setting& setting, const Task& task, Point at, std::uint32_t state) {
    RouteSearch search(setting.graph, TaskStates(task.automaton));
    const Route route = search.route({.at = at, .state = state});
    if (route.size() < 2) return;
    const Route tight = search.tightened(route, 0.2, {});
    EXPECT_EQ(tight.front().at, at);
    EXPECT_GE(cost_of(setting, task.automaton, tight), 0.0) << "its ways and states are real ones";
    EXPECT_LE(way_m(tight), way_m(route) + 1e-9);
    before_m += way_m(route);
    after_m += way_m(tight);
  });
  EXPECT_LT(after_m, 0.98 * before_m);
}

TEST(RouteSearch, WhenTheTaskIsOverAlready_ThenTheRouteIsItsStart) {
  Setting setting(3);
  const auto done = read_task("true", setting.names), failed = read_task("false", setting.names);
  const auto ask = [&](const Automaton& automaton) {
    RouteSearch search(setting.graph, TaskStates(automaton));
    return search.route({.at = {1, 1}, .state = automaton.next(automaton.initial, 0)}).size();
  };
  EXPECT_EQ(ask(done->automaton), 1u);
  EXPECT_EQ(ask(failed->automaton), 0u);
}

}  // namespace
}  // namespace stepwright::ltl
