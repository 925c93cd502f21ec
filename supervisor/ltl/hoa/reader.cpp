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
      : _limits(limits), _scan(text, file), _diagram(limits.nodes), _labels(_scan, _diagram, limits) {}

  result::Result<HoaAutomaton> run() {
    header();
    if (!_scan.failed()) body();
    if (!_scan.failed()) judge();
    if (_scan.failed()) return tl::unexpected<result::Diagnostics>(_scan.error());
    _read.automaton = minimised(_read.automaton);
    return std::move(_read);
  }

 private:
  void header() {
    const HoaToken first = _scan.take();
    if (first.kind != HoaTokenKind::Header || first.text != "HOA")
      return _scan.fail("L0021", first, "the text does not begin with 'HOA: v1'",
                        "the format is HOA version 1");
    if (const HoaToken version = _scan.take(); version.text != "v1")
      return _scan.fail("L0025", version, "version '" + version.text + "' is not known",
                        "the format is HOA version 1");
    while (_scan.peek().kind == HoaTokenKind::Header) item(_scan.take());
    if (_scan.failed()) return;
    if (_scan.peek().kind != HoaTokenKind::Body) return _scan.fail_here("a header or --BODY--");
    const HoaToken end = _scan.take();
    if (!_start)
      return _scan.fail("L0025", end, "there is no Start:", "an automaton begins in exactly one state");
    if (!_sets) return _scan.fail("L0021", end, "there is no Acceptance:", "add 'Acceptance: 1 Inf(0)'");
  }

  void item(const HoaToken& name) {
    if (name.text == "States") {
      if (const auto count = number()) want(*count == 0 ? 0 : *count - 1, name);
    } else if (name.text == "Start") {
      const auto state = number();
      if (_start || _scan.sees('&'))
        return _scan.fail("L0025", name, "there are several initial states",
                          "make it deterministic with another tool");
      _start = state;
      if (state) want(*state, name);
    } else if (name.text == "AP") {
      propositions(name);
    } else if (name.text == "Alias") {
      const HoaToken alias = _scan.take();
      if (alias.kind != HoaTokenKind::Alias)
        return _scan.fail("L0021", alias, "an alias begins with @", "Alias: @a 0&1");
      _labels.add_alias(alias.text, _labels.read());
    } else if (name.text == "Acceptance") {
      acceptance(name);
    } else if (name.text[0] >= 'A' && name.text[0] <= 'Z') {
      _scan.fail("L0025", name, "the header '" + name.text + ":' changes the meaning and is not supported",
                 "only headers with a small first letter can be left out");
    } else {
      while (_scan.peek().kind != HoaTokenKind::Header && _scan.peek().kind != HoaTokenKind::Body &&
             _scan.peek().kind != HoaTokenKind::Nothing)
        _scan.take();
    }
  }

  void propositions(const HoaToken& name) {
    const auto count = number();
    if (!count) return;
    if (*count > _limits.propositions)
      return _scan.fail("L0026", name, "more than " + std::to_string(_limits.propositions) + " propositions",
                        "leave out those that no label asks for");
    std::vector<std::string>& names = _read.automaton.propositions;
    while (_scan.peek().kind == HoaTokenKind::Text) names.push_back(_scan.take().text);
    if (names.size() != *count) return _scan.fail_here(std::to_string(*count) + " names in quotes");
    if (std::set<std::string>(names.begin(), names.end()).size() != names.size())
      return _scan.fail("L0021", name, "two propositions have one name",
                        "each proposition has a name of its own");
    _labels.set_propositions(names.size());
  }

  void acceptance(const HoaToken& name) {
    const auto count = number();
    const HoaToken word = _scan.take();
    if (word.text == "t") {
      _sets = Sets::All;
    } else if (word.text == "f") {
      _sets = Sets::None;
    } else if (word.text == "Inf" || word.text == "Fin") {
      _sets = word.text == "Inf" ? Sets::Infinite : Sets::Finite;
      const bool plain =
          _scan.accept('(') && number() == std::optional<std::uint32_t>(0) && _scan.accept(')');
      if (!plain) _sets.reset();
    }
    const bool more = _scan.sees('&') || _scan.sees('|');
    if (!_sets || more || !count || *count > 1)
      _scan.fail("L0024", name, "only the acceptances t, f, Inf(0) and Fin(0) can be told by finite words",
                 "write the automaton with another tool as a deterministic Buchi automaton");
  }

  void body() {
    std::vector<bool> defined;
    while (_scan.peek().kind == HoaTokenKind::Header && _scan.peek().text == "State") {
      const HoaToken at = _scan.take();
      std::optional<Diagram::Node> shared;
      if (_scan.sees('[')) shared = label();
      const auto state = number();
      if (!state || !want(*state, at)) return;
      defined.resize(std::max<std::size_t>(defined.size(), *state + 1), false);
      if (defined[*state])
        return _scan.fail("L0021", at, "state " + std::to_string(*state) + " is there twice",
                          "give each state one State:");
      defined[*state] = true;
      if (_scan.peek().kind == HoaTokenKind::Text) _scan.take();
      _marked.resize(_places.size(), false);
      _marked[*state] = marks();
      _places[*state] = at;
      edges(*state, shared);
    }
    if (_scan.failed()) return;
    if (_scan.peek().kind != HoaTokenKind::End) return _scan.fail_here("State: or --END--");
    defined.resize(_places.size(), false);
    const auto missing = std::find(defined.begin(), defined.end(), false);
    if (missing != defined.end())
      return _scan.fail("L0023", HoaToken(_scan.peek()),
                        "state " + std::to_string(missing - defined.begin()) + " has no State:",
                        "complete the automaton ('autfilt -C' does)");
  }

  void edges(std::uint32_t from, std::optional<Diagram::Node> shared) {
    // What is left of the letters: an edge may take only from it, and all of it must be taken.
    Diagram::Node left = Diagram::kTrue, after = Diagram::kFalse;
    std::uint64_t implicit = 0;
    const auto count = static_cast<std::uint32_t>(_read.automaton.propositions.size());
    while (_scan.peek().kind == HoaTokenKind::Number || _scan.sees('[')) {
      const HoaToken at = _scan.peek();
      Diagram::Node guard = shared.value_or(Diagram::kTrue);
      if (_scan.sees('[')) {
        guard = label();
      } else if (!shared) {
        if (count < 64 && implicit >> count != 0)
          return _scan.fail("L0022", at, "more edges than there are letters",
                            "without labels each letter has one edge");
        for (std::uint32_t k = 0; k < count; ++k) {
          const Diagram::Node holds = _diagram.variable(k);
          guard = _diagram.both(guard, (implicit >> k & 1) != 0 ? holds : _diagram.negation(holds));
        }
        ++implicit;
      }
      const auto to = number();
      if (!to || !want(*to, at)) return;
      if (_scan.sees('&'))
        return _scan.fail("L0025", at, "this edge leads to several states at once",
                          "alternation is not supported");
      if (_scan.sees('{'))
        return _scan.fail("L0024", HoaToken(_scan.peek()), "acceptance on an edge",
                          "write acceptance by states ('autfilt -S' does)");
      if (_diagram.both(guard, _diagram.negation(left)) != Diagram::kFalse)
        return _scan.fail("L0022", at, "a letter of this edge leads to another state as well",
                          "make it deterministic with another tool ('autfilt -D' does)");
      if (guard == Diagram::kFalse) continue;
      left = _diagram.both(left, _diagram.negation(guard));
      after = _diagram.choose(guard, _diagram.variable(count + *to), after);
      _edges.push_back({from, *to, at});
    }
    if (_diagram.exhausted())
      return _scan.fail("L0026", _places[from],
                        "the labels have more than " + std::to_string(_limits.nodes) + " nodes",
                        "write labels that ask for fewer propositions at once");
    if (_scan.failed()) return;
    if (left != Diagram::kFalse)
      return _scan.fail("L0023", _places[from],
                        "state " + std::to_string(from) + " has no edge for some letters",
                        "complete the automaton ('autfilt -C' does)");
    _after.resize(_places.size(), Diagram::kFalse);
    _after[from] = after;
  }

  // Whether states that accept are never left, or those that do not; and what that tells of each.
  void judge() {
    const std::size_t size = _places.size();
    std::vector<bool> accepts(size), others;
    for (std::size_t k = 0; k < size; ++k)
      accepts[k] = *_sets == Sets::All || (*_sets == Sets::Infinite && _marked[k]) ||
                   (*_sets == Sets::Finite && !_marked[k]);
    others = accepts;
    others.flip();
    Reach reach(size);
    const Edge *leaves = nullptr, *enters = nullptr;
    for (const Edge& each : _edges) {
      reach.add(each.from, each.to);
      if (accepts[each.from] && !accepts[each.to]) leaves = &each;
      if (!accepts[each.from] && accepts[each.to]) enters = &each;
    }
    if (leaves != nullptr && enters != nullptr)
      return _scan.fail("L0024", leaves->at,
                        "this edge leaves an accepting state, and others come back to one",
                        "finite words tell nothing here: acceptance must be for good, or lost for good");
    _read.part = leaves == nullptr && enters != nullptr ? HoaPart::Good : HoaPart::Bad;
    const bool good = _read.part == HoaPart::Good;
    const std::vector<bool> sure = reach.every(good ? accepts : others);
    const std::vector<bool> possible = reach.some(good ? accepts : others);
    Automaton& automaton = _read.automaton;
    automaton.initial = *_start;
    std::unordered_map<Diagram::Node, Guard> known;
    for (std::size_t k = 0; k < size; ++k) {
      automaton.edges.push_back(guard(_after[k], known));
      Verdict verdict = Verdict::Undecided;
      if (sure[k]) verdict = good ? Verdict::True : Verdict::False;
      if (!possible[k]) verdict = good ? Verdict::False : Verdict::True;
      automaton.verdicts.push_back(verdict);
    }
  }

  Guard guard(Diagram::Node node, std::unordered_map<Diagram::Node, Guard>& known) {
    const auto count = static_cast<std::uint32_t>(_read.automaton.propositions.size());
    if (_diagram.level(node) >= count) return guard_of_state(_diagram.level(node) - count);
    if (const auto found = known.find(node); found != known.end()) return found->second;
    const Guard low = guard(_diagram.low(node), known), high = guard(_diagram.high(node), known);
    const Guard made = _read.automaton.guards.make(_diagram.level(node), low, high);
    known.emplace(node, made);
    return made;
  }

  std::optional<std::uint32_t> number() {
    if (_scan.peek().kind == HoaTokenKind::Number) return _scan.take().number;
    _scan.fail_here("a number");
    return std::nullopt;
  }

  // A state that is spoken of exists.
  bool want(std::uint32_t state, const HoaToken& at) {
    if (state >= _limits.states) {
      _scan.fail("L0026", at, "more than " + std::to_string(_limits.states) + " states",
                 "minimise the automaton");
      return false;
    }
    if (state >= _places.size()) _places.resize(state + 1);
    return true;
  }

  Diagram::Node label() {
    _scan.take();
    const Diagram::Node read = _labels.read();
    if (!_scan.accept(']')) _scan.fail_here("']'");
    return read;
  }

  bool marks() {
    bool marked = false;
    if (!_scan.accept('{')) return marked;
    while (_scan.peek().kind == HoaTokenKind::Number) marked = _scan.take().number == 0 || marked;
    if (!_scan.accept('}')) _scan.fail_here("'}'");
    return marked;
  }

  const HoaLimits& _limits;
  HoaScanner _scan;
  Diagram _diagram;
  LabelReader _labels;
  HoaAutomaton _read;
  std::optional<std::uint32_t> _start;
  std::optional<Sets> _sets;
  std::vector<HoaToken> _places;  // of each state
  std::vector<bool> _marked;
  std::vector<Diagram::Node> _after;
  std::vector<Edge> _edges;
};

}  // namespace

result::Result<HoaAutomaton> read_hoa(std::string_view text, const std::string& file,
                                      const HoaLimits& limits) {
  return Reader(text, file, limits).run();
}

}  // namespace stepwright::ltl
