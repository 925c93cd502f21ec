// STRING and WSTRING: the functions of table 34, comparison, assignment between lengths, arrays and
// structures of strings, strings through functions.

#include "tests/fuzz/st/extras/extra.h"

namespace stepwright::st_fuzz {

namespace {

class Strings : public Extra {
 public:
  explicit Strings(bool wide) : wide_(wide), letter_(wide ? "zw" : "zs") {}

  const char* name() const override { return wide_ ? "WSTRING" : "STRING"; }

  std::string before(Random&) const override {
    const std::string type = wide_ ? "WSTRING" : "STRING";
    const std::string dots = wide_ ? "\"..\"" : "'..'";
    return "FUNCTION " + letter_ + "join : " + type + "[12]\nVAR_INPUT a : " + type + "[8]; b : " + type +
           "; END_VAR\nVAR_IN_OUT c : " + type + "; END_VAR\n  " + letter_ + "join := CONCAT(a, " + dots +
           ", b); c := CONCAT(c, a);\nEND_FUNCTION\nTYPE " + letter_ + "pair : STRUCT n : INT; t : " + type +
           "[5]; END_STRUCT; END_TYPE\n";
  }

  std::string declarations(const Pou&, Random&) const override {
    const std::string type = wide_ ? "WSTRING" : "STRING";
    return "VAR " + letter_ + "1 : " + type + " := " + text("hello") + "; " + letter_ + "2 : " + type +
           "[7] := " + text("ab$$cd") + "; " + letter_ + "3 : " + type + "[1]; " + letter_ +
           "4 : ARRAY[0..2] OF " + type + "[9]; " + letter_ + "5 : " + letter_ + "pair; END_VAR\n";
  }

  std::string statement(Material& m) const override {
    switch (m.random.below(8)) {
      case 0:
        return number(m);
      case 1:
        return comparison(m);
      case 2:
        return variable(m) + " := " + letter_ + "join(" + source(m, 1) + ", " + source(m, 1) + ", " +
               letter_ + "1);";
      default:
        return variable(m) + " := " + source(m, 3) + ";";
    }
  }

 private:
  std::string text(const std::string& plain) const { return wide_ ? "\"" + plain + "\"" : "'" + plain + "'"; }

  std::string variable(Material& m) const {
    return letter_ + m.pick({"1", "1", "2", "3", "5.t", "4[" + m.between(Scalar::Int, 0, 2) + "]"});
  }

  std::string source(Material& m, int depth) const {
    if (depth == 0 || m.random.chance(25)) {
      return m.random.chance(75) ? variable(m) : text(m.pick({"", "l", "ab", "xyz", "0123456789"}));
    }
    const auto inner = [&] { return source(m, depth - 1); };
    const auto count = [&] { return m.between(Scalar::Int, 0, 9); };
    switch (m.random.below(10)) {
      case 0:
        return "LEFT(" + variable(m) + ", " + count() + ")";
      case 1:
        return "RIGHT(" + variable(m) + ", " + count() + ")";
      case 2:
        return "MID(" + variable(m) + ", " + count() + ", " + count() + ")";
      case 3:
        return "INSERT(" + variable(m) + ", " + inner() + ", " + count() + ")";
      case 4:
        return "DELETE(" + variable(m) + ", " + count() + ", " + count() + ")";
      case 5:
        return "REPLACE(" + variable(m) + ", " + inner() + ", " + count() + ", " + count() + ")";
      case 6:
        return "SEL(" + m.value(Scalar::Bool) + ", " + inner() + ", " + variable(m) + ")";
      case 7:
        return m.pick({"MAX", "MIN"}) + "(" + variable(m) + ", " + inner() + ")";
      default:
        return "CONCAT(" + inner() + ", " + variable(m) + (m.random.chance(30) ? ", " + inner() : "") + ")";
    }
  }

  std::string number(Material& m) const {
    const std::string to = m.target(Scalar::Int);
    if (to.empty()) return {};
    if (m.random.chance(50)) return to + " := LEN(" + source(m, 2) + ");";
    return to + " := FIND(" + source(m, 2) + ", " + source(m, 1) + ");";
  }

  std::string comparison(Material& m) const {
    const std::string to = m.target(Scalar::Bool);
    if (to.empty()) return {};
    return to + " := " + source(m, 1) + m.pick({" = ", " <> ", " < ", " >= "}) + variable(m) + ";";
  }

  bool wide_;
  std::string letter_;
};

}  // namespace

std::unique_ptr<Extra> strings() {
  return std::make_unique<Strings>(false);
}
std::unique_ptr<Extra> wide_strings() {
  return std::make_unique<Strings>(true);
}

}  // namespace stepwright::st_fuzz
