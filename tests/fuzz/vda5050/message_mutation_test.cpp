// Messages of VDA 5050 and thousands of mutations of them through the readers, and into the orders of a
// fleet.
//
// STEPWRIGHT_FUZZ_CORPUS, if set, names a folder that gets the seeds, for fuzz_vda5050. Longer:
// STEPWRIGHT_FUZZ_SEED=7 STEPWRIGHT_FUZZ_ROUNDS=50000 fuzz_vda5050_mutation.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <random>
#include <span>

#include "supervisor/fleet/vda5050/check_message.h"
#include "supervisor/fleet/vda5050/fleet_orders.h"
#include "supervisor/fleet/vda5050/read_message.h"
#include "supervisor/fleet/vda5050/vehicle_side.h"
#include "supervisor/fleet/vda5050/write_message.h"
#include "tests/fuzz/corpus.h"
#include "tests/fuzz/fault_case.h"
#include "tests/fuzz/vda5050/message_run.h"
#include "tests/support/vda5050/made_missions.h"
#include "tests/support/vda5050/standard_vehicle.h"
#include "tests/unit/supervisor/fleet/vda5050/sample_messages.h"

namespace stepwright::fuzz::vda5050 {
namespace {

using namespace fleet::vda5050;

constexpr std::uint64_t kRoundsPerSeed = 400;
constexpr std::array<const char*, 24> kTokens = {"{",
                                                 "}",
                                                 "[",
                                                 "]",
                                                 ",",
                                                 ":",
                                                 "\"",
                                                 "null",
                                                 "true",
                                                 "-1",
                                                 "1e999",
                                                 "4294967296",
                                                 "0.5",
                                                 "1e-400",
                                                 "\\u0000",
                                                 "\"\\ud800\"",
                                                 "\xff",
                                                 "[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[",
                                                 "\"sequenceId\":2,",
                                                 "\"released\":false,",
                                                 "2",
                                                 "4",
                                                 "\"FINISHED\"",
                                                 "\"2026-11-23T03:50:00Z\""};

std::vector<std::string> seeds() {
  std::vector<std::string> texts;
  for (const Topic topic : kTopics) texts.push_back(sample_message(topic));
  return texts;
}

std::string mutated(std::string text, const std::vector<std::string>& all, std::mt19937& random) {
  const auto below = [&](std::size_t count) { return count == 0 ? 0 : random() % count; };
  for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
    const std::size_t at = below(text.size()), size = below(20);
    switch (below(6)) {
      case 0:
        text.erase(at, size);
        break;
      case 1:
        text.insert(at, kTokens[below(kTokens.size())]);
        break;
      case 2:
        text.replace(at, size, kTokens[below(kTokens.size())]);
        break;
      case 3: {
        const std::string& other = all[below(all.size())];
        text.insert(at, other.substr(below(other.size()), size));
        break;
      }
      case 4:
        // Digits become other numbers, letters other words.
        if (!text.empty())
          text[at] = static_cast<char>(text[at] >= '0' && text[at] <= '9' ? '0' + below(10) : below(256));
        break;
      default:
        if (below(8) == 0) text.resize(at);
        break;
    }
  }
  return text;
}

TEST(Vda5050Mutation, Messages_WhenBroken_ThenAreRefusedOrAreTheSameWrittenAndRead) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(setting("STEPWRIGHT_FUZZ_SEED", 20261123)));
  const std::uint64_t rounds = setting("STEPWRIGHT_FUZZ_ROUNDS", kRoundsPerSeed);
  const std::vector<std::string> all = seeds();
  std::size_t runs = 0, accepted = 0;
  for (std::size_t s = 0; s < all.size(); ++s) {
    ASSERT_GE(run(all[s]).accepted, 1) << s;
    for (std::uint64_t round = 0; round < rounds; ++round) {
      const std::string text = mutated(all[s], all, random);
      name_case("vda5050 seed " + std::to_string(s) + ", round " + std::to_string(round),
                std::as_bytes(std::span(text)));
      const auto done = run(text);
      ++runs;
      accepted += done.accepted > 0 ? 1 : 0;
      ASSERT_EQ(done.finding, "") << "seed " << s << ", round " << round << ", in " << keep_case();
    }
  }
  std::cout << runs << " runs, " << accepted << " accepted\n";
  EXPECT_GT(accepted, runs / 40);  // else only the parser is tested
}

