#include "tests/bench/ltl_monitor/monitor_cost.h"

#include <algorithm>
#include <chrono>
#include <random>
#include <stdexcept>
#include <string>

#include "cell/monitors/cell_monitors.h"
#include "tests/bench/ltl_monitor/watched_program.h"
#include "tests/unit/supervisor/ltl/paper_formulas.h"

namespace stepwright::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kScans = 200'000;
constexpr int kPasses = 11;

std::string place(int k) {
  return "p" + std::to_string(k);
}

driver::Watcher monitor() {
  config::CellConfig config;
  config::MonitorConfig first;
  first.name = "row";
  first.formula = ltl::test::in_succession(kPlaces);
  for (int k = 1; k <= kPlaces; ++k) first.let.push_back({place(k), "main." + place(k), {}});
  config.monitors.push_back(first);
  const auto monitors = cell_monitors::cell_monitors(config);
  if (!monitors) throw std::runtime_error(result::to_string(monitors.error()));
  return monitors->front().program;
}

driver::Watcher by_hand() {
  std::string text =
      "PROGRAM hand\nVAR Reset : BOOL; Verdict, Step : INT; END_VAR\n"
      "IF Reset THEN Reset := FALSE; Verdict := 0; Step := 0; RETURN; END_IF;\nCASE Step OF\n";
  for (int k = 0; k < kPlaces; ++k) {
    std::string others;
    for (int other = 1; other <= kPlaces; ++other)
      if (other != k && other != k + 1) others += (others.empty() ? "main." : " OR main.") + place(other);
    text += std::to_string(k) + ": IF main." + place(k + 1) + " THEN Step := " + std::to_string(k + 1) + ";" +
            (k + 1 == kPlaces ? " Verdict := 1;" : "") + " ELSIF " + others +
            " THEN Step := 9; Verdict := 2; END_IF;\n";
  }
  return {.name = "hand", .text = text + "END_CASE;\nEND_PROGRAM\n"};
}

struct Letter {
  int place = 0;
  bool reset = false;
};

// Mostly none, and then the next place of the row more often than another one; anew once it is decided.
std::vector<Letter> letters() {
  WatchedProgram program(EngineKind::Native, std::vector{monitor()});
  std::mt19937 random(3);
  std::vector<Letter> out;
  int next = 1;
  while (out.size() < kScans) {
    Letter letter;
    letter.reset = program.verdict() != 0;
    if (letter.reset) next = 1;
    if (!letter.reset && random() % 4 == 0)
      letter.place = random() % 16 == 0 ? 1 + static_cast<int>(random() % kPlaces) : next;
    if (letter.place == next) ++next;
    program.scan(letter.place, letter.reset);
    out.push_back(letter);
  }
  return out;
}

void compare(const std::vector<Letter>& run) {
  WatchedProgram native(EngineKind::Native, std::vector{monitor()}),
      vm(EngineKind::Vm, std::vector{monitor()});
  WatchedProgram hand(EngineKind::Native, std::vector{by_hand()});
  int decided = 0;
  for (const Letter& each : run) {
    for (WatchedProgram* program : {&native, &vm, &hand}) program->scan(each.place, each.reset);
    if (native.verdict() != vm.verdict() || native.verdict() != hand.verdict())
      throw std::runtime_error("verdicts differ");
    decided += native.verdict() != 0 ? 1 : 0;
  }
  if (decided < 100) throw std::runtime_error("the run decides nothing");
}

double pass_us(WatchedProgram& program, const std::vector<Letter>& run) {
  const auto start = Clock::now();
  for (const Letter& each : run) program.scan(each.place, each.reset);
  const std::chrono::duration<double, std::micro> all = Clock::now() - start;
  if (program.trapped()) throw std::runtime_error("a program trapped");
  return all.count() / static_cast<double>(run.size());
}

// Of the passes that other processes have disturbed least.
double least(const std::vector<double>& values) {
  return std::ranges::min(values);
}

}  // namespace

std::vector<EngineCost> monitor_cost() {
  const std::vector<Letter> word = letters();
  compare(word);
  std::vector<EngineCost> costs;
  for (const auto& [name, kind] :
       {std::pair("native", EngineKind::Native), std::pair("vm", EngineKind::Vm)}) {
    WatchedProgram watched(kind, std::vector{monitor()}), plain(kind, {}), hand(kind, std::vector{by_hand()});
    std::vector<double> watched_us, plain_us, hand_us;
    for (int pass = 0; pass < kPasses; ++pass) {
      watched_us.push_back(pass_us(watched, word));
      plain_us.push_back(pass_us(plain, word));
      hand_us.push_back(pass_us(hand, word));
    }
    const double without = least(plain_us);
    costs.push_back({name, least(watched_us) - without, least(hand_us) - without, without});
  }
  return costs;
}

double most_us(const std::vector<EngineCost>& costs) {
  double most = 0.0;
  for (const EngineCost& each : costs) most = std::max(most, each.monitor_us);
  return most;
}

}  // namespace stepwright::bench
