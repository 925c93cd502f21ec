// Drawn elements that hang on nothing are told with their place, once, and the rest runs.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "ladder/exchange/plcopen_reader.h"
#include "tests/unit/ladder/exchange/drawn_elements.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// What is said of loose ends, without the hints.
std::vector<std::string> loose_ends(const std::string& body) {
  const auto project = read_plcopen("plc.xml", ladder(bools("a b q p"), body));
  if (!project) return {result::to_string(project.error())};
  const auto compiled = driver::compile(input_of(*project));
  if (!compiled) return {result::to_string(compiled.error())};
  std::vector<std::string> said;
  for (const result::Diagnostic& each : compiled->warnings)
    if (each.code == "W0021") said.push_back((each.where.line > 1 ? "" : "no place: ") + each.message);
  return said;
}

TEST(LooseEnds, WhenEverythingIsWired_ThenNothingIsSaid) {
  const std::string right = at("rightPowerRail", 9, 400, 0, in("6"));
  EXPECT_THAT(loose_ends(contact(2, 50, 10, "1", "a") + coil(3, 200, 10, "2", "q") +
                         output(4, 200, 60, "2", "p") + contact(6, 50, 90, "1", "b") + right),
              IsEmpty());
}

TEST(LooseEnds, WhenNoWireLeadsToAnElement_ThenItIsTold) {
  EXPECT_THAT(loose_ends(contact(2, 50, 10, "", "a") + coil(3, 200, 10, "2", "q")),
              ElementsAre("POU 'main', network 1, contact 'a': no wire leads to it: it never has power"));
  EXPECT_THAT(loose_ends(coil(3, 200, 10, "", "q")),
              ElementsAre("POU 'main', network 1, coil 'q': no wire leads to it: it never has power"));
  EXPECT_THAT(loose_ends(output(3, 200, 10, "", "q")),
              ElementsAre("POU 'main', network 1, outVariable 'q': no wire leads to it: it is not written"));
}

TEST(LooseEnds, WhenNoWireLeadsOnFromAContact_ThenItIsTold) {
  EXPECT_THAT(
      loose_ends(contact(2, 50, 10, "1", "a") + contact(4, 90, 10, "1", "b") + coil(3, 200, 10, "2", "q")),
      ElementsAre("POU 'main', network 2, contact 'b': no wire leads on from it: it does nothing"));
}

TEST(LooseEnds, WhenThereAreSome_ThenTheRestRuns) {
  const std::string body = contact(2, 50, 10, "", "a") + coil(3, 200, 10, "2", "q") +
                           contact(4, 50, 60, "1", "b") + coil(5, 200, 60, "4", "p");
  EXPECT_EQ(run(ladder(bools("a b q p"), body), "a b", "a|a b", "q p"), "00 01");
}

}  // namespace
}  // namespace stepwright::exchange
