#include "supervisor/fleet/vda5050/stitching.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/supervisor/fleet/vda5050/sample_messages.h"

namespace stepwright::fleet::vda5050 {
namespace {

// Node 2 on, of which all is released now.
Order update_of(const Order& order) {
  Order update = order;
  update.update_id = 1;
  update.nodes.erase(update.nodes.begin());
  update.edges.erase(update.edges.begin());
  update.nodes.back().released = true;
  update.edges.back().released = true;
  return update;
}

TEST(Stitching, Update_WhenItContinuesTheBase_ThenNothingIsWrongAndTheVehicleHasBoth) {
  const Order held = sample_order(), update = update_of(held);
  EXPECT_EQ(to_string(check_update(held, update, "u")), "");
  Order expected = held;
  expected.update_id = 1;
  expected.nodes[2].released = true;
  expected.edges[1].released = true;
  EXPECT_EQ(stitched(held, update), expected);
}

TEST(Stitching, Update_WhenTheHorizonIsDeletedOrOther_ThenNothingIsWrong) {
  const Order held = sample_order();
  Order update = update_of(held);
  update.nodes[1].id = "o1.r1.n4";
  update.edges[0].end_node = "o1.r1.n4";
  EXPECT_EQ(to_string(check_update(held, update, "u")), "");
  update.nodes.pop_back();
  update.edges.pop_back();
  EXPECT_EQ(to_string(check_update(held, update, "u")), "");
  EXPECT_EQ(stitched(held, update).nodes.size(), 2u);
}

TEST(Stitching, Update_WhenItDoesNotContinueTheBase_ThenSaidWhere) {
  const Order held = sample_order();
  const auto first_fault = [&](const std::function<void(Order&)>& change) {
    Order update = update_of(held);
    change(update);
    const auto wrong = check_update(held, update, "u");
    return wrong.empty() ? std::string() : wrong.front().code + " " + wrong.front().message;
  };
  EXPECT_EQ(first_fault([](Order& u) { u.order_id = "o2"; }),
            "F0905 /orderId: is not that of the order 'o1'");
  EXPECT_EQ(first_fault([](Order& u) { u.update_id = 0; }), "F0905 /orderUpdateId: 0 does not follow 0");
  EXPECT_EQ(first_fault([](Order& u) { u.nodes[0].id = "o1.n0"; }), "F0905 /nodes/0/nodeId: is not 'o1.n2'");
  EXPECT_EQ(first_fault([](Order& u) { u.nodes[0].sequence = 4; }), "F0905 /nodes/0/sequenceId: is not 2");
  EXPECT_EQ(first_fault([](Order& u) { u.nodes[0].released = false; }),
            "F0905 /nodes/0/released: takes back a node of the base");
  EXPECT_EQ(first_fault([](Order& u) { u.nodes[0].position->x_m += 0.5; }),
            "F0905 /nodes/0/nodePosition: has changed");
  EXPECT_EQ(first_fault([](Order& u) { u.nodes[0].actions.clear(); }),
            "F0905 /nodes/0/actions: have changed");
  EXPECT_EQ(first_fault([](Order& u) {
              u.edges[0].actions = {{"beep", "o1.e1.a0", Blocking::None, {}}};
            }),
            "F0905 /edges/0/actions/0/actionId: 'o1.e1.a0' is an action of the base already");
}

}  // namespace
}  // namespace stepwright::fleet::vda5050
