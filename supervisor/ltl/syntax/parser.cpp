#include "supervisor/ltl/syntax/parser.h"

#include <algorithm>
#include <array>
#include <utility>

#include "supervisor/ltl/syntax/duration.h"

namespace stepwright::ltl {

namespace {

constexpr std::array<std::pair<const char*, Pattern>, 3> kOfOne = {
    {{"absent", Pattern::Absence}, {"exists", Pattern::Existence}, {"holds", Pattern::Universality}}};

bool is_temporal(Operator op) {
  return op == Operator::Next || op == Operator::Eventually || op == Operator::Always ||
         op >= Operator::Until;
}

// The first part, as it was written, whose operator speaks of later letters; without one all of it. A list
// takes the place of recursion: trees may be deep.
SyntaxId temporal_part(const SyntaxTree& tree, SyntaxId root) {
  std::vector<SyntaxId> open = {root};
  while (!open.empty()) {
    const SyntaxId id = open.back();
    open.pop_back();
    const SyntaxNode& node = tree.nodes[id];
    if (is_temporal(node.op)) return id;
    open.insert(open.end(), node.children.rbegin(), node.children.rend());
  }
  return root;
}

}  // namespace

enum class Parser::Side : std::uint8_t { Left, Right, List };
enum class Parser::Meaning : std::uint8_t { Operator, Before, Then };

struct Parser::Binary {
  std::string_view word;
  int binding;  // the larger, the closer
  Side side;
  Operator op;
  Meaning meaning = Meaning::Operator;
};

const std::array<Parser::Binary, 18> Parser::kBinary = {
    {{"->", 1, Side::Right, Operator::Implies},
     {"implies", 1, Side::Right, Operator::Implies},
     {"<->", 1, Side::Right, Operator::Iff},
     {"iff", 1, Side::Right, Operator::Iff},
     {"xor", 2, Side::Left, Operator::Xor},
     {"|", 3, Side::List, Operator::Or},
     {"or", 3, Side::List, Operator::Or},
     {"&", 4, Side::List, Operator::And},
     {"and", 4, Side::List, Operator::And},
     {"U", 5, Side::Right, Operator::Until},
     {"until", 5, Side::Right, Operator::Until},
     {"W", 5, Side::Right, Operator::WeakUntil},
     {"unless", 5, Side::Right, Operator::WeakUntil},
     {"R", 5, Side::Right, Operator::Release},
     {"release", 5, Side::Right, Operator::Release},
     {"M", 5, Side::Right, Operator::StrongRelease},
     {"before", 5, Side::Right, Operator::Until, Meaning::Before},
     {"then", 5, Side::Right, Operator::Eventually, Meaning::Then}}};

// One nesting more as long as it lives.
class Parser::Level {
 public:
  explicit Level(Parser& parser) : parser_(parser) {
    if (++parser_.depth_ > parser_.limits_.nesting) parser_.too_deep();
  }
  ~Level() { --parser_.depth_; }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;

