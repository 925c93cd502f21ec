#include <algorithm>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "supervisor/ltl/automaton/reach.h"
#include "supervisor/ltl/hoa/hoa.h"
#include "supervisor/ltl/hoa/label_reader.h"
#include "supervisor/ltl/hoa/scanner.h"

namespace stepwright::ltl {

namespace {

enum class Sets : std::uint8_t { All, None, Infinite, Finite };  // t, f, Inf(0), Fin(0)

struct Edge {
  std::uint32_t from = 0, to = 0;
  HoaToken at;
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& file, const HoaLimits& limits)
      : limits_(limits), scan_(text, file), diagram_(limits.nodes), labels_(scan_, diagram_, limits) {}

  result::Result<HoaAutomaton> run() {
    header();
    if (!scan_.failed()) body();
    if (!scan_.failed()) judge();
    if (scan_.failed()) return tl::unexpected<result::Diagnostics>(scan_.error());
    read_.automaton = minimised(read_.automaton);
    return std::move(read_);
  }

 private:
  void header() {
    const HoaToken first = scan_.take();
    if (first.kind != HoaTokenKind::Header || first.text != "HOA")
      return scan_.fail("L0021", first, "the text does not begin with 'HOA: v1'",
                        "the format is HOA version 1");
    if (const HoaToken version = scan_.take(); version.text != "v1")
      return scan_.fail("L0025", version, "version '" + version.text + "' is not known",
                        "the format is HOA version 1");
    while (scan_.peek().kind == HoaTokenKind::Header) item(scan_.take());
    if (scan_.failed()) return;
    if (scan_.peek().kind != HoaTokenKind::Body) return scan_.fail_here("a header or --BODY--");
    const HoaToken end = scan_.take();
    if (!start_)
      return scan_.fail("L0025", end, "there is no Start:", "an automaton begins in exactly one state");
    if (!sets_) return scan_.fail("L0021", end, "there is no Acceptance:", "add 'Acceptance: 1 Inf(0)'");
  }

  void item(const HoaToken& name) {
    if (name.text == "States") {
      if (const auto count = number()) want(*count == 0 ? 0 : *count - 1, name);
    } else if (name.text == "Start") {
      const auto state = number();
      if (start_ || scan_.sees('&'))
        return scan_.fail("L0025", name, "there are several initial states",
                          "make it deterministic with another tool");
      start_ = state;
      if (state) want(*state, name);
    } else if (name.text == "AP") {
      propositions(name);
    } else if (name.text == "Alias") {
      const HoaToken alias = scan_.take();
      if (alias.kind != HoaTokenKind::Alias)
        return scan_.fail("L0021", alias, "an alias begins with @", "Alias: @a 0&1");
      labels_.add_alias(alias.text, labels_.read());
    } else if (name.text == "Acceptance") {
      acceptance(name);
    } else if (name.text[0] >= 'A' && name.text[0] <= 'Z') {
      scan_.fail("L0025", name, "the header '" + name.text + ":' changes the meaning and is not supported",
                 "only headers with a small first letter can be left out");
    } else {
      while (scan_.peek().kind != HoaTokenKind::Header && scan_.peek().kind != HoaTokenKind::Body &&
             scan_.peek().kind != HoaTokenKind::Nothing)
        scan_.take();
    }
  }

  void propositions(const HoaToken& name) {
    const auto count = number();
    if (!count) return;
    if (*count > limits_.propositions)
      return scan_.fail("L0026", name, "more than " + std::to_string(limits_.propositions) + " propositions",
                        "leave out those that no label asks for");
    std::vector<std::string>& names = read_.automaton.propositions;
    while (scan_.peek().kind == HoaTokenKind::Text) names.push_back(scan_.take().text);
    if (names.size() != *count) return scan_.fail_here(std::to_string(*count) + " names in quotes");
    if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
      return scan_.fail("L0021", name, "two propositions have one name",
                        "each proposition has a name of its own");
    labels_.set_propositions(names.size());
  }

