#include "tests/unit/ladder/exchange/plcopen_samples.h"

#include <sstream>

namespace stepwright::exchange {
namespace {

std::string variable(const std::string& name, const std::string& type, const std::string& initial = "") {
  std::string text = "            <variable name=\"" + name + "\">\n              <type>\n                " +
                     type + "\n              </type>\n";
  if (!initial.empty())
    text += "              <initialValue>\n                <simpleValue value=\"" + initial +
            "\"/>\n              </initialValue>\n";
  return text + "            </variable>\n";
}

std::string place(int x, int y) {
  return "<position x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) + "\"/>\n";
}

// A connection with the path that editors draw.
std::string in(int x, int y, const std::string& from, const std::string& output = "") {
  const std::string formal = output.empty() ? "" : " formalParameter=\"" + output + "\"";
  std::istringstream ids(from);
  std::string text = "<connectionPointIn>\n<relPosition x=\"0\" y=\"8\"/>\n";
  for (std::string id; ids >> id;)
    text += "<connection refLocalId=\"" + id + "\"" + formal + ">\n" + place(x, y) + place(x - 40, y) +
            "</connection>\n";
  return text + "</connectionPointIn>\n";
}

std::string out(const std::string& attributes = "") {
  return "<connectionPointOut" + attributes + ">\n<relPosition x=\"21\" y=\"8\"/>\n</connectionPointOut>\n";
}

std::string contact(int id, int x, int y, const std::string& from, const std::string& name,
                    const std::string& attributes = "", const std::string& output = "") {
  return "<contact localId=\"" + std::to_string(id) + "\" height=\"15\" width=\"21\"" + attributes + ">\n" +
         place(x, y) + in(x, y, from, output) + out() + "<variable>" + name + "</variable>\n</contact>\n";
}

std::string coil(int id, int x, int y, const std::string& from, const std::string& name,
                 const std::string& attributes = "") {
  return "<coil localId=\"" + std::to_string(id) + "\" height=\"15\" width=\"21\"" + attributes + ">\n" +
         place(x, y) + in(x, y, from) + out() + "<variable>" + name + "</variable>\n</coil>\n";
}

std::string pin_in(const std::string& name, const std::string& from, const std::string& output = "",
                   const std::string& attributes = "") {
  return "<variable formalParameter=\"" + name + "\"" + attributes + ">\n" + in(100, 30, from, output) +
         "</variable>\n";
}

std::string pin_out(const std::string& name) {
  return "<variable formalParameter=\"" + name + "\">\n" + out() + "</variable>\n";
}

std::string block(int id, int x, int y, const std::string& type, const std::string& inputs,
                  const std::string& outputs, const std::string& attributes = "") {
  return "<block localId=\"" + std::to_string(id) + "\" width=\"60\" height=\"80\" typeName=\"" + type +
         "\"" + attributes + " executionOrderId=\"0\">\n" + place(x, y) + "<inputVariables>\n" + inputs +
         "</inputVariables>\n<inOutVariables/>\n<outputVariables>\n" + outputs +
         "</outputVariables>\n</block>\n";
}

std::string in_variable(int id, int x, int y, const std::string& expression) {
  return "<inVariable localId=\"" + std::to_string(id) +
         "\" executionOrderId=\"0\" height=\"27\" width=\"70\" negated=\"false\">\n" + place(x, y) + out() +
         "<expression>" + expression + "</expression>\n</inVariable>\n";
}

std::string out_variable(int id, int x, int y, const std::string& from, const std::string& output,
                         const std::string& name) {
  return "<outVariable localId=\"" + std::to_string(id) +
         "\" executionOrderId=\"0\" height=\"27\" width=\"70\" negated=\"false\">\n" + place(x, y) +
         in(x, y, from, output) + "<expression>" + name + "</expression>\n</outVariable>\n";
}

std::string step(int id, int x, int y, const std::string& name, const std::string& from,
                 bool initial = false) {
  return "<step localId=\"" + std::to_string(id) + "\" name=\"" + name + "\" initialStep=\"" +
         (initial ? "true" : "false") + "\" height=\"30\" width=\"80\">\n" + place(x, y) +
         (from.empty() ? "" : in(x, y, from)) + out(" formalParameter=\"\"") +
         "<connectionPointOutAction formalParameter=\"\">\n<relPosition x=\"80\" y=\"15\"/>\n"
         "</connectionPointOutAction>\n</step>\n";
}

std::string transition(int id, int x, int y, const std::string& from, const std::string& condition) {
  return "<transition localId=\"" + std::to_string(id) + "\" height=\"2\" width=\"20\">\n" + place(x, y) +
         in(x, y, from) + out() + "<condition>\n" + condition + "</condition>\n</transition>\n";
}

std::string st(const std::string& text) {
  return "<ST>\n<xhtml:p><![CDATA[" + text + "]]></xhtml:p>\n</ST>\n";
}

std::string inlined(const std::string& text) {
  return "<inline name=\"\">\n" + st(text) + "</inline>\n";
}

std::string jump(int id, int x, int y, const std::string& from, const std::string& target) {
  return "<jumpStep localId=\"" + std::to_string(id) + "\" targetName=\"" + target +
         "\" height=\"13\" width=\"12\">\n" + place(x, y) + in(x, y, from) + "</jumpStep>\n";
}

std::string action(const std::string& attributes, const std::string& body) {
  return "<action localId=\"0\"" + attributes + ">\n<relPosition x=\"0\" y=\"0\"/>\n" + body + "</action>\n";
}

std::string action_block(int id, int x, int y, const std::string& from, const std::string& actions) {
  return "<actionBlock localId=\"" + std::to_string(id) + "\" width=\"100\" height=\"60\">\n" + place(x, y) +
         in(x, y, from) + actions + "</actionBlock>\n";
}

std::string left_rail(int id, int y) {
  return "<leftPowerRail localId=\"" + std::to_string(id) + "\" height=\"40\" width=\"10\">\n" +
         place(20, y) + out(" formalParameter=\"\"") + "</leftPowerRail>\n";
}

std::string right_rail(int id, int y, const std::string& from) {
  return "<rightPowerRail localId=\"" + std::to_string(id) + "\" height=\"40\" width=\"10\">\n" +
         place(600, y) + in(600, y, from) + "</rightPowerRail>\n";
}

}  // namespace

std::string bools(const std::string& names) {
  std::istringstream list(names);
  std::string text;
  for (std::string name; list >> name;) text += variable(name, "<BOOL/>");
  return text;
}

std::string editor_program(const std::string& variables, const std::string& body) {
  return "      <pou name=\"main\" pouType=\"program\">\n        <interface>\n          <localVars>\n" +
         variables + "          </localVars>\n        </interface>\n        <body>\n" + body +
         "        </body>\n      </pou>\n";
}

std::string editor_project(const std::string& pous, const std::string& data_types) {
  return R"(<?xml version='1.0' encoding='utf-8'?>
<project xmlns:ns1="http://www.plcopen.org/xml/tc6_0201" xmlns:xhtml="http://www.w3.org/1999/xhtml" xmlns:xsd="http://www.w3.org/2001/XMLSchema" xmlns="http://www.plcopen.org/xml/tc6_0201">
  <fileHeader companyName="Unknown" productName="Unnamed" productVersion="1" creationDateTime="2020-04-01T10:11:12"/>
  <contentHeader name="Unnamed" modificationDateTime="2021-05-02T11:12:13">
    <coordinateInfo>
      <fbd>
        <scaling x="10" y="10"/>
      </fbd>
      <ld>
        <scaling x="0" y="0"/>
      </ld>
      <sfc>
        <scaling x="10" y="10"/>
      </sfc>
    </coordinateInfo>
  </contentHeader>
  <types>
    <dataTypes>
)" + data_types +
         "    </dataTypes>\n    <pous>\n" + pous + R"(    </pous>
  </types>
  <instances>
    <configurations>
      <configuration name="Config0">
        <resource name="Res0">
          <task name="task0" priority="0" interval="T#20ms">
            <pouInstance name="run" typeName="main"/>
          </task>
        </resource>
      </configuration>
    </configurations>
  </instances>
</project>
)";
}

