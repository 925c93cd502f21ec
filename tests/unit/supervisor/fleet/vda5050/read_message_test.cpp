#include "supervisor/fleet/vda5050/read_message.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "supervisor/fleet/vda5050/write_message.h"
#include "tests/unit/supervisor/fleet/vda5050/sample_messages.h"

namespace stepwright::fleet::vda5050 {
namespace {

using nlohmann::json;

TEST(ReadMessage, Order_WhenWrittenAndRead_ThenTheSame) {
  const auto order = read_order(to_json(sample_order()), "order");
  ASSERT_TRUE(order.has_value()) << to_string(order.error());
  EXPECT_EQ(*order, sample_order());
}

TEST(ReadMessage, State_WhenWrittenAndRead_ThenTheSame) {
  const auto state = read_state(to_json(sample_state()), "state");
  ASSERT_TRUE(state.has_value()) << to_string(state.error());
  EXPECT_EQ(*state, sample_state());
}

TEST(ReadMessage, State_WhenOptionalMembersAreMissing_ThenNothingOfThem) {
  json root = json::parse(sample_message(Topic::State));
  for (const char* name : {"agvPosition", "velocity", "loads", "paused", "newBaseRequest"}) root.erase(name);
  const auto state = read_state(root.dump(), "state");
  ASSERT_TRUE(state.has_value()) << to_string(state.error());
  EXPECT_FALSE(state->position.has_value());
  EXPECT_FALSE(state->velocity.has_value());
  EXPECT_FALSE(state->loads.has_value());
  EXPECT_FALSE(state->new_base_request);
}

TEST(ReadMessage, Numbers_WhenWholeOnesHaveAFraction_ThenTheyCount) {
  json root = json::parse(sample_message(Topic::State));
  root["orderUpdateId"] = 4.0;
  root["headerId"] = 4294967295.0;
  const auto state = read_state(root.dump(), "state");
  ASSERT_TRUE(state.has_value()) << to_string(state.error());
  EXPECT_EQ(state->update_id, 4u);
  EXPECT_EQ(state->header.header_id, 4294967295u);
}

TEST(ReadMessage, ConnectionAndInstantActions_WhenWrittenAndRead_ThenTheSame) {
  const auto connection = read_connection(sample_message(Topic::Connection), "connection");
  ASSERT_TRUE(connection.has_value());
  EXPECT_EQ(connection->state, ConnectionState::Broken);
  const auto actions = read_instant_actions(sample_message(Topic::InstantActions), "instantActions");
  ASSERT_TRUE(actions.has_value());
  EXPECT_EQ(to_json(*actions), sample_message(Topic::InstantActions));
}

TEST(ReadMessage, State_WhenItBreaksARule_ThenItIsNoState) {
  json root = json::parse(sample_message(Topic::State));
  root.erase("orderId");
  root["driving"] = 1;
  const auto state = read_state(root.dump(), "uagv/v2/Stepwright/v1/state");
  ASSERT_FALSE(state.has_value());
  EXPECT_EQ(to_string(state.error()),
            "uagv/v2/Stepwright/v1/state: F0902: the message: lacks 'orderId'\n"
            "uagv/v2/Stepwright/v1/state: F0902: /driving: is no true or false");
}

}  // namespace
}  // namespace stepwright::fleet::vda5050