  void acceptance(const HoaToken& name) {
    const auto count = number();
    set_count_ = count.value_or(0);
    const HoaToken word = scan_.take();
    if (word.text == "t") {
      sets_ = Sets::All;
    } else if (word.text == "f") {
      sets_ = Sets::None;
    } else if (word.text == "Inf" || word.text == "Fin") {
      sets_ = word.text == "Inf" ? Sets::Infinite : Sets::Finite;
      const bool plain =
          scan_.accept('(') && number() == std::optional<std::uint32_t>(0) && scan_.accept(')');
      if (!plain) sets_.reset();
    }
    const bool more = scan_.sees('&') || scan_.sees('|');
    if (!sets_ || more || !count || *count > 1)
      scan_.fail("L0024", name, "only the acceptances t, f, Inf(0) and Fin(0) can be told by finite words",
                 "write the automaton with another tool as a deterministic Buchi automaton");
  }

  void body() {
    std::vector<bool> defined;
    while (scan_.peek().kind == HoaTokenKind::Header && scan_.peek().text == "State") {
      const HoaToken at = scan_.take();
      std::optional<Diagram::Node> shared;
      if (scan_.sees('[')) shared = label();
      const auto state = number();
      if (!state || !want(*state, at)) return;
      defined.resize(std::max<std::size_t>(defined.size(), *state + 1), false);
      if (defined[*state])
        return scan_.fail("L0021", at, "state " + std::to_string(*state) + " is there twice",
                          "give each state one State:");
      defined[*state] = true;
      if (scan_.peek().kind == HoaTokenKind::Text) scan_.take();
      marked_.resize(places_.size(), false);
      marked_[*state] = marks();
      places_[*state] = at;
      edges(*state, shared);
    }
    if (scan_.failed()) return;
    if (scan_.peek().kind != HoaTokenKind::End) return scan_.fail_here("State: or --END--");
    defined.resize(places_.size(), false);
    const auto missing = std::find(defined.begin(), defined.end(), false);
    if (missing != defined.end())
      return scan_.fail("L0023", HoaToken(scan_.peek()),
                        "state " + std::to_string(missing - defined.begin()) + " has no State:",
                        "complete the automaton ('autfilt -C' does)");
  }

  void edges(std::uint32_t from, std::optional<Diagram::Node> shared) {
    // What is left of the letters: an edge may take only from it, and all of it must be taken.
    Diagram::Node left = Diagram::kTrue, after = Diagram::kFalse;
    std::uint64_t implicit = 0;
    const auto count = static_cast<std::uint32_t>(read_.automaton.propositions.size());
    while (scan_.peek().kind == HoaTokenKind::Number || scan_.sees('[')) {
      const HoaToken at = scan_.peek();
      Diagram::Node guard = shared.value_or(Diagram::kTrue);
      if (scan_.sees('[')) {
        guard = label();
      } else if (!shared) {
        if (count < 64 && implicit >> count != 0)
          return scan_.fail("L0022", at, "more edges than there are letters",
                            "without labels each letter has one edge");
        for (std::uint32_t k = 0; k < count; ++k) {
          const Diagram::Node holds = diagram_.variable(k);
          guard = diagram_.both(guard, (implicit >> k & 1) != 0 ? holds : diagram_.negation(holds));
        }
        ++implicit;
      }
      const auto to = number();
      if (!to || !want(*to, at)) return;
      if (scan_.sees('&'))
        return scan_.fail("L0025", at, "this edge leads to several states at once",
                          "alternation is not supported");
      if (scan_.sees('{'))
        return scan_.fail("L0024", HoaToken(scan_.peek()), "acceptance on an edge",
                          "write acceptance by states ('autfilt -S' does)");
      if (diagram_.both(guard, diagram_.negation(left)) != Diagram::kFalse)
        return scan_.fail("L0022", at, "a letter of this edge leads to another state as well",
                          "make it deterministic with another tool ('autfilt -D' does)");
      if (guard == Diagram::kFalse) continue;
      left = diagram_.both(left, diagram_.negation(guard));
      after = diagram_.choose(guard, diagram_.variable(count + *to), after);
      edges_.push_back({from, *to, at});
    }
    if (diagram_.exhausted())
      return scan_.fail("L0026", places_[from],
                        "the labels have more than " + std::to_string(limits_.nodes) + " nodes",
                        "write labels that ask for fewer propositions at once");
    if (scan_.failed()) return;
    if (left != Diagram::kFalse)
      return scan_.fail("L0023", places_[from],
                        "state " + std::to_string(from) + " has no edge for some letters",
                        "complete the automaton ('autfilt -C' does)");
    after_.resize(places_.size(), Diagram::kFalse);
    after_[from] = after;
  }