// States of a vehicle in a run, mutated: a base never shrinks, whatever a vehicle says.
TEST(Vda5050Mutation, States_WhenBroken_ThenBasesStayAsTheyWereOrGrow) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(setting("STEPWRIGHT_FUZZ_SEED", 20261123)));
  auto orders = FleetOrders::create(support::random_plan(4, 3), {});
  ASSERT_TRUE(orders.has_value());
  std::vector<std::string> said;
  for (const Order& order : orders->begin({})) {
    support::StandardVehicle vehicle("Stepwright", order.header.serial_number);
    vehicle.take_order(to_json(order));
    while (vehicle.drive()) said.push_back(to_json(vehicle.state({})));
  }
  const auto released = [&] {
    std::vector<std::size_t> bases;
    for (int v = 1; v <= 4; ++v) bases.push_back(*decision_point(*orders->order("v" + std::to_string(v))));
    return bases;
  };
  std::size_t taken = 0;
  for (int round = 0; round < 1500; ++round) {
    const std::string text = mutated(said[random() % said.size()], said, random);
    name_case("vda5050 state, round " + std::to_string(round), std::as_bytes(std::span(text)));
    const auto state = read_state(text, "input");
    if (!state) continue;
    ++taken;
    const auto before = released();
    const Progress progress = orders->take(*state, {});
    const auto after = released();
    for (std::size_t v = 0; v < before.size(); ++v) ASSERT_GE(after[v], before[v]) << keep_case();
    for (const Order& order : progress.orders) ASSERT_EQ(run(to_json(order)).finding, "") << keep_case();
  }
  EXPECT_GT(taken, 100u);
}

// What strangers send to a vehicle: each action is answered, each broken message refused, the order stays,
// and what the vehicle says keeps the rules and its size.
TEST(Vda5050Mutation, Requests_WhenBroken_ThenTheVehicleAnswersOrRefusesAndKeepsItsOrder) {
  std::mt19937 random(static_cast<std::mt19937::result_type>(setting("STEPWRIGHT_FUZZ_SEED", 20261123)));
  auto orders = FleetOrders::create(support::random_plan(2, 3), {});
  ASSERT_TRUE(orders.has_value());
  const Order order = orders->begin({}).front();
  VehicleSide side({"uagv", "Stepwright", order.header.serial_number});
  side.take(order, Sender::Control, {});
  const std::vector<std::string> all = seeds();
  const std::vector<std::string> said = {sample_message(Topic::InstantActions), to_json(order)};
  std::size_t taken = 0;
  for (int round = 0; round < 1000; ++round) {
    const std::string text = mutated(said[random() % said.size()], all, random);
    name_case("vda5050 request, round " + std::to_string(round), std::as_bytes(std::span(text)));
    const auto actions = read_instant_actions(text, "input");
    const auto other = read_order(text, "input");
    if (actions) {
      side.take(*actions, "cancel of master control", {});
    } else if (other) {
      side.take(*other, orders->sent(*other) ? Sender::Control : Sender::Stranger, {});
    } else {
      side.refuse(Topic::InstantActions, actions.error(), {});
    }
    const State state = side.state({});
    ASSERT_EQ(state.order_id, order.order_id) << keep_case();
    ASSERT_EQ(side.order()->nodes, order.nodes) << keep_case();
    ASSERT_LE(state.errors.size(), VehicleSide::kMostRefusals) << keep_case();
    const std::string answer = to_json(state);
    ASSERT_EQ(result::to_string(check_message(Topic::State, answer, "state")), "") << keep_case();
    ASSERT_LT(answer.size(), 256u << 10) << keep_case();
    if (!actions) continue;
    ++taken;
    // Of more than it keeps, the last ones are there.
    const std::size_t kept = std::min(actions->actions.size(), VehicleSide::kMostInstantActions);
    for (std::size_t k = actions->actions.size() - kept; k < actions->actions.size(); ++k) {
      ASSERT_NE(std::ranges::find(state.actions, actions->actions[k].id, &ActionState::id),
                state.actions.end())
          << keep_case();
    }
  }
  EXPECT_GT(taken, 40u);  // of 1000; else only the parser is tested
}

// Where libFuzzer is to find them: STEPWRIGHT_FUZZ_CORPUS.
TEST(Vda5050Mutation, Seeds_WhenWrittenAsACorpus_ThenEachIsAFile) {
  expect_corpus_written(seeds());
}

}  // namespace
}  // namespace stepwright::fuzz::vda5050
