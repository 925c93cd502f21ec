#include "tests/bench/fleet/referee.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>

namespace stepwright::bench::fleet {

namespace {

using namespace stepwright::fleet;
using std::chrono::milliseconds;

class Writer {
 public:
  Writer(const Instance& instance, Mode mode) : instance_(instance), mode_(mode) {}

  std::string text() {
    out_ << "(reset)\n(set-logic QF_IDL)\n";
    for (std::uint32_t v = 0; v < instance_.envelopes.size(); ++v) vehicle(v);
    for (const TemporalConstraint& c : instance_.constraints) {
      const std::string to = time(c.to.at, c.to.side);
      distance(to, c.from ? time(c.from->at, c.from->side) : "0", c.distance);
    }
    for (std::uint32_t v = 0; v < instance_.envelopes.size(); ++v) {
      for (std::uint32_t w = v + 1; w < instance_.envelopes.size(); ++w) meet(v, w);
    }
    out_ << "(check-sat)\n";
    return out_.str();
  }

 private:
  static std::string time(PolygonRef p, Side side) {
    return (side == Side::Entry ? "s" : "e") + std::to_string(p.vehicle) + "_" + std::to_string(p.polygon);
  }
  static std::string number(milliseconds ms) {
    return ms.count() < 0 ? "(- " + std::to_string(-ms.count()) + ")" : std::to_string(ms.count());
  }
  void at_least(const std::string& later, const std::string& earlier, milliseconds least) {
    out_ << "(assert (>= (- " << later << " " << earlier << ") " << number(least) << "))\n";
  }
  void distance(const std::string& later, const std::string& earlier, const Bounds& bounds) {
    at_least(later, earlier, bounds.least);
    out_ << "(assert (<= (- " << later << " " << earlier << ") " << number(bounds.most) << "))\n";
  }

  void vehicle(std::uint32_t v) {
    const auto& polygons = instance_.envelopes[v].polygons;
    for (std::uint32_t k = 0; k < polygons.size(); ++k) {
      const std::string s = time({v, k}, Side::Entry), e = time({v, k}, Side::Exit);
      out_ << "(declare-fun " << s << " () Int)\n(declare-fun " << e << " () Int)\n";
      out_ << "(assert (and (>= " << s << " 0) (<= " << e << " 100000000)))\n";
      distance(e, s, polygons[k].stay);
      if (k == 0) continue;
      const EnvelopePolygon& before = polygons[k - 1];
      const std::string s_before = time({v, k - 1}, Side::Entry), e_before = time({v, k - 1}, Side::Exit);
      distance(e_before, s, before.overlap);
      at_least(s, s_before, std::max(milliseconds{0}, before.stay.least - before.overlap.least));
      at_least(e, e_before, std::max(milliseconds{0}, polygons[k].stay.least - before.overlap.least));
    }
  }

  // "false" where one is parked: the first for ever, or the second from time zero.
  std::string before(PolygonRef first, PolygonRef second) const {
    const bool for_ever = first.polygon + 1 == instance_.envelopes[first.vehicle].polygons.size();
    if (mode_ == Mode::Strict && (for_ever || second.polygon == 0)) return "false";
    return "(<= (- " + time(first, Side::Exit) + " " + time(second, Side::Entry) + ") 0)";
  }

  void meet(std::uint32_t v, std::uint32_t w) {
    const auto& a = instance_.envelopes[v].polygons;
    const auto& b = instance_.envelopes[w].polygons;
    for (std::uint32_t i = 0; i < a.size(); ++i) {
      for (std::uint32_t k = 0; k < b.size(); ++k) {
        if (!geometry::overlaps(a[i].area, b[k].area)) continue;
        const PolygonRef p{v, i}, q{w, k};
        out_ << "(assert (or " << before(p, q) << " " << before(q, p) << "))\n";
      }
    }
  }

  const Instance& instance_;
  Mode mode_;
  std::ostringstream out_;
};

struct ClosePipe {
  void operator()(std::FILE* pipe) const { pclose(pipe); }
};

}  // namespace

std::string smt_text(const Instance& instance, Mode mode) {
  return Writer(instance, mode).text();
}

std::optional<std::vector<Ruling>> decide(std::span<const std::string> problems, const std::string& folder,
                                          int seconds_each) {
  const std::string file = folder + "/referee.smt2";
  std::ofstream out(file);
  for (const std::string& problem : problems) out << problem;
  out.close();
  if (!out) return std::nullopt;
  const std::string command =
      "z3 -smt2 -t:" + std::to_string(1000 * seconds_each) + " '" + file + "' 2>/dev/null";
  const std::unique_ptr<std::FILE, ClosePipe> pipe(popen(command.c_str(), "r"));
  if (!pipe) return std::nullopt;
  std::vector<Ruling> rulings;
  char line[256];
  while (std::fgets(line, sizeof(line), pipe.get())) {
    const std::string answer(line);
    if (answer == "sat\n") rulings.push_back(Ruling::Schedule);
    if (answer == "unsat\n") rulings.push_back(Ruling::None);
    if (answer == "unknown\n" || answer == "timeout\n") rulings.push_back(Ruling::Unknown);
  }
  std::remove(file.c_str());
  if (rulings.size() != problems.size()) return std::nullopt;
  return rulings;
}

}  // namespace stepwright::bench::fleet
