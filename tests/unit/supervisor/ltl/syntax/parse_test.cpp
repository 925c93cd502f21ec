#include <gtest/gtest.h>

#include <random>
#include <string>

#include "supervisor/ltl/syntax/formula.h"

namespace stepwright::ltl {
namespace {

std::string read(const std::string& text) {
  const auto formula = parse_formula(text);
  if (!formula) return result::to_string(formula.error());
  return to_text(formula->tree, formula->tree.root);
}

// "line:column code" of the refusal.
std::string refusal(const std::string& text) {
  const auto formula = parse_formula(text, "task.ltl");
  if (formula) return "read";
  const result::Diagnostic& first = formula.error().front();
  EXPECT_FALSE(first.hint.empty()) << first.message;
  EXPECT_EQ(first.where.file, "task.ltl");
  return std::to_string(first.where.line) + ":" + std::to_string(first.where.column) + " " + first.code;
}

TEST(Parse, Formula_WhenSpotWritesIt_ThenOperatorsBindAsInSpot) {
  EXPECT_EQ(read("a U b U c"), "a U (b U c)");
  EXPECT_EQ(read("!a U b & F c || d"), "!a U b & F c | d");
  EXPECT_EQ(read("a & (b | c)"), "a & (b | c)");
  EXPECT_EQ(read("a -> b -> c"), "a -> (b -> c)");
  EXPECT_EQ(read("a <-> b xor c"), "a <-> b xor c");
  EXPECT_EQ(read("GF a => \"station 1\" M ~b"), "G F a -> \"station 1\" M !b");
  EXPECT_EQ(read("true & 0 | 1 && false"), "1 & 0 | 1 & 0");
  EXPECT_EQ(read("a R b W X c"), "a R (b W X c)");
}

TEST(Parse, Formula_WhenPrinted_ThenItIsReadAgainAsTheSame) {
  for (const char* text :
       {"(a U b) U c", "!(a & b) -> G(a | F b)", "X X (a xor b)", "(a -> b) -> c", "\"a b\" & \"F\""})
    EXPECT_EQ(read(read(text)), read(text)) << text;
}

TEST(Parse, Formula_WhenWrittenInWords_ThenItIsTheFormulaOfThem) {
  EXPECT_EQ(read("visit press then (visit rack1 and visit rack2), never wash before unload"),
            "F (press & (F rack1 & F rack2)) & !wash W unload");
  EXPECT_EQ(read("a before b"), "!b U a");
  EXPECT_EQ(read("visit a before visit b"), "!b U a");
  EXPECT_EQ(read("a then b then c"), "F (a & F (b & F c))");
  EXPECT_EQ(read("never a, always not b, a until b, a unless b"), "G !a & G !b & a U b & a W b");
  EXPECT_EQ(read("eventually next a implies b or c"), "F X a -> b | c");
}

TEST(Parse, Address_WhenItIsAName_ThenItStandsInQuotes) {
  EXPECT_EQ(read("never \"%IX0.3\""), "G !\"%IX0.3\"");
  EXPECT_EQ(refusal("never %IX0.3"), "1:7 L0001");
}

TEST(Parse, Before_WhenAFormulaStandsBesideIt_ThenOnlyTheWordVisitMeansItsPlace) {
  EXPECT_EQ(read("(visit a) before b"), "!b U a");
  EXPECT_EQ(read("never visit b before visit a"), "!b W a");
  EXPECT_EQ(read("b before F a"), "!F a U b");
  EXPECT_EQ(read("eventually a before b"), "!b U F a");
  EXPECT_EQ(read("F F b before a"), "!a U F F b");
  EXPECT_EQ(read("!F b before a"), "!a U !F b");
  EXPECT_EQ(read("b before G a"), "!G a U b");
  EXPECT_EQ(read("never F b before a"), "!F b W a");
  EXPECT_EQ(read("visit visit a before b"), "!b U F a");
  EXPECT_EQ(read("(visit a and visit b) before c"), "!c U (F a & F b)");
  EXPECT_EQ(read("never visit a"), "G !F a");
}

TEST(Parse, Deadline_WhenWritten_ThenATimerMakesAPropositionOfIt) {
  EXPECT_EQ(read("s responds to p within T#5s"), "G !\"p since T#5s without s\"");
  EXPECT_EQ(read("visit p within T#1m30s"), "!\"T#1m30s over\" U p");
  EXPECT_EQ(read("never p for T#250ms"), "G !\"p for T#250ms\"");
  EXPECT_EQ(read("(a & !b) for T#2s before c"), "!c U \"a & !b for T#2s\"");
  EXPECT_EQ(read("a & b # T#5s is a comment here\n| c"), "a & b | c");
  EXPECT_EQ(read("T & within & for"), "T & within & for") << "names as before";
  const auto formula = parse_formula("never (p for T#1s) for T#1.5s, p for T#1s precedes q");
  ASSERT_TRUE(formula) << result::to_string(formula.error());
  ASSERT_EQ(formula->tree.timed.size(), 2u) << "equal timers are one";
  EXPECT_EQ(formula->tree.timed[0].duration_ns, 1'000'000'000);
  EXPECT_EQ(formula->tree.timed[1].duration_ns, 1'500'000'000);
  EXPECT_EQ(formula->tree.propositions[formula->tree.timed[0].proposition], "p for T#1s");
}

TEST(Parse, Deadline_WhenItCannotBeMeant_ThenRefusedAtItsPlace) {
  EXPECT_EQ(refusal("never p for T#0s"), "1:13 L0008");
  EXPECT_EQ(refusal("never p for T#1s1m"), "1:13 L0008");
  EXPECT_EQ(refusal("never p for T#2000h"), "1:13 L0008");
  EXPECT_EQ(refusal("never p for T#5x"), "1:13 L0008");
  EXPECT_EQ(refusal("never (F p) for T#5s"), "1:7 L0008");
  EXPECT_EQ(refusal("(F s) responds to p within T#5s"), "1:1 L0008");
  EXPECT_EQ(refusal("after q: s responds to p within T#5s"), "1:26 L0008");
  EXPECT_EQ(refusal("\"p for T#5s\" & p for T#5s"), "1:16 L0008");
  EXPECT_EQ(refusal("p T#5s"), "1:3 L0002");
}

TEST(Parse, Deadline_WhenItIsOfAFormulaThatSpeaksOfLaterLetters_ThenThatPartIsBlamed) {
  EXPECT_EQ(refusal("a then b within T#1s"), "1:3 L0008");
  EXPECT_EQ(refusal("never a within T#1s"), "1:1 L0008");
  EXPECT_EQ(refusal("visit a and b within T#1s"), "1:1 L0008");
  EXPECT_EQ(refusal("a U b within T#1s"), "1:3 L0008");
  EXPECT_EQ(refusal("X a within T#1s"), "1:1 L0008");
  EXPECT_EQ(refusal("F F a within T#1s"), "1:3 L0008");
  EXPECT_EQ(refusal("a, visit (p & F q) within T#1s"), "1:15 L0008");
  EXPECT_EQ(refusal("(s responds to p) within T#1s"), "1:2 L0008");
  EXPECT_EQ(refusal("(p within T#5s) within T#1s"), "1:2 L0008");
  const auto refused = parse_formula("visit (a & X b) within T#1s");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().front().message.find("'X b'"), std::string::npos);
  EXPECT_EQ(read("visit (a & !b) within T#1s"), "!\"T#1s over\" U (a & !b)");
  EXPECT_EQ(read("F a within T#1s, b for T#1s within T#2s"),
            "!\"T#1s over\" U a & !\"T#2s over\" U \"b for T#1s\"");
}

TEST(Parse, Refusal_WhenTheTextIsWrong_ThenTheFirstPlaceIsNamed) {
  EXPECT_EQ(refusal("a &\n  & b"), "2:3 L0002");
  EXPECT_EQ(refusal(""), "1:1 L0002");
  EXPECT_EQ(refusal("(a | b"), "1:7 L0002");
  EXPECT_EQ(refusal("a b"), "1:3 L0002");
  EXPECT_EQ(refusal("a $ b"), "1:3 L0001");
  EXPECT_EQ(refusal("a & \xC3\xA4"), "1:5 L0001");
  EXPECT_EQ(refusal("a & \"b\n\""), "1:5 L0003");
  EXPECT_EQ(refusal("(visit a and visit b) then c"), "1:23 L0007");
  EXPECT_EQ(refusal("before r: a"), "1:12 L0002");
  EXPECT_EQ(refusal("between q r: absent a"), "1:11 L0002");
  EXPECT_EQ(refusal("before & a"), "1:8 L0002");
}

TEST(Parse, Refusal_WhenABoundIsMet_ThenItIsNamed) {
  const std::string deep(100'000, '(');
  EXPECT_EQ(refusal(deep).substr(refusal(deep).size() - 5), "L0004");
  EXPECT_EQ(refusal(std::string(100'000, '!') + "a").substr(0, 2), "1:");
  const auto formula = parse_formula(deep);
  ASSERT_FALSE(formula);
  EXPECT_NE(formula.error().front().message.find("1000"), std::string::npos);

  std::string wide = "a";
  for (int k = 0; k < 10'000; ++k) wide += " xor a";
  EXPECT_TRUE(parse_formula(wide));
  for (int k = 0; k < 10'001; ++k) wide += " xor a";
  const auto many = parse_formula(wide);
  ASSERT_FALSE(many);
  EXPECT_EQ(many.error().front().code, "L0005");

  std::string names = "p0";
  for (int k = 1; k < 64; ++k) names += " & p" + std::to_string(k);
  EXPECT_TRUE(parse_formula(names));
  const auto too_many = parse_formula(names + " & p64");
  ASSERT_FALSE(too_many);
  EXPECT_EQ(too_many.error().front().code, "L0006");
}

TEST(Parse, Formula_WhenEquivalencesAreNested_ThenTheNormalFormStaysSmall) {
  std::string text = "a0";
  for (int k = 1; k < 60; ++k) text += " <-> F a" + std::to_string(k);
  const auto formula = parse_formula(text);
  ASSERT_TRUE(formula);
  EXPECT_LT(formula->terms.size(), 1'000u);
}

// Trees as deep as the bound on operators allows: lists that bind to the left.
TEST(Parse, Formula_WhenItIsThousandsOfOperatorsDeep_ThenItIsPrintedNegatedAndBlamed) {
  std::string text = "G a";
  for (int k = 0; k < 9'000; ++k) text += k % 2 == 0 ? " xor b" : " xor F a";
  const auto formula = parse_formula(text);
  ASSERT_TRUE(formula);
  EXPECT_TRUE(to_text(formula->tree, formula->tree.root) == text);
  EXPECT_EQ(classify(formula->terms, formula->root), Class::Mix);
  EXPECT_EQ(to_text(formula->tree, not_cosafe_part(*formula)), "G a");
  Terms terms = formula->terms;
  EXPECT_EQ(terms.dual(terms.dual(formula->root)), formula->root);
}

TEST(Parse, Text_WhenRandomBytesOrWords_ThenReadOrRefused) {
  std::mt19937 random(7);
  const std::vector<std::string> words = {"a",        "b",        "(",     ")",     "U",   "W",     "visit",
                                          "then",     "before",   "after", ":",     "and", "until", "between",
                                          "precedes", "responds", "to",    "never", ",",   "!",     "X",
                                          "GF",       "\"",       "->",    "1"};
  int read_ones = 0;
  for (int round = 0; round < 20'000; ++round) {
    std::string text;
    for (auto k = random() % 12; k > 0; --k)
      text += round % 4 == 0 ? std::string(1, static_cast<char>(random() % 256))
                             : words[random() % words.size()] + " ";
    const auto formula = parse_formula(text);
    if (formula) ++read_ones;
    ASSERT_TRUE(formula.has_value() || !formula.error().front().hint.empty());
  }
  EXPECT_GT(read_ones, 100);
}

TEST(Classify, Formula_WhenOperatorsAreMixed_ThenItsClassIsRight) {
  const auto kind = [](const std::string& text) {
    const auto formula = parse_formula(text);
    return classify(formula->terms, formula->root);
  };
  EXPECT_EQ(kind("F a & !(G b)"), Class::CoSafe);
  EXPECT_EQ(kind("G a & !(F b) & a W b"), Class::Safe);
  EXPECT_EQ(kind("G a | F b"), Class::Mix);
  EXPECT_EQ(kind("G F a"), Class::Neither);
  EXPECT_EQ(kind("a & !b"), Class::CoSafe);
}

TEST(Blame, Part_WhenAFormulaIsNotCoSafe_ThenItIsTheOperatorThatAsksForever) {
  const auto part = [](const std::string& text) {
    const auto formula = parse_formula(text);
    return to_text(formula->tree, not_cosafe_part(*formula));
  };
  EXPECT_EQ(part("F a & (F b -> F c)"), "F b");
  EXPECT_EQ(part("F a & !F(G b & !F c)"), "F (G b & !F c)");
  EXPECT_EQ(part("visit a, never b"), "G !b");
}

}  // namespace
}  // namespace stepwright::ltl
