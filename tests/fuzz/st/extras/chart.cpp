#include "tests/fuzz/st/extras/chart.h"

namespace stepwright::st_fuzz {

namespace {

class ChartWriter {
 public:
  ChartWriter(Material& material, std::vector<std::string>& actions) : m_(material), actions_(actions) {}

  std::string run() && {
    const std::string first = step();
    std::string end = elements(first, 2, static_cast<int>(m_.random.between(1, 3)));
    transition(end, first, first == end);
    return steps_ + transitions_;
  }

 private:
  // A chain of elements behind `at`; the step that it ends with.
  std::string elements(std::string at, int depth, int count) {
    for (int i = 0; i < count; ++i) {
      const std::size_t kind = depth > 0 ? m_.random.below(4) : 0;
      at = kind == 2 ? selection(at, depth - 1) : kind == 3 ? simultaneous(at, depth - 1) : sequence(at);
    }
    return at;
  }

  std::string sequence(const std::string& at) {
    const std::string next = step();
    transition(at, next, false);
    return next;
  }

  std::string selection(const std::string& at, int depth) {
    const std::string end = step();
    const bool priorities = m_.random.chance(30);
    for (int i = 0; i < 2; ++i) {
      const std::string head = step();
      transition(at, head, false, priorities ? "(PRIORITY := " + std::to_string(2 - i) + ") " : "");
      transition(elements(head, depth, static_cast<int>(m_.random.below(2))), end, false);
    }
    return end;
  }

  std::string simultaneous(const std::string& at, int depth) {
    std::string heads, tails;
    for (int i = 0; i < 2; ++i) {
      const std::string head = step();
      const std::string tail = elements(head, depth, static_cast<int>(m_.random.below(3)));
      heads += (i == 0 ? "" : ", ") + head;
      tails += (i == 0 ? "" : ", ") + tail;
    }
    const std::string end = step();
    transition(at, "(" + heads + ")", false);
    transition("(" + tails + ")", end, false);
    return end;
  }

  std::string step() {
    const std::string name = "Zstep" + std::to_string(count_++);
    std::string text = (count_ == 1 ? "INITIAL_STEP " : "STEP ") + name + ":";
    const auto associations = m_.random.below(3);
    for (std::size_t i = 0; i < associations; ++i) text += " " + association() + ";";
    steps_ += text + " END_STEP\n";
    return name;
  }

  std::string association() {
    const std::string qualifier =
        m_.pick({"N", "N", "N", "S", "R", "P", "P0", "P1", "L", "D", "SD", "DS", "SL"});
    const bool timed = qualifier.find_first_of("LD") != std::string::npos;
    const std::string time = timed ? ", " + m_.pick({"T#10ms", "T#20ms", "T#35ms"}) : "";
    if (m_.random.chance(30)) return "zq" + std::to_string(m_.random.below(2)) + "(" + qualifier + time + ")";
    if (actions_.size() < 3) actions_.push_back("Zaction" + std::to_string(actions_.size()));
    return m_.random.pick(actions_) + "(" + qualifier + time + ")";
  }

  void transition(const std::string& from, const std::string& to, bool slow, const std::string& head = "") {
    const std::string step = "Zstep" + std::to_string(m_.random.below(static_cast<std::size_t>(count_)));
    std::string condition = "TRUE";
    switch (m_.random.below(slow ? 3 : 5)) {
      case 0:
        condition = m_.value(Scalar::Bool);
        break;
      case 1:
        condition = step + ".T >= " + m_.pick({"T#10ms", "T#20ms", "T#30ms"});
        break;
      case 2:
        condition = m_.pick({"NOT ", ""}) + step + ".X";
        break;
      default:
        break;
    }
    transitions_ +=
        "TRANSITION " + head + "FROM " + from + " TO " + to + " := " + condition + "; END_TRANSITION\n";
  }

  Material& m_;
  std::vector<std::string>& actions_;
  std::string steps_;
  std::string transitions_;
  int count_ = 0;
};

}  // namespace

std::string random_chart(Material& material, std::vector<std::string>& actions) {
  return ChartWriter(material, actions).run();
}

}  // namespace stepwright::st_fuzz