 private:
  Parser& parser_;
};

Parser::Parser(std::vector<Token> tokens, std::string file, std::vector<std::string> propositions,
               const TextLimits& limits)
    : tokens_(std::move(tokens)), file_(std::move(file)), limits_(limits) {
  tree_.propositions = std::move(propositions);
}

result::Result<SyntaxTree> Parser::run() {
  tree_.root = sentences();
  if (peek().kind != TokenKind::End) fail_here("an operator or the end", "each ( needs its )");
  if (error_) return tl::unexpected<result::Diagnostics>(std::move(*error_));
  return std::move(tree_);
}

bool Parser::sees(std::string_view text) const {
  const Token& token = peek();
  return token.kind != TokenKind::Quoted && token.kind != TokenKind::End && token.text == text;
}

bool Parser::accept(std::string_view text) {
  if (!sees(text)) return false;
  ++at_;
  return true;
}

void Parser::expect(const char* text, const char* hint) {
  if (!accept(text)) fail_here(("'" + std::string(text) + "'").c_str(), hint);
}

void Parser::fail(const char* code, Place at, std::string message, std::string hint) {
  if (error_) return;
  error_ = result::fail(code, {file_, at.line, at.column}, std::move(message), std::move(hint)).value();
}

void Parser::fail_here(const char* wanted, const char* hint) {
  const Token& token = peek();
  const std::string seen = token.kind == TokenKind::End ? "the end of the text" : "'" + token.text + "'";
  fail("L0002", token.at, "here should stand " + std::string(wanted) + ", not " + seen, hint);
}

void Parser::too_deep() {
  const std::string bound = std::to_string(limits_.nesting);
  fail("L0004", peek().at, "more than " + bound + " operators and parentheses in each other",
       "write a list with & or | in place of nested operators");
}

// After an error nothing is added: the children may not be there.
SyntaxId Parser::add(Operator op, std::vector<SyntaxId> children, Place at) {
  if (error_) return 0;
  if (op != Operator::Name && !count_operators(1, at)) return 0;
  temporal_.resize(tree_.nodes.size(), true);  // those of patterns
  bool temporal = is_temporal(op);
  for (const SyntaxId each : children) temporal = temporal || temporal_[each];
  temporal_.push_back(temporal);
  return tree_.add(op, std::move(children), at);
}

bool Parser::count_operators(std::size_t more, Place at) {
  operators_ += more;
  if (operators_ <= limits_.operators) return true;
  fail("L0005", at, "more than " + std::to_string(limits_.operators) + " operators",
       "divide the formula, each part with an automaton of its own");
  return false;
}

SyntaxId Parser::name(const Token& token) {
  if (error_) return 0;
  const auto known = std::ranges::find(tree_.propositions, token.text);
  const auto number = static_cast<std::uint32_t>(known - tree_.propositions.begin());
  if (known == tree_.propositions.end()) {
    if (number == limits_.propositions) {
      fail("L0006", token.at, "more than " + std::to_string(limits_.propositions) + " propositions",
           "divide the formula, or give what is always named together one name");
      return 0;
    }
    tree_.propositions.push_back(token.text);
  }
  const SyntaxId node = add(Operator::Name, {}, token.at);
  tree_.nodes[node].proposition = number;
  return node;
}

SyntaxId Parser::sentences() {
  const Place at = peek().at;
  std::vector<SyntaxId> parts = {sentence()};
  while (accept(",")) parts.push_back(sentence());
  return parts.size() == 1 ? parts.front() : add(Operator::And, std::move(parts), at);
}

SyntaxId Parser::sentence() {
  if (sees("globally") || sees("before") || sees("after") || sees("between")) return pattern(scope(), true);
  return pattern({}, false);
}

Scope Parser::scope() {
  Scope scope;
  if (accept("before")) {
    scope.kind = ScopeKind::Before;
    scope.end = unary();
  } else if (accept("after")) {
    scope.kind = ScopeKind::After;
    scope.begin = unary();
    if (accept("until")) {
      scope.kind = ScopeKind::AfterUntil;
      scope.end = unary();
    }
  } else if (accept("between")) {
    scope.kind = ScopeKind::Between;
    scope.begin = unary();
    expect("and", "between q and r: ...");
    scope.end = unary();
  } else {
    accept("globally");
  }
  expect(":", "a scope ends in a colon: 'after q: absent p'; formulas of several words stand in parentheses");
  return scope;
}

SyntaxId Parser::pattern(const Scope& scope, bool scoped) {
  const Place at = peek().at;
  for (const auto& [word, kind] : kOfOne) {
    if (!accept(word)) continue;
    const SyntaxId subject = formula();
    return patterned(kind, scope, subject, subject, at);
  }
  const SyntaxId first = formula();
  if (accept("precedes")) {
    const SyntaxId subject = formula();
    return patterned(Pattern::Precedence, scope, subject, first, at);
  }
  if (accept("responds")) {
    if (peek().kind == TokenKind::Word && peek().text == "to") ++at_;
    const SyntaxId subject = formula();
    if (!times("within")) return patterned(Pattern::Response, scope, subject, first, at);
    if (scoped) fail("L0008", peek().at, "a scope has no deadline", "leave the scope out");
    const SyntaxId overdue = timed(TimedKind::Overdue, subject, first, at);
    return add(Operator::Always, {add(Operator::Not, {overdue}, at)}, at);
  }
  if (times("within")) {
    if (scoped) fail("L0008", peek().at, "a scope has no deadline", "leave the scope out");
    return within(first, at);
  }
  if (scoped) fail_here("a pattern", "absent p; exists p; holds p; s precedes p; s responds to p");
  return first;
}

SyntaxId Parser::patterned(Pattern pattern, const Scope& scope, SyntaxId subject, SyntaxId other, Place at) {
  if (error_) return 0;
  const std::size_t before = tree_.nodes.size();
  const SyntaxId root = add_pattern(tree_, pattern, scope, subject, other, at);
  return count_operators(tree_.nodes.size() - before, at) ? root : 0;
}

// The operator that stands here, if it is one between two operands.
const Parser::Binary* Parser::binary_operator() const {
  const auto found = std::ranges::find_if(kBinary, [&](const Binary& each) { return sees(each.word); });
  return found == kBinary.end() ? nullptr : &*found;
}

// Operands and operators that bind at least as close as `least`, in one function for all of them: what stands
// in parentheses costs a few frames of the stack, not one for each kind of operator.
SyntaxId Parser::formula(int least) {
  SyntaxId left = unary();
  for (const Binary* found = binary_operator(); found != nullptr && found->binding >= least;
       found = binary_operator()) {
    const Place at = peek().at;
    switch (found->side) {
      case Side::List:
        left = list(left, *found, at);
        break;
      case Side::Left:
        ++at_;
        left = joined(*found, left, formula(found->binding + 1), at);
        break;
      case Side::Right:
        ++at_;
        left = joined(*found, left, right_side(found->binding), at);
        break;
    }
  }
  return left;
}

SyntaxId Parser::list(SyntaxId first, const Binary& found, Place at) {
  std::vector<SyntaxId> parts = {first};
  for (const Binary* next = &found; next != nullptr && next->op == found.op; next = binary_operator()) {
    ++at_;
    parts.push_back(formula(found.binding + 1));
  }
  return add(found.op, std::move(parts), at);
}

SyntaxId Parser::right_side(int binding) {
  const Level level(*this);
  return formula(binding);
}

SyntaxId Parser::joined(const Binary& found, SyntaxId left, SyntaxId right, Place at) {
  if (found.meaning == Meaning::Before) return before(left, right, at);
  if (found.meaning == Meaning::Then) return then(left, right, at);
  return add(found.op, {left, right}, at);
}

SyntaxId Parser::unary() {
  const Level level(*this);
  const Place at = peek().at;
  if (accept("!") || accept("not")) return add(Operator::Not, {unary()}, at);
  if (accept("X") || accept("next")) return add(Operator::Next, {unary()}, at);
  if (accept("F") || accept("eventually")) return add(Operator::Eventually, {unary()}, at);
  if (accept("visit")) {
    const SyntaxId visit = add(Operator::Eventually, {unary()}, at);
    visits_.insert(visit);
    return visit;
  }
  if (accept("G") || accept("always")) return add(Operator::Always, {unary()}, at);
  if (accept("never") || accept("avoid")) {
    const SyntaxId avoided = unary();
    if (!accept("before")) return add(Operator::Always, {add(Operator::Not, {avoided}, at)}, at);
    const SyntaxId no = add(Operator::Not, {point(avoided)}, at);
    return add(Operator::WeakUntil, {no, point(unary())}, at);
  }
  return primary();
}

SyntaxId Parser::primary() {
  const Token& token = peek();
  if (accept("(")) {
    const SyntaxId inner = sentences();
    expect(")", "each ( needs its )");
    return times("for") ? timed(TimedKind::Held, inner, inner, token.at) : inner;
  }
  if (accept("true") || accept("1")) return add(Operator::True, {}, token.at);
  if (accept("false") || accept("0")) return add(Operator::False, {}, token.at);
  if (token.kind == TokenKind::Quoted || (token.kind == TokenKind::Word && !is_reserved(token.text))) {
    ++at_;
    const SyntaxId named = name(token);
    return times("for") ? timed(TimedKind::Held, named, named, token.at) : named;
  }
  fail_here("a proposition or a formula", "a name that is a word of the language stands in quotes");
  return 0;
}

bool Parser::times(std::string_view word) const {
  const Token& token = peek();
  return token.kind == TokenKind::Word && token.text == word && tokens_[at_ + 1].kind == TokenKind::Duration;
}

SyntaxId Parser::timed(TimedKind kind, SyntaxId of, SyntaxId answer, Place at) {
  if (error_) return 0;
  const Token duration = tokens_[at_ + 1];
  at_ += 2;
  const auto ns = duration_ns(duration.text);
  if (!ns) {
    fail("L0008", duration.at, "'" + duration.text + "' is no duration between 1 ms and 1,000 hours",
         "for example T#5s or T#1m30s; units are d, h, m, s and ms, from the largest to the smallest");
    return 0;
  }
  if (kind != TimedKind::Elapsed && (speaks_of_later(of) || speaks_of_later(answer))) {
    fail("L0008", at, "a timer looks at one instant, and this speaks of later ones",
         "name what a single scan can see, such as (a & !b)");
    return 0;
  }
  std::string text = duration.text;
  if (kind == TimedKind::Elapsed) {
    text += " over";
  } else {
    text = to_text(tree_, of, 200) + (kind == TimedKind::Held ? " for " + text : " since " + text);
    if (kind == TimedKind::Overdue) text += " without " + to_text(tree_, answer, 200);
  }
  const bool known = std::ranges::find(tree_.propositions, text) != tree_.propositions.end();
  const SyntaxId node = name({TokenKind::Quoted, text, at});
  if (error_) return 0;
  const std::uint32_t proposition = tree_.nodes[node].proposition;
  if (!known) {
    tree_.timed.push_back({proposition, kind, of, answer, *ns, duration.text, at});
  } else if (timed_of(tree_, proposition) == nullptr) {
    fail("L0008", at, "there is a proposition '" + text + "', which is what this timer would be called",
         "give the proposition another name");
  }
  return node;
}

// What is reached does not come later than the deadline: the first scan at or behind it still counts. A later
// part of a formula would have no deadline, so that there must be none.
SyntaxId Parser::within(SyntaxId first, Place at) {
  if (error_) return 0;
  const SyntaxId reached = visited(first);
  if (speaks_of_later(reached)) {
    const SyntaxId blamed = temporal_part(tree_, reached);
    fail("L0008", tree_.nodes[blamed].at,
         "a deadline is that of one instant, and '" + to_text(tree_, blamed, 60) + "' speaks of later ones",
         "one visit of what a single scan can see: 'visit (a & b) within T#5s'");
    return 0;
  }
  const SyntaxId over = timed(TimedKind::Elapsed, reached, reached, at);
  return add(Operator::Until, {add(Operator::Not, {over}, at), reached}, at);
}

// What `visit a` or `a` asks to be reached: a. Others are left as they are.
SyntaxId Parser::visited(SyntaxId node) const {
  if (error_ || tree_.nodes[node].op != Operator::Eventually) return node;
  return tree_.nodes[node].children.front();
}

// Nodes that the parser did not add itself are those of patterns.
bool Parser::speaks_of_later(SyntaxId node) const {
  return node >= temporal_.size() || temporal_[node];
}

// Beside `before` the word `visit` means what is visited. All others, `F a` as well, stay the formulas that
// they are.
SyntaxId Parser::point(SyntaxId node) const {
  return visits_.contains(node) ? visited(node) : node;
}

SyntaxId Parser::before(SyntaxId first, SyntaxId later, Place at) {
  if (error_) return 0;
  const SyntaxId no = add(Operator::Not, {point(later)}, at);
  return add(Operator::Until, {no, point(first)}, at);
}

SyntaxId Parser::then(SyntaxId first, SyntaxId later, Place at) {
  if (error_) return 0;
  const SyntaxId reached = visited(first);
  if (speaks_of_later(reached)) {
    fail("L0007", at, "before 'then' stands one visit, not '" + to_text(tree_, first, 60) + "'",
         "name what is reached first: 'visit a then (visit b and visit c)'");
    return 0;
  }
  if (!speaks_of_later(later)) later = add(Operator::Eventually, {later}, at);
  return add(Operator::Eventually, {add(Operator::And, {reached, later}, at)}, at);
}

}  // namespace stepwright::ltl