std::string editor_ladder() {
  const std::string body =
      left_rail(1, 30) + right_rail(2, 30, "6 14") + contact(3, 80, 40, "1", "start") +
      contact(4, 80, 80, "1", "lamp") + contact(5, 140, 40, "3 4", "stop", " negated=\"true\"") +
      coil(6, 300, 40, "5", "lamp") + "<comment localId=\"7\" height=\"30\" width=\"200\">\n" +
      place(80, 110) + "<content>\n<xhtml:p><![CDATA[The lamp, late]]></xhtml:p>\n</content>\n</comment>\n" +
      left_rail(8, 150) + contact(9, 80, 160, "8", "lamp") +
      block(10, 160, 150, "TON", pin_in("IN", "9") + pin_in("PT", "11"), pin_out("Q") + pin_out("ET"),
            " instanceName=\"delay\"") +
      in_variable(11, 60, 200, "T#40ms") + contact(12, 260, 160, "10", "armed", " edge=\"rising\"", "Q") +
      contact(13, 320, 160, "10", "armed", "", "Q") + coil(14, 420, 160, "13", "late", " storage=\"set\"") +
      "<connector name=\"AGAIN\" localId=\"15\" height=\"20\" width=\"60\">\n" + place(420, 200) +
      in(420, 200, "12") + "</connector>\n" +
      "<continuation name=\"AGAIN\" localId=\"16\" height=\"20\" width=\"60\">\n" + place(60, 260) + out() +
      "</continuation>\n" + coil(17, 300, 260, "16", "pulse");
  return editor_project(
      editor_program(bools("start stop lamp armed late pulse") + variable("delay", "<derived name=\"TON\"/>"),
                     "          <LD>\n" + body + "          </LD>\n"));
}

