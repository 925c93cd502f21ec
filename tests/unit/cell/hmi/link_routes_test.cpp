#include "cell/hmi/link_routes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace stepwright::hmi {
namespace {

struct Part {
  std::size_t link = 0;
  Corner a, b;  // a is left of or above b
};

std::vector<Part> parts_of(const LinkRoutes& routes) {
  std::vector<Part> parts;
  for (std::size_t i = 0; i < routes.ways.size(); ++i)
    for (std::size_t k = 1; k < routes.ways[i].size(); ++k) {
      Part part{i, routes.ways[i][k - 1], routes.ways[i][k]};
      if (part.b.x < part.a.x || part.b.y < part.a.y) std::swap(part.a, part.b);
      parts.push_back(part);
    }
  return parts;
}

// Two parts that run upon each other for a length.
bool overlap(const Part& one, const Part& other) {
  const bool upright = one.a.x == one.b.x;
  if (upright != (other.a.x == other.b.x)) return false;
  if (upright) return one.a.x == other.a.x && std::min(one.b.y, other.b.y) > std::max(one.a.y, other.a.y);
  return one.a.y == other.a.y && std::min(one.b.x, other.b.x) > std::max(one.a.x, other.a.x);
}

struct Plan {
  components::Layout layout;
  std::vector<components::ModelLink> links;
};

// Boxes in up to six columns with up to five rows, joined at random: forwards, back, to themselves.
Plan random_plan(unsigned seed) {
  std::mt19937 random(seed);
  const auto pick = [&](unsigned count) { return static_cast<std::uint32_t>(random() % count); };
  Plan plan;
  plan.layout.columns = 1 + pick(6);
  for (std::uint32_t column = 0; column < plan.layout.columns; ++column) {
    const std::uint32_t rows = 1 + pick(5);
    plan.layout.rows = std::max(plan.layout.rows, rows);
    for (std::uint32_t row = 0; row < rows; ++row)
      plan.layout.placed.push_back({static_cast<std::uint32_t>(plan.layout.placed.size()), column, row});
  }
  const auto boxes = static_cast<unsigned>(plan.layout.placed.size());
  for (std::uint32_t i = 0; i < 2 * boxes; ++i) plan.links.push_back({pick(boxes), pick(boxes)});
  return plan;
}

LinkRoutes routed(const Plan& plan) {
  return route_links(plan.layout, plan.links,
                     {.box_width = 150.0, .row_height = std::vector<double>(plan.layout.rows, 60.0)});
}

TEST(LinkRoutes, WhenLinksAreRandom_ThenEachLeadsFromItsBoxToItsBox) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Plan plan = random_plan(seed);
    const LinkRoutes routes = routed(plan);
    ASSERT_EQ(routes.ways.size(), plan.links.size());
    for (std::size_t i = 0; i < plan.links.size(); ++i) {
      const components::Placed& from = plan.layout.placed[plan.links[i].from];
      const components::Placed& to = plan.layout.placed[plan.links[i].to];
      const Corner begin = routes.ways[i].front(), end = routes.ways[i].back();
      EXPECT_EQ(begin.x, routes.left[from.column] + 150.0);
      EXPECT_GT(begin.y, routes.top[from.row]);
      EXPECT_LT(begin.y, routes.top[from.row] + routes.height[from.row]);
      EXPECT_EQ(end.x, routes.left[to.column]);
      EXPECT_GT(end.y, routes.top[to.row]);
      EXPECT_LT(end.y, routes.top[to.row] + routes.height[to.row]);
    }
  }
}

TEST(LinkRoutes, WhenLinksAreRandom_ThenNoTwoRunUponEachOther) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<Part> parts = parts_of(routed(random_plan(seed)));
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t k = i + 1; k < parts.size(); ++k)
        EXPECT_FALSE(parts[i].link != parts[k].link && overlap(parts[i], parts[k]))
            << "seed " << seed << ": links " << parts[i].link << " and " << parts[k].link;
  }
}

TEST(LinkRoutes, WhenLinksAreRandom_ThenNoneRunsBehindABoxOrOutOfTheDrawing) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Plan plan = random_plan(seed);
    const LinkRoutes routes = routed(plan);
    for (const Part& part : parts_of(routes)) {
      EXPECT_GE(part.a.x, 0.0);
      EXPECT_LE(part.b.x, routes.width);
      EXPECT_LE(part.b.y, routes.whole);
      for (const components::Placed& box : plan.layout.placed) {
        const double left = routes.left[box.column], top = routes.top[box.row];
        const bool behind = part.b.x > left && part.a.x < left + 150.0 && part.b.y > top &&
                            part.a.y < top + routes.height[box.row];
        EXPECT_FALSE(behind) << "seed " << seed << ": link " << part.link;
      }
    }
  }
}

TEST(LinkRoutes, WhenABoxIsBesideAnother_ThenTheLineIsStraight) {
  Plan plan{{{{0, 0, 0}, {1, 1, 0}}, 2, 1}, {{0, 1}}};
  EXPECT_EQ(routed(plan).ways.front().size(), 2u);
}

}  // namespace
}  // namespace stepwright::hmi
