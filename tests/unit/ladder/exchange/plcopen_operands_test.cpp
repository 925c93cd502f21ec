// The texts of drawn elements: an expression on a contact or a transition keeps together wherever it stands,
// and what is no name, variable or expression is refused at its place.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "ladder/exchange/plcopen_reader.h"
#include "tests/unit/ladder/exchange/drawn_elements.h"
#include "tests/unit/ladder/exchange/plcopen_samples.h"

namespace stepwright::exchange {
namespace {

using ::testing::HasSubstr;

TEST(DrawnOperands, WhenAContactHoldsAnExpression_ThenItKeepsTogether) {
  const std::string body =
      contact(2, 50, 10, "1", "a OR b") + contact(3, 100, 10, "2", "c") + coil(4, 200, 10, "3", "series") +
      contact(5, 50, 60, "1", "a OR b", " negated=\"true\"") + coil(6, 200, 60, "5", "no") +
      contact(7, 50, 110, "1", "a OR b", " edge=\"rising\"") + coil(8, 200, 110, "7", "rise") +
      contact(9, 50, 160, "1", "a OR b", " edge=\"falling\"") + coil(10, 200, 160, "9", "fall") +
      contact(11, 50, 210, "1", "a OR b (* c *) // and") + contact(12, 100, 210, "11", "a = b") +
      coil(13, 200, 210, "12", "both", " negated=\"true\"");
  EXPECT_EQ(run(ladder(bools("a b c series no rise fall both"), body), "a b c", "|a|a b|b c|c|",
                "series no rise fall both"),
            "01001 00101 00000 10001 01011");
}

TEST(DrawnOperands, WhenABlockReadsExpressions_ThenEachIsOneArgument) {
  const std::string body = contact(2, 50, 10, "1", "a") + input(3, 50, 40, "n + 1 (* ) *)") +
                           input(4, 50, 60, "SEL(b, 2, 3) // , 4") +
                           block(5, 120, 10, "MUL", "EN=2 IN1=3 IN2=4", "ENO OUT") +
                           output(6, 220, 40, "5:OUT", "n");
  EXPECT_EQ(run(ladder(bools("a b") + ints("n"), body), "a b", "a|a|a b|", "n"), "2 6 21");
}

TEST(DrawnOperands, WhenABlockIsOfANamespace_ThenItsFullNameSaysSo) {
  const std::string body = contact(2, 50, 10, "1", "a") + input(3, 50, 40, "n") +
                           block(5, 120, 10, "Plant.Parts.Twice", "EN=2 v=3", "ENO OUT") +
                           input(6, 220, 60, "3") + block(7, 320, 10, "ADD", "IN1=5:OUT IN2=6", "OUT") +
                           output(8, 420, 40, "7:OUT", "n");
  const std::string text =
      "NAMESPACE Plant TYPE Count : INT; END_TYPE NAMESPACE Parts FUNCTION Twice : Count\n"
      "VAR_INPUT v : Count; END_VAR\nTwice := v * 2; END_FUNCTION END_NAMESPACE END_NAMESPACE";
  EXPECT_EQ(run(ladder(bools("a") + ints("n"), body), "a", "a|a", "n", text), "3 9");
}

// Step Low, the transition, step High, which nothing leaves; "q" is driven while High is active.
std::string chart(const std::string& condition, const std::string& action = "<reference name=\"q\"/>") {
  const std::string body =
      "<SFC>\n" +
      at("step", 1, 0, 0, "<connectionPointOut formalParameter=\"\"/>",
         " name=\"Low\" initialStep=\"true\"") +
      at("transition", 2, 0, 20, in("1") + "<connectionPointOut/><condition>" + condition + "</condition>") +
      at("step", 3, 0, 40,
         in("2") +
             "<connectionPointOut formalParameter=\"\"/>"
             "<connectionPointOutAction formalParameter=\"\"/>",
         " name=\"High\"") +
      at("transition", 5, 0, 60,
         in("3") + "<connectionPointOut/><condition><reference name=\"never\"/></condition>") +
      at("jumpStep", 6, 0, 80, in("5"), " targetName=\"Low\"") +
      at("actionBlock", 4, 99, 40,
         in("3") + "<action localId=\"0\" qualifier=\"N\"><relPosition x=\"0\" y=\"0\"/>" + action +
             "</action>") +
      "</SFC>\n";
  return editor_project(editor_program(bools("a b q never"), body));
}

TEST(DrawnOperands, WhenATransitionRefersToAnExpression_ThenItFiresFromItsStepOnly) {
  // From a step that is left a transition must not fire again: "never" holds High.
  const std::string xml = chart("<reference name=\"a OR b\"/>");
  EXPECT_EQ(run(xml, "a b never", "||b|b|never b|a b|", "Low_X High_X"), "10 10 01 01 10 01");
  std::string negated = xml;
  negated.replace(negated.find("<condition>"), 11, "<condition negated=\"true\">");
  EXPECT_EQ(run(negated, "a b never", "a|b|a b||a|", "Low_X High_X"), "10 10 10 01 01");
}

TEST(DrawnOperands, WhenAnInactiveStepHasAnExpressionThatHolds_ThenNothingFires) {
  // The way back leaves High, which is not active; its condition holds in every scan.
  std::string xml = chart("<reference name=\"a\"/>");
  xml.replace(xml.find("name=\"never\"/></condition>"), 12, "name=\"never OR b\"");
  EXPECT_EQ(run(xml, "a b never", "b|b|b|b a|", "Low_X High_X TRANS1_FIRES"), "100 100 100 010");
}

TEST(DrawnOperands, WhenTextsOfAChartHoldCommentsAndStrings_ThenTheyMeanTheSame) {
  const std::string condition =
      "<inline name=\"\"><ST><xhtml:p>a (* it's // (* nested *) *) AND\n  LEN('http://x') = 8 // '\n"
      "</xhtml:p></ST></inline>";
  const std::string action =
      "<inline><ST><xhtml:p>q := a; {attribute // x}\nb := TRUE; /* // ' */ never := b // last\n"
      "</xhtml:p></ST></inline>";
  EXPECT_EQ(run(chart(condition, action), "a", "|a|", "q b never"), "000 111");
}

struct Refused {
  const char* text;
  const char* fault;
};

// The first error, which must stand in the line of `text`.
std::string error_at(const std::string& xml, const std::string& text) {
  const auto project = read_plcopen("plc.xml", xml);
  if (!project) return result::to_string(project.error());
  const auto output = driver::compile(input_of(*project));
  if (output) return "compiles";
  const result::Diagnostic& first = output.error().front();
  const auto line = 1 + static_cast<std::uint32_t>(std::count(
                            xml.begin(), xml.begin() + static_cast<std::ptrdiff_t>(xml.find(text)), '\n'));
  if (first.where.file != "plc.xml" || first.where.line != line)
    return result::to_string(first) + " not in line " + std::to_string(line);
  return first.message;
}

TEST(DrawnOperands, WhenATextIsNotWhole_ThenItIsRefusedAtItsPlace) {
  const auto contacts = [](const std::string& text) {
    return ladder(bools("a b q"), contact(2, 50, 10, "1", text) + coil(3, 200, 10, "2", "q"));
  };
  for (const char* text : {"va) OR (vb", "va; vb := TRUE", "va (* vb", "va vb", "va, vb", "'va", "va := vb"})
    EXPECT_THAT(error_at(contacts(text), text), HasSubstr("contact"));
  const auto coils = [](const std::string& text) {
    return ladder(bools("a b q"), contact(2, 50, 10, "1", "a") + coil(3, 200, 10, "2", text));
  };
  for (const char* text : {"vq OR vb", "vq := va; vb", "vf(vq)", "12345", "vq vb"})
    EXPECT_THAT(error_at(coils(text), text), HasSubstr("coil"));
  for (const char* text : {"va) OR (vb", "va; vb := TRUE", "va (*"})
    EXPECT_THAT(error_at(chart("<reference name=\"" + std::string(text) + "\"/>"), text),
                HasSubstr("the condition"));
  for (const char* text : {"vq OR vb", "vq; va", "12345"})
    EXPECT_THAT(
        error_at(chart("<reference name=\"a\"/>", "<reference name=\"" + std::string(text) + "\"/>"), text),
        HasSubstr("the target"));
  for (const char* text :
       {"q := a; END_IF; b := a; IF b THEN q := b;", "q := (a;", "q := 'a;", "go: q := a;"})
    EXPECT_NE(error_at(chart("<reference name=\"a\"/>",
                             "<inline><ST><xhtml:p>" + std::string(text) + "</xhtml:p></ST></inline>"),
                       text),
              "compiles");
}

TEST(DrawnOperands, WhenANameIsNone_ThenItIsRefusedAtItsPlace) {
  const auto jumps = [](const std::string& label) {
    return ladder(bools("a q"), contact(2, 50, 10, "1", "a") +
                                    at("jump", 3, 200, 10, in("2"), " label=\"" + label + "\"") +
                                    contact(4, 50, 60, "1", "a") + coil(5, 200, 60, "4", "q"));
  };
  EXPECT_THAT(error_at(jumps("over; q := TRUE"), "over; q"), HasSubstr("over"));
  const auto blocks = [](const std::string& type) {
    return ladder(ints("n"), input(2, 50, 40, "n") + block(3, 120, 10, type, "IN=2", "OUT") +
                                 output(4, 220, 40, "3:OUT", "n"));
  };
  EXPECT_THAT(error_at(blocks("ABS(n) + ABS"), "ABS(n) + ABS"), HasSubstr("ABS(n) + ABS"));
}

}  // namespace
}  // namespace stepwright::exchange