  // Whether states that accept are never left, or those that do not; and what that tells of each.
  void judge() {
    const std::size_t size = places_.size();
    std::vector<bool> accepts(size), others;
    for (std::size_t k = 0; k < size; ++k)
      accepts[k] = *sets_ == Sets::All || (*sets_ == Sets::Infinite && marked_[k]) ||
                   (*sets_ == Sets::Finite && !marked_[k]);
    others = accepts;
    others.flip();
    Reach reach(size);
    const Edge *leaves = nullptr, *enters = nullptr;
    for (const Edge& each : edges_) {
      reach.add(each.from, each.to);
      if (accepts[each.from] && !accepts[each.to]) leaves = &each;
      if (!accepts[each.from] && accepts[each.to]) enters = &each;
    }
    if (leaves != nullptr && enters != nullptr)
      return scan_.fail("L0024", leaves->at,
                        "this edge leaves an accepting state, and others come back to one",
                        "finite words tell nothing here: acceptance must be for good, or lost for good");
    read_.part = leaves == nullptr && enters != nullptr ? HoaPart::Good : HoaPart::Bad;
    const bool good = read_.part == HoaPart::Good;
    const std::vector<bool> sure = reach.every(good ? accepts : others);
    const std::vector<bool> possible = reach.some(good ? accepts : others);
    Automaton& automaton = read_.automaton;
    automaton.initial = *start_;
    std::unordered_map<Diagram::Node, Guard> known;
    for (std::size_t k = 0; k < size; ++k) {
      automaton.edges.push_back(guard(after_[k], known));
      Verdict verdict = Verdict::Undecided;
      if (sure[k]) verdict = good ? Verdict::True : Verdict::False;
      if (!possible[k]) verdict = good ? Verdict::False : Verdict::True;
      automaton.verdicts.push_back(verdict);
    }
  }

  Guard guard(Diagram::Node node, std::unordered_map<Diagram::Node, Guard>& known) {
    const auto count = static_cast<std::uint32_t>(read_.automaton.propositions.size());
    if (diagram_.level(node) >= count) return guard_of_state(diagram_.level(node) - count);
    if (const auto found = known.find(node); found != known.end()) return found->second;
    const Guard low = guard(diagram_.low(node), known), high = guard(diagram_.high(node), known);
    const Guard made = read_.automaton.guards.make(diagram_.level(node), low, high);
    known.emplace(node, made);
    return made;
  }

  std::optional<std::uint32_t> number() {
    if (scan_.peek().kind == HoaTokenKind::Number) return scan_.take().number;
    scan_.fail_here("a number");
    return std::nullopt;
  }

  // A state that is spoken of exists.
  bool want(std::uint32_t state, const HoaToken& at) {
    if (state >= limits_.states) {
      scan_.fail("L0026", at, "more than " + std::to_string(limits_.states) + " states",
                 "minimise the automaton");
      return false;
    }
    if (state >= places_.size()) places_.resize(state + 1);
    return true;
  }

  Diagram::Node label() {
    scan_.take();
    const Diagram::Node read = labels_.read();
    if (!scan_.accept(']')) scan_.fail_here("']'");
    return read;
  }

  bool marks() {
    bool marked = false;
    if (!scan_.accept('{')) return marked;
    while (scan_.peek().kind == HoaTokenKind::Number) {
      const HoaToken set = scan_.take();
      if (set.number >= set_count_)
        scan_.fail("L0021", set, "there is no acceptance set " + set.text,
                   "sets are those of Acceptance:, from 0");
      marked = true;
    }
    if (!scan_.accept('}')) scan_.fail_here("'}'");
    return marked;
  }

  const HoaLimits& limits_;
  HoaScanner scan_;
  Diagram diagram_;
  LabelReader labels_;
  HoaAutomaton read_;
  std::optional<std::uint32_t> start_;
  std::optional<Sets> sets_;
  std::uint32_t set_count_ = 0;
  std::vector<HoaToken> places_;  // of each state
  std::vector<bool> marked_;
  std::vector<Diagram::Node> after_;
  std::vector<Edge> edges_;
};

}  // namespace

result::Result<HoaAutomaton> read_hoa(std::string_view text, const std::string& file,
                                      const HoaLimits& limits) {
  return Reader(text, file, limits).run();
}

}  // namespace stepwright::ltl
