// THE table of ladder/doc/sfc_semantics.md: every qualifier in every situation, compiled and run scan by
// scan. What must come out was worked out by hand from the ACTION_CONTROL block of IEC 61131-3, 2.6.4.5.

#include <gtest/gtest.h>

#include "tests/unit/ladder/lowering/chart_run.h"

namespace stepwright::lowering {
namespace {

// The steps of each chart; B is the block under test, on the BOOL `q` and on the action `act`.
enum class Shape {
  InARow,   // IDLE -> RUN (B) -> LAST; for R: IDLE sets
  Initial,  // RUN (B) is initial -> LAST; for R: a second token stands in a step that sets
  Shared,   // IDLE -> RUN (B) -> NEXT (B) -> LAST; for R: IDLE sets
  Reset,    // IDLE -> RUN (B) beside WAIT -> RST (R) -> OFF; RUN stays active
  Held,     // as InARow, while a second token stands in a step with R
  Ended,    // as InARow, LAST has R
  Again,    // IDLE -> RUN (B) -> IDLE
};

struct Row {
  const char* id;
  Shape shape;
  const char* block;  // "L, T#30ms"
  const char* go;     // scans in which the tokens move
  const char* q;      // the BOOL target in each scan
  // The body: 0 does not run, 2 runs with act.Q TRUE, 1 runs with act.Q FALSE. Empty: without final scan, as
  // q.
  const char* body = "";
};

void PrintTo(const Row& row, std::ostream* out) {
  *out << row.id;
}

std::string step(const char* name, const std::string& block, bool initial = false) {
  const std::string uses = block.empty() ? "" : " q(" + block + "); act(" + block + ");";
  return std::string(initial ? "INITIAL_STEP " : "STEP ") + name + ":" + uses + " END_STEP\n";
}

std::string go(const char* from, const char* to) {
  return std::string("TRANSITION FROM ") + from + " TO " + to + " := go; END_TRANSITION\n";
}

std::string chart_of(const Row& row) {
  const std::string block = row.block;
  const std::string set = block == "R" ? "S" : "";
  std::string text;
  switch (row.shape) {
    case Shape::InARow:
      text = step("IDLE", set, true) + step("RUN", block) + step("LAST", "");
      return text + go("IDLE", "RUN") + go("RUN", "LAST");
    case Shape::Again:
      text = step("IDLE", "", true) + step("RUN", block);
      return text + go("IDLE", "RUN") + go("RUN", "IDLE");
    case Shape::Ended:
      text = step("IDLE", set, true) + step("RUN", block) + step("LAST", "R");
      return text + go("IDLE", "RUN") + go("RUN", "LAST");
    case Shape::Held:
      text = step("HOLD", "R", true) + step("IDLE", set, true) + step("RUN", block) + step("LAST", "");
      return text + go("IDLE", "RUN") + go("RUN", "LAST");
    case Shape::Initial:
      text = (set.empty() ? "" : step("SETTER", set, true)) + step("RUN", block, true) + step("LAST", "");
      return text + go("RUN", "LAST");
    case Shape::Shared:
      text = step("IDLE", set, true) + step("RUN", block) + step("NEXT", block) + step("LAST", "");
      return text + go("IDLE", "RUN") + go("RUN", "NEXT") + go("NEXT", "LAST");
    case Shape::Reset:
      text = step("IDLE", set, true) + step("RUN", block) + step("WAIT", "") + step("RST", "R") +
             step("OFF", "");
      return text + go("IDLE", "(RUN, WAIT)") + go("WAIT", "RST") + go("RST", "OFF");
  }
  return text;
}

class SfcTable : public ::testing::TestWithParam<Row> {};

TEST_P(SfcTable, WhenTheChartRuns_ThenTargetAndBodyAreAsTheRowSays) {
  const Row& row = GetParam();
  const bool final_scan = *row.body != 0;
  ChartRun run(std::string(final_scan ? "{sfc_final_scan}\n" : "") + chart_of(row) +
               "ACTION act: mark := 1; IF act.Q THEN mark := 2; END_IF; END_ACTION");
  const std::vector<std::string> traces = run.traces({"main.q", "main.mark"}, row.go);
  EXPECT_EQ(traces[0], row.q);
  std::string body = row.q;
  for (char& c : body) c = c == '1' ? '2' : '0';
  EXPECT_EQ(traces[1], final_scan ? row.body : body);
}

constexpr Row kRows[] = {
    // Entry: RUN is entered in scan 3.
    {"SFC-Q-N-1", Shape::InARow, "N", "0010", "0011"},
    {"SFC-Q-S-1", Shape::InARow, "S", "0010", "0011"},
    {"SFC-Q-R-1", Shape::InARow, "R", "0010", "1100"},
    {"SFC-Q-L-1", Shape::InARow, "L, T#30ms", "0010", "0011"},
    {"SFC-Q-D-1", Shape::InARow, "D, T#30ms", "0010", "0000"},
    {"SFC-Q-P-1", Shape::InARow, "P", "0010", "0010"},
    {"SFC-Q-P0-1", Shape::InARow, "P0", "0010", "0000"},
    {"SFC-Q-P1-1", Shape::InARow, "P1", "0010", "0010"},
    {"SFC-Q-SD-1", Shape::InARow, "SD, T#30ms", "0010", "0000"},
    {"SFC-Q-DS-1", Shape::InARow, "DS, T#30ms", "0010", "0000"},
    {"SFC-Q-SL-1", Shape::InARow, "SL, T#30ms", "0010", "0011"},
    // While active: RUN stays active from scan 3 on.
    {"SFC-Q-N-2", Shape::InARow, "N", "0010000000", "0011111111"},
    {"SFC-Q-S-2", Shape::InARow, "S", "0010000000", "0011111111"},
    {"SFC-Q-R-2", Shape::InARow, "R", "0010000000", "1100000000"},
    {"SFC-Q-L-2", Shape::InARow, "L, T#30ms", "0010000000", "0011100000"},
    {"SFC-Q-D-2", Shape::InARow, "D, T#30ms", "0010000000", "0000011111"},
    {"SFC-Q-P-2", Shape::InARow, "P", "0010000000", "0010000000"},
    {"SFC-Q-P0-2", Shape::InARow, "P0", "0010000000", "0000000000"},
    {"SFC-Q-P1-2", Shape::InARow, "P1", "0010000000", "0010000000"},
    {"SFC-Q-SD-2", Shape::InARow, "SD, T#30ms", "0010000000", "0000011111"},
    {"SFC-Q-DS-2", Shape::InARow, "DS, T#30ms", "0010000000", "0000011111"},
    {"SFC-Q-SL-2", Shape::InARow, "SL, T#30ms", "0010000000", "0011100000"},
    // Exit: RUN is active in the scans 3 to 7.
    {"SFC-Q-N-3", Shape::InARow, "N", "00100001000000", "00111110000000"},
    {"SFC-Q-S-3", Shape::InARow, "S", "00100001000000", "00111111111111"},
    {"SFC-Q-R-3", Shape::InARow, "R", "00100001000000", "11000000000000"},
    {"SFC-Q-L-3", Shape::InARow, "L, T#70ms", "00100001000000", "00111110000000"},
    {"SFC-Q-D-3", Shape::InARow, "D, T#30ms", "00100001000000", "00000110000000"},
    {"SFC-Q-P-3", Shape::InARow, "P", "00100001000000", "00100000000000"},
    {"SFC-Q-P0-3", Shape::InARow, "P0", "00100001000000", "00000001000000"},
    {"SFC-Q-P1-3", Shape::InARow, "P1", "00100001000000", "00100000000000"},
    {"SFC-Q-SD-3", Shape::InARow, "SD, T#70ms", "00100001000000", "00000000011111"},
    {"SFC-Q-DS-3", Shape::InARow, "DS, T#30ms", "00100001000000", "00000111111111"},
    {"SFC-Q-SL-3", Shape::InARow, "SL, T#70ms", "00100001000000", "00111111100000"},
    // On the initial step, which is active in the scans 1 to 5.
    {"SFC-Q-N-4", Shape::Initial, "N", "0000010000", "1111100000"},
    {"SFC-Q-S-4", Shape::Initial, "S", "0000010000", "1111111111"},
    {"SFC-Q-R-4", Shape::Initial, "R", "0000010000", "0000011111"},
    {"SFC-Q-L-4", Shape::Initial, "L, T#30ms", "0000010000", "1110000000"},
    {"SFC-Q-D-4", Shape::Initial, "D, T#30ms", "0000010000", "0001100000"},
    {"SFC-Q-P-4", Shape::Initial, "P", "0000010000", "1000000000"},
    {"SFC-Q-P0-4", Shape::Initial, "P0", "0000010000", "0000010000"},
    {"SFC-Q-P1-4", Shape::Initial, "P1", "0000010000", "1000000000"},
    {"SFC-Q-SD-4", Shape::Initial, "SD, T#30ms", "0000010000", "0001111111"},
    {"SFC-Q-DS-4", Shape::Initial, "DS, T#30ms", "0000010000", "0001111111"},
    {"SFC-Q-SL-4", Shape::Initial, "SL, T#30ms", "0000010000", "1110000000"},
    // Two steps in a row share the action: RUN in the scans 3 and 4, NEXT in 5 to 7.
    {"SFC-Q-N-5", Shape::Shared, "N", "001010010000", "001111100000"},
    {"SFC-Q-S-5", Shape::Shared, "S", "001010010000", "001111111111"},
    {"SFC-Q-R-5", Shape::Shared, "R", "001010010000", "110000000000"},
    {"SFC-Q-L-5", Shape::Shared, "L, T#20ms", "001010010000", "001111000000"},
    {"SFC-Q-D-5", Shape::Shared, "D, T#20ms", "001010010000", "000000100000"},
    {"SFC-Q-P-5", Shape::Shared, "P", "001010010000", "001010000000"},
    {"SFC-Q-P0-5", Shape::Shared, "P0", "001010010000", "000010010000"},
    {"SFC-Q-P1-5", Shape::Shared, "P1", "001010010000", "001010000000"},
    {"SFC-Q-SD-5", Shape::Shared, "SD, T#40ms", "001010010000", "000000111111"},
    {"SFC-Q-DS-5", Shape::Shared, "DS, T#20ms", "001010010000", "000000111111"},
    {"SFC-Q-SL-5", Shape::Shared, "SL, T#30ms", "001010010000", "001111100000"},
    // Reset: RUN is active from scan 3 on, a step with R in the scans 6 to 8 (P, P0, P1: all the time).
    {"SFC-Q-N-6", Shape::Reset, "N", "001001001000", "001110001111"},
    {"SFC-Q-S-6", Shape::Reset, "S", "001001001000", "001110001111"},
    {"SFC-Q-R-6", Shape::Reset, "R", "001001001000", "110000000000"},
    {"SFC-Q-L-6", Shape::Reset, "L, T#80ms", "001001001000", "001110001100"},
    {"SFC-Q-D-6", Shape::Reset, "D, T#20ms", "001001001000", "000010001111"},
    {"SFC-Q-P-6", Shape::Held, "P", "001001001000", "000000000000"},
    {"SFC-Q-P0-6", Shape::Held, "P0", "001001001000", "000000000000"},
    {"SFC-Q-P1-6", Shape::Held, "P1", "001001001000", "000000000000"},
    {"SFC-Q-SD-6", Shape::Reset, "SD, T#20ms", "001001001000", "000010000011"},
    {"SFC-Q-DS-6", Shape::Reset, "DS, T#20ms", "001001001000", "000010001111"},
    {"SFC-Q-SL-6", Shape::Reset, "SL, T#20ms", "001001001000", "001100001100"},
    // With final scan: RUN is active in the scans 3 to 7.
    {"SFC-Q-N-7", Shape::InARow, "N", "00100001000000", "00111110000000", "00222221000000"},
    {"SFC-Q-S-7", Shape::Ended, "S", "00100001000000", "00111110000000", "00222221000000"},
    {"SFC-Q-R-7", Shape::InARow, "R", "00100001000000", "11000000000000", "22100000000000"},
    {"SFC-Q-L-7", Shape::InARow, "L, T#30ms", "00100001000000", "00111000000000", "00222100000000"},
    {"SFC-Q-D-7", Shape::InARow, "D, T#30ms", "00100001000000", "00000110000000", "00000221000000"},
    {"SFC-Q-P-7", Shape::InARow, "P", "00100001000000", "00100000000000", "00210000000000"},
    {"SFC-Q-P0-7", Shape::InARow, "P0", "00100001000000", "00000001000000", "00000001000000"},
    {"SFC-Q-P1-7", Shape::InARow, "P1", "00100001000000", "00100000000000", "00100000000000"},
    {"SFC-Q-SD-7", Shape::Ended, "SD, T#30ms", "00100001000000", "00000110000000", "00000221000000"},
    {"SFC-Q-DS-7", Shape::Ended, "DS, T#30ms", "00100001000000", "00000110000000", "00000221000000"},
    {"SFC-Q-SL-7", Shape::InARow, "SL, T#30ms", "00100001000000", "00111000000000", "00222100000000"},
    // Left before the time is over.
    {"SFC-Q-D-8", Shape::InARow, "D, T#70ms", "00100001000000", "00000000000000"},
    {"SFC-Q-DS-8", Shape::InARow, "DS, T#70ms", "00100001000000", "00000000000000"},
    // Reset before the time is over, while the step is left: nothing stays stored.
    {"SFC-Q-SD-8", Shape::Ended, "SD, T#70ms", "00100001000000", "00000000000000"},
    {"SFC-Q-SL-8", Shape::Ended, "SL, T#70ms", "00100001000000", "00111110000000"},
    // T#0s, and a time below zero.
    {"SFC-Q-L-9", Shape::InARow, "L, T#0s", "00100001000000", "00000000000000"},
    {"SFC-Q-D-9", Shape::InARow, "D, T#0s", "00100001000000", "00111110000000"},
    {"SFC-Q-SD-9", Shape::InARow, "SD, T#0s", "00100001000000", "00111111111111"},
    {"SFC-Q-DS-9", Shape::InARow, "DS, T#0s", "00100001000000", "00111111111111"},
    {"SFC-Q-SL-9", Shape::InARow, "SL, T#0s", "00100001000000", "00000000000000"},
    {"SFC-Q-L-10", Shape::InARow, "L, T#-1s", "00100001000000", "00000000000000"},
    {"SFC-Q-D-10", Shape::InARow, "D, T#-1s", "00100001000000", "00111110000000"},
    {"SFC-Q-SD-10", Shape::InARow, "SD, T#-1s", "00100001000000", "00111111111111"},
    {"SFC-Q-DS-10", Shape::InARow, "DS, T#-1s", "00100001000000", "00111111111111"},
    {"SFC-Q-SL-10", Shape::InARow, "SL, T#-1s", "00100001000000", "00000000000000"},
    // Entered again in scan 8 (SD: in scan 6), left in scan 5, without R.
    {"SFC-Q-SL-11", Shape::Again, "SL, T#20ms", "00101001000000", "00110000000000"},
    {"SFC-Q-SD-11", Shape::Again, "SD, T#40ms", "00101100000000", "00000011111111"},
    {"SFC-Q-DS-11", Shape::Again, "DS, T#20ms", "00100101000000", "00001111111111"},
};

INSTANTIATE_TEST_SUITE_P(Doc, SfcTable, ::testing::ValuesIn(kRows), [](const auto& each) {
  std::string name = each.param.id;
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace stepwright::lowering
