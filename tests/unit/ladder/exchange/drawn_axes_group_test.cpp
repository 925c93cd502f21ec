// The blocks of a group of axes, called from rungs that somebody drew.

#include <gtest/gtest.h>

#include <sstream>

#include "tests/unit/ladder/exchange/drawn_elements.h"

namespace stepwright::exchange {
namespace {

std::string pins_of(const std::string& names) {
  std::istringstream list(names);
  std::string text;
  for (std::string pin; list >> pin;) {
    const std::size_t equals = pin.find('=');
    text += "<variable formalParameter=\"" + pin.substr(0, equals) + "\">" + in(pin.substr(equals + 1)) +
            "</variable>";
  }
  return text;
}

// A block whose group comes from the variable `g`, beside it.
std::string group_block(int id, int y, const std::string& type, const std::string& inputs) {
  const std::string pins = "<inputVariables>" + pins_of(inputs) + "</inputVariables><inOutVariables>" +
                           pins_of("AxesGroup=" + std::to_string(id + 1)) +
                           "</inOutVariables><outputVariables>"
                           "<variable formalParameter=\"Done\"><connectionPointOut/></variable>"
                           "</outputVariables>";
  const std::string bare = "<inputVariables/><inOutVariables>" +
                           pins_of("AxesGroup=" + std::to_string(id + 1)) +
                           "</inOutVariables><outputVariables/>";
  return input(id + 1, 120, y + 40, "g") + at("block", id, 200, y, inputs.empty() ? bare : pins,
                                              " typeName=\"" + type + "\" instanceName=\"" + type + "_1\"");
}

std::string derived(const std::string& name, const std::string& type) {
  return "<variable name=\"" + name + "\"><type><derived name=\"" + type + "\"/></type></variable>\n";
}

std::string bools_of(const std::string& names) {
  return ints(names, "BOOL");
}

std::string repeated(const std::string& scan, int times) {
  std::string text;
  for (int k = 0; k < times; ++k) text += scan + "|";
  return text;
}

TEST(DrawnAxesGroup, WhenRungsCallItsBlocks_ThenItMovesIsHeldAndGoesOn) {
  std::string variables = bools_of("on go pause resume there held") + derived("g", "AXES_GROUP");
  for (const std::string type : {"MC_GroupEnable", "MC_MoveDirectAbsolute", "MC_GroupInterrupt",
                                 "MC_GroupContinue", "MC_RunAxesGroup"})
    variables += derived(type + "_1", type);
  // The drive follows at once; the target is the upper end of every joint.
  const std::string body =
      input(2, 50, 10, "g.SetPosition") + output(3, 150, 10, "2", "g.ActualPosition") +
      contact(10, 50, 50, "1", "on") + group_block(11, 50, "MC_GroupEnable", "Execute=10") +
      contact(20, 50, 150, "1", "go") + input(23, 120, 170, "g.MaxPosition") +
      group_block(21, 150, "MC_MoveDirectAbsolute", "Execute=20 Position=23") +
      coil(24, 300, 150, "21:Done", "there") + contact(30, 50, 250, "1", "pause") +
      group_block(31, 250, "MC_GroupInterrupt", "Execute=30") + coil(34, 300, 250, "31:Done", "held") +
      contact(40, 50, 350, "1", "resume") + group_block(41, 350, "MC_GroupContinue", "Execute=40") +
      group_block(51, 450, "MC_RunAxesGroup", "");
  const std::string moving = repeated("on", 2) + repeated("on go", 100) + repeated("on go pause", 200);
  const std::string xml = ladder(variables, body);
  const std::string inputs = "on go pause resume";
  const std::string held = run(xml, inputs, moving, "there held");
  ASSERT_GE(held.size(), 2u);
  EXPECT_EQ(held.substr(held.size() - 2), "01") << held;
  const std::string there = run(xml, inputs, moving + repeated("on go resume", 400), "there held");
  EXPECT_EQ(there.substr(there.size() - 2), "10") << there;
}

}  // namespace
}  // namespace stepwright::exchange
