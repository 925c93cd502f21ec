#include "ladder/lowering/wire_types.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "ladder/graphic/identifier.h"
#include "ladder/syntax/piece.h"

namespace stepwright::lowering {
namespace {

using graphic::Element;
using graphic::ElementKind;
using graphic::Pin;
using graphic::same_name;
using syntax::TokenKind;

constexpr int kMaxDepth = 200;

// Wider types later; types of different families are not compared, the later one wins.
constexpr std::array<const char*, 20> ranks{"BOOL",  "SINT",   "USINT",   "BYTE", "INT",   "UINT",  "WORD",
                                            "DINT",  "UDINT",  "DWORD",   "LINT", "ULINT", "LWORD", "REAL",
                                            "LREAL", "STRING", "WSTRING", "TIME", "LTIME", "DATE"};

std::size_t rank_of(const std::string& type) {
  const auto found = std::find(ranks.begin(), ranks.end(), graphic::upper(type));
  return static_cast<std::size_t>(found - ranks.begin());
}

bool any_of(const std::string& name, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(), [&](const char* each) { return same_name(name, each); });
}

class Inference {
 public:
  Inference(const DiagramGraph& graph, const DiagramScope& scope) : graph_(graph), scope_(scope) {}

  std::string of(const Origin& origin, int depth) {
    if (origin.element == nullptr || depth > kMaxDepth) return {};
    switch (origin.element->kind) {
      case ElementKind::InVariable:
      case ElementKind::InOutVariable:
        return type_of_text(origin.element->name.text, scope_);
      case ElementKind::Block:
        return of_known_block(origin, depth);
      default:
        return "BOOL";
    }
  }

 private:
  // Each output is looked at once: in a loop it says nothing about itself.
  std::string of_known_block(const Origin& origin, int depth) {
    const std::pair key(origin.element, origin.output);
    const auto [found, is_new] = known_.try_emplace(key);
    if (!is_new) return found->second;
    return known_[key] = of_block(*origin.element, origin.output, depth);
  }

  std::string of_block(const Element& block, const std::string& output, int depth) {
    if (same_name(output, "ENO")) return "BOOL";
    for (const Pin& pin : block.in_outs)
      if (same_name(pin.name, output)) return of_pin(pin, depth);
    if (const Signature* signature = scope_.signature(block.name.text)) {
      for (const Parameter& each : signature->outputs)
        if (same_name(each.name, output)) return each.type;
      return signature->result;
    }
    return of_function(block, depth);
  }

  std::string of_function(const Element& block, int depth) {
    const std::string name = graphic::upper(block.name.text);
    if (any_of(name, {"GT", "GE", "EQ", "LE", "LT", "NE"})) return "BOOL";
    if (any_of(name, {"LEN", "FIND", "TRUNC"})) return name == "TRUNC" ? "DINT" : "INT";
    const std::size_t to = name.rfind("_TO_");
    if (to != std::string::npos) return name.substr(to + 4);
    if (name.rfind("TO_", 0) == 0) return name.substr(3);
    std::string widest;
    std::string literal;
    for (const Pin& pin : block.inputs) {
      const bool selects = same_name(pin.name, "EN") || same_name(pin.name, "G") ||
                           same_name(pin.name, "K") || same_name(pin.name, "N") || same_name(pin.name, "L") ||
                           same_name(pin.name, "P");
      const std::string type = selects ? "" : of_pin(pin, depth);
      if (type.empty()) continue;
      std::string& best = is_literal(pin) ? literal : widest;
      if (best.empty() || rank_of(type) > rank_of(best)) best = type;
    }
    if (widest.empty()) return literal;
    if (name == "SUB" && is_date(widest) && dates(block, depth) > 1) return "TIME";
    return literal == "REAL" && rank_of(widest) < rank_of("REAL") ? literal : widest;
  }

  static bool is_date(const std::string& type) {
    return any_of(type, {"DATE", "LDATE", "TOD", "LTOD", "TIME_OF_DAY", "DT", "LDT", "DATE_AND_TIME"});
  }

  // Inputs that are points in time: the difference of two is a duration (IEC 61131-3, table 35).
  std::ptrdiff_t dates(const Element& block, int depth) {
    return std::count_if(block.inputs.begin(), block.inputs.end(),
                         [&](const Pin& pin) { return is_date(of_pin(pin, depth)); });
  }

  bool is_literal(const Pin& pin) const {
    if (pin.connections.size() != 1) return false;
    const Origin origin = graph_.from(pin.connections.front());
    return origin.element != nullptr && origin.element->kind == ElementKind::InVariable &&
           scope_.type_of(origin.element->name.text).empty();
  }

  std::string of_pin(const Pin& pin, int depth) {
    if (pin.connections.empty()) return type_of_text(pin.expression.text, scope_);
    return of(graph_.from(pin.connections.front()), depth + 1);
  }

  const DiagramGraph& graph_;
  const DiagramScope& scope_;
  std::map<std::pair<const Element*, std::string>, std::string> known_;
};

std::string type_of_literal(const syntax::Token& token) {
  const bool is_long = graphic::upper(token.text.substr(0, 1)) == "L";
  switch (token.kind) {
    case TokenKind::Keyword:
      return token.is(syntax::Keyword::True) || token.is(syntax::Keyword::False) ? "BOOL" : "";
    case TokenKind::Integer:
      return "INT";
    case TokenKind::Real:
      return "REAL";
    case TokenKind::Time:
      return is_long ? "LTIME" : "TIME";
    case TokenKind::Date:
      return is_long ? "LDATE" : "DATE";
    case TokenKind::TimeOfDay:
      return is_long ? "LTOD" : "TOD";
    case TokenKind::DateAndTime:
      return is_long ? "LDT" : "DT";
    case TokenKind::String:
      return "STRING";
    case TokenKind::WideString:
      return "WSTRING";
    default:
      return {};
  }
}

}  // namespace

std::string type_of_text(const std::string& text, const DiagramScope& scope) {
  if (text.empty()) return {};
  const std::string known = scope.type_of(text);
  if (!known.empty()) return known;
  syntax::PieceReader reader;
  const std::vector<syntax::Token> tokens = reader.tokens(text);
  const bool sign = tokens[0].is(TokenKind::Minus) || tokens[0].is(TokenKind::Plus);
  const syntax::Token& first = tokens[sign ? 1 : 0];
  if (first.is(TokenKind::TypePrefix)) return std::string(first.text);
  return tokens.size() == (sign ? 3U : 2U) ? type_of_literal(first) : std::string();
}

std::string type_of(const Origin& origin, const DiagramGraph& graph, const DiagramScope& scope) {
  const std::string type = Inference(graph, scope).of(origin, 0);
  if (!type.empty()) return type;
  // A loop that no variable leads into: what it leads to knows.
  for (const Element* reader : graph.readers_of(origin))
    if (reader->kind == ElementKind::OutVariable)
      if (std::string written = scope.type_of(reader->name.text); !written.empty()) return written;
  return {};
}

}  // namespace stepwright::lowering