std::string editor_blocks() {
  const std::string body =
      in_variable(1, 40, 40, "up") +
      block(2, 200, 30, "SEL",
            pin_in("G", "1", "", " negated=\"true\"") + pin_in("IN0", "3", "OUT") + pin_in("IN1", "5"),
            pin_out("OUT")) +
      block(3, 120, 60, "ADD", pin_in("IN1", "5") + pin_in("IN2", "4"), pin_out("OUT")) +
      in_variable(4, 40, 120, "2") +
      "<inOutVariable localId=\"5\" executionOrderId=\"0\" height=\"27\" width=\"60\" negatedOut=\"false\" "
      "negatedIn=\"false\">\n" +
      place(300, 40) + in(300, 50, "2", "OUT") + out() +
      "<expression>count</expression>\n</inOutVariable>\n" +
      block(6, 400, 30, "GE", pin_in("IN1", "5") + pin_in("IN2", "7"), pin_out("OUT")) +
      in_variable(7, 340, 90, "limit") + out_variable(8, 500, 40, "6", "OUT", "full");
  return editor_project(
      editor_program(bools("up full") + variable("count", "<INT/>", "0") + variable("limit", "<INT/>", "6"),
                     "          <FBD>\n" + body + "          </FBD>\n"));
}

std::string editor_chart() {
  const std::string divergence = "<selectionDivergence localId=\"2\" height=\"1\" width=\"300\">\n" +
                                 place(60, 80) + in(60, 80, "1") + out(" formalParameter=\"\"") +
                                 out(" formalParameter=\"\"") + "</selectionDivergence>\n";
  const std::string convergence = "<selectionConvergence localId=\"9\" height=\"1\" width=\"300\">\n" +
                                  place(60, 260) + in(60, 260, "7") + in(360, 260, "8") + out() +
                                  "</selectionConvergence>\n";
  const std::string body =
      step(1, 200, 20, "Idle", "", true) + divergence +
      // The right branch is written first: the places decide.
      transition(4, 350, 120, "2", inlined("go")) +
      transition(3, 50, 120, "2", "<reference name=\"to_left\"/>\n") + step(5, 20, 160, "Left", "3") +
      step(6, 320, 160, "Right", "4") + transition(7, 50, 220, "5", inlined("Left.T >= T#0s AND done")) +
      transition(8, 350, 220, "6",
                 "<connectionPointIn>\n<connection refLocalId=\"21\"/>\n</connectionPointIn>\n") +
      left_rail(20, 400) + contact(21, 420, 400, "20", "done", " negated=\"true\"") + convergence +
      step(10, 200, 300, "End", "9") + transition(11, 230, 350, "10", inlined("NOT go")) +
      jump(12, 230, 380, "11", "Idle") +
      action_block(13, 120, 160, "5",
                   action(" qualifier=\"N\"", "<reference name=\"left_on\"/>\n") +
                       action(" qualifier=\"P\"", "<inline>\n" + st("lefts := lefts + 1;") + "</inline>\n")) +
      action_block(14, 420, 160, "6",
                   action("", "<reference name=\"note\"/>\n") +
                       action(" qualifier=\"D\" duration=\"T#40ms\"", "<reference name=\"slow\"/>\n"));
  const std::string actions = "        <actions>\n<action name=\"note\">\n<body>\n<LD>\n" + left_rail(1, 10) +
                              contact(2, 60, 10, "1", "go") + coil(3, 120, 10, "2", "noted") +
                              "</LD>\n</body>\n</action>\n        </actions>\n";
  const std::string transitions =
      "        <transitions>\n<transition name=\"to_left\">\n<body>\n<FBD>\n" +
      block(1, 100, 10, "AND", pin_in("IN1", "2") + pin_in("IN2", "3"), pin_out("OUT")) +
      in_variable(2, 10, 10, "go") + in_variable(3, 10, 50, "west") +
      out_variable(4, 200, 10, "1", "OUT", "to_left") +
      "</FBD>\n</body>\n</transition>\n        </transitions>\n";
  const std::string pou =
      "      <pou name=\"main\" pouType=\"program\">\n        <interface>\n          <localVars>\n" +
      bools("go west done left_on slow noted") + variable("lefts", "<INT/>") +
      "          </localVars>\n        </interface>\n" + actions + transitions +
      "        <body>\n          <SFC>\n" + body + "          </SFC>\n        </body>\n      </pou>\n";
  return editor_project(pou);
}

}  // namespace stepwright::exchange
