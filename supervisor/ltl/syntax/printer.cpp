#include <variant>

#include "supervisor/ltl/syntax/lexer.h"
#include "supervisor/ltl/syntax/syntax_tree.h"

namespace stepwright::ltl {

namespace {

struct Sign {
  const char* text;
  int binding;  // the larger, the closer
};

Sign sign(Operator op) {
  switch (op) {
    case Operator::False:
      return {"0", 9};
    case Operator::True:
      return {"1", 9};
    case Operator::Name:
      return {"", 9};
    case Operator::Not:
      return {"!", 8};
    case Operator::Next:
      return {"X ", 8};
    case Operator::Eventually:
      return {"F ", 8};
    case Operator::Always:
      return {"G ", 8};
    case Operator::Until:
      return {" U ", 6};
    case Operator::Release:
      return {" R ", 6};
    case Operator::WeakUntil:
      return {" W ", 6};
    case Operator::StrongRelease:
      return {" M ", 6};
    case Operator::And:
      return {" & ", 5};
    case Operator::Or:
      return {" | ", 4};
    case Operator::Xor:
      return {" xor ", 3};
    case Operator::Implies:
      return {" -> ", 2};
    case Operator::Iff:
      return {" <-> ", 2};
  }
  return {"", 9};
}

std::string name_text(const std::string& name) {
  if (is_plain_name(name)) return name;
  std::string text = "\"";
  for (const char each : name) {
    if (each == '"' || each == '\\') text += '\\';
    text += each;
  }
  return text + "\"";
}

}  // namespace

// A list of what is still to be written takes the place of recursion: trees may be deep.
std::string to_text(const SyntaxTree& tree, SyntaxId from, std::size_t most) {
  using Piece = std::variant<SyntaxId, const char*>;
  std::vector<Piece> open = {from};
  std::string text;
  while (!open.empty()) {
    const Piece piece = open.back();
    open.pop_back();
    if (const auto* word = std::get_if<const char*>(&piece)) {
      text += *word;
    } else {
      const SyntaxNode& node = tree.nodes[std::get<SyntaxId>(piece)];
      const Sign own = sign(node.op);
      if (node.op == Operator::Name) text += name_text(tree.propositions[node.proposition]);
      if (node.children.empty() || own.binding == 8) text += own.text;
      for (std::size_t k = node.children.size(); k-- > 0;) {
        const Operator inner = tree.nodes[node.children[k]].op;
        const bool closer = sign(inner).binding > (own.binding == 8 ? 7 : own.binding) ||
                            (k == 0 && inner == Operator::Xor && node.op == Operator::Xor);
        if (!closer) open.emplace_back(")");
        open.emplace_back(node.children[k]);
        if (!closer) open.emplace_back("(");
        if (k > 0) open.emplace_back(own.text);
      }
    }
    if (text.size() > most) return text.substr(0, most) + "...";
  }
  return text;
}

}  // namespace stepwright::ltl
