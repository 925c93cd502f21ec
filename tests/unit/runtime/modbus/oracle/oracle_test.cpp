// The model test: our engine, libmodbus and pymodbus are asked the same on the same tables; every answer and
// every value must be the same, or the difference has a reason in differences.cpp and in
// runtime/doc/modbus_differences.md.

#include <gtest/gtest.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <string>

#include "tests/unit/runtime/modbus/oracle/differences.h"
#include "tests/unit/runtime/modbus/oracle/libmodbus_peer.h"
#include "tests/unit/runtime/modbus/oracle/our_peer.h"
#include "tests/unit/runtime/modbus/oracle/pymodbus_peer.h"
#include "tests/unit/runtime/modbus/oracle/request_space.h"

namespace stepwright::modbus::oracle {
namespace {

// Tables that end within reach of the largest requests, and tables of all addresses.
constexpr Sizes kSmall{2500, 200};
constexpr Sizes kAll{65536, 65536};
constexpr int kMostShown = 20;

struct Tally {
  std::size_t asked = 0;
  std::size_t same = 0;
  std::map<std::string_view, std::size_t> explained;  // by id
  int unexplained = 0;

  void compare(Peer peer, const Seen& seen) {
    ++asked;
    if (seen.ours == seen.theirs) {
      ++same;
      return;
    }
    for (const Difference& each : differences()) {
      if (each.peer != peer || !each.explains(seen)) continue;
      ++explained[each.id];
      return;
    }
    if (++unexplained > kMostShown) return;
    ADD_FAILURE() << (peer == Peer::Libmodbus ? "libmodbus" : "pymodbus") << " differs at "
                  << hex(seen.request).substr(0, 60) << " (" << seen.request.size()
                  << " bytes)\n  ours: " << to_string(seen.ours) << "\n  theirs: " << to_string(seen.theirs);
  }
};

struct Tallies {
  Tally libmodbus;
  Tally pymodbus;
};

Tallies compare_all(Sizes sizes, bool only_known) {
  const std::vector<Bytes> requests = request_space(sizes, only_known);
  const std::vector<Answer> pymodbus = ask_pymodbus(sizes, requests);
  OurPeer ours(sizes);
  LibmodbusPeer libmodbus(sizes);
  Tallies out;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const Answer our_answer = ours.ask(requests[i]);
    out.pymodbus.compare(Peer::Pymodbus, {requests[i], our_answer, pymodbus[i]});
    if (const auto theirs = libmodbus.ask(requests[i]))
      out.libmodbus.compare(Peer::Libmodbus, {requests[i], our_answer, *theirs});
  }
  for (const auto& [name, tally] : {std::pair{"libmodbus", out.libmodbus}, {"pymodbus", out.pymodbus}}) {
    std::cout << name << ": " << tally.asked << " requests, " << tally.same << " with the same answer;";
    for (const auto& [id, count] : tally.explained) std::cout << ' ' << id << ' ' << count;
    std::cout << '\n';
  }
  return out;
}

std::string text_of(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Oracle, EveryFunction_WhenAskedAtEveryBoundary_ThenAnswersAsThePeersOrDiffersAsDocumented) {
  const Tallies tallies = compare_all(kSmall, false);
  EXPECT_GT(tallies.libmodbus.same, 3'000u);
  EXPECT_GT(tallies.pymodbus.same, 20'000u);
  // A reason that explains nothing is a promise that nobody keeps.
  for (const Difference& each : differences()) {
    const Tally& tally = each.peer == Peer::Libmodbus ? tallies.libmodbus : tallies.pymodbus;
    EXPECT_TRUE(tally.explained.contains(each.id)) << each.id << " was never seen";
  }
}

TEST(Oracle, EveryServedFunction_WhenTablesHaveAllAddresses_ThenAnswersAsThePeersOrDiffersAsDocumented) {
  const Tallies tallies = compare_all(kAll, true);
  EXPECT_GT(tallies.libmodbus.same, 2'000u);
  EXPECT_GT(tallies.pymodbus.same, 2'000u);
}

TEST(Oracle, Differences_WhenListed_ThenTheDocumentHasEach) {
  const std::string document = text_of(STEPWRIGHT_SOURCE_DIR "/runtime/doc/modbus_differences.md");
  for (const Difference& each : differences()) {
    EXPECT_NE(document.find("| " + std::string(each.id) + " |"), std::string::npos) << each.id;
  }
}

}  // namespace
}  // namespace stepwright::modbus::oracle
