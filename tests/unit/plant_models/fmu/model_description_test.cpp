#include "plant_models/fmu/model_description.h"

#include <gtest/gtest.h>

#include <string>

#include "plant_models/fmu/fmu_wiring.h"

namespace stepwright::fmu {
namespace {

std::string wrapped(const std::string& variables, const std::string& root = "fmiVersion=\"2.0\" guid=\"g\"",
                    const std::string& kind = "<CoSimulation modelIdentifier=\"m\"/>") {
  return "<fmiModelDescription " + root + " modelName=\"M\">\n" + kind + "\n<ModelVariables>\n" + variables +
         "\n</ModelVariables>\n</fmiModelDescription>\n";
}

result::Diagnostic problem(const std::string& xml) {
  auto read = parse_description(xml, "m.fmu/modelDescription.xml");
  return read ? result::Diagnostic{} : read.error().front();
}

const char* const kVariables =
    R"(<ScalarVariable name="valve" valueReference="1" causality="input"><Boolean start="true"/></ScalarVariable>
<ScalarVariable name="level" valueReference="2" causality="output"><Real unit="m" start="1.5"/></ScalarVariable>
<ScalarVariable name="gain" valueReference="3" causality="parameter" variability="fixed"><Integer start="4"/></ScalarVariable>
<ScalarVariable name="leak" valueReference="4" causality="parameter" variability="tunable"><Real/></ScalarVariable>
<ScalarVariable name="text" valueReference="5"><String/></ScalarVariable>)";

TEST(ModelDescription, WhenItIsOfVersion2_ThenItsVariablesAreThere) {
  const auto read = parse_description(wrapped(kVariables), "f").value();
  EXPECT_EQ(read.version, FmiVersion::V2);
  EXPECT_EQ(read.token, "g");
  EXPECT_EQ(read.identifier, "m");
  EXPECT_FALSE(read.variable_steps);
  ASSERT_EQ(read.variables.size(), 5u);
  EXPECT_EQ(read.find("valve")->start, 1.0);
  EXPECT_EQ(read.find("valve")->type, VariableType::Boolean);
  EXPECT_EQ(read.find("level")->unit, "m");
  EXPECT_EQ(read.find("level")->start, 1.5);
  EXPECT_EQ(read.find("level")->line, 5u);
  EXPECT_EQ(read.find("text")->type, VariableType::Other);
  EXPECT_EQ(read.find("Level"), nullptr);
}

TEST(ModelDescription, WhenItIsOfVersion3_ThenItsTypesAreThoseOfTheElements) {
  const auto read =
      parse_description(wrapped("<Float64 name=\"a\" valueReference=\"7\" causality=\"input\" start=\"2\"/>\n"
                                "<UInt16 name=\"b\" valueReference=\"8\"/>\n"
                                "<Boolean name=\"c\" valueReference=\"9\"><Alias name=\"d\"/></Boolean>",
                                "fmiVersion=\"3.0\" instantiationToken=\"t\"",
                                "<CoSimulation modelIdentifier=\"m\" fixedInternalStepSize=\"0.01\"/>"),
                        "f")
          .value();
  EXPECT_EQ(read.version, FmiVersion::V3);
  EXPECT_EQ(read.token, "t");
  EXPECT_EQ(read.fixed_step, 0.01);
  EXPECT_EQ(read.find("a")->type, VariableType::Float64);
  EXPECT_EQ(read.find("b")->type, VariableType::UInt16);
  EXPECT_EQ(read.find("d")->reference, 9u);
}

std::string version_3(const std::string& variables) {
  return wrapped(variables, "fmiVersion=\"3.0\" instantiationToken=\"t\"");
}

TEST(ModelDescription, WhenAVariableIsAnArray_ThenItsElementsAreThereRowByRow) {
  const auto read =
      parse_description(
          version_3(
              "<Float64 name=\"K\" valueReference=\"4\" causality=\"parameter\" start=\"1 2 3\n4 5 6\">"
              "<Dimension start=\"2\"/><Dimension valueReference=\"1\"/><Alias name=\"gain\"/></Float64>\n"
              "<UInt64 name=\"n\" valueReference=\"1\" causality=\"structuralParameter\" start=\"3\"/>\n"
              "<Boolean name=\"on\" valueReference=\"5\" start=\"true\"><Dimension start=\"2\"/></Boolean>\n"
              "<Float32 name=\"none\" valueReference=\"6\"><Dimension start=\"0\"/></Float32>"),
          "f")
          .value();
  ASSERT_EQ(read.variables.size(), 6u + 6u + 1u + 2u);
  EXPECT_EQ(read.find("K[1,1]")->start, 1.0);
  EXPECT_EQ(read.find("K[2,1]")->start, 4.0);
  EXPECT_EQ(read.find("K[2,3]")->start, 6.0);
  EXPECT_EQ(read.find("K[2,3]")->element, 5u);
  EXPECT_EQ(read.find("K[2,3]")->elements, 6u);
  EXPECT_EQ(read.find("gain[1,2]")->reference, 4u);
  EXPECT_EQ(read.find("on[2]")->start, 1.0) << "one start is that of all";
  EXPECT_EQ(read.find("K"), nullptr);
  EXPECT_EQ(read.find("n")->elements, 0u);
}

TEST(ModelDescription, WhenAnArrayIsWrong_ThenTheProblemHasItsPlace) {
  const auto array = [](const std::string& attributes, const std::string& dimension) {
    return problem(version_3("<Float64 name=\"u\" valueReference=\"4\" " + attributes + ">\n" + dimension +
                             "</Float64>"));
  };
  EXPECT_EQ(array("", "<Dimension/>").where.line, 5u);
  EXPECT_NE(array("", "<Dimension valueReference=\"7\"/>").message.find("without a size"), std::string::npos);
  EXPECT_NE(array("start=\"1 2\"", "<Dimension start=\"3\"/>").message.find("3 elements, but 2 start values"),
            std::string::npos);
  const std::string huge = "<Dimension start=\"4294967296\"/>";
  EXPECT_NE(array("", huge + huge).message.find("more than 200000 variables"), std::string::npos);
  EXPECT_NE(array("", "<Dimension start=\"200001\"/>").message.find("more than 200000"), std::string::npos);
}

TEST(ModelDescription, WhenItIsWrong_ThenTheProblemHasItsPlace) {
  const auto broken = problem("<fmiModelDescription>\n<a>\n</b>");
  EXPECT_EQ(broken.code, "C0332");
  EXPECT_EQ(broken.where.file, "m.fmu/modelDescription.xml");
  EXPECT_EQ(broken.where.line, 3u);
  EXPECT_NE(problem("<svg/>").message.find("<svg>"), std::string::npos);
  EXPECT_NE(problem(wrapped("", "fmiVersion=\"1.0\" guid=\"g\"")).message.find("1.0"), std::string::npos);
  EXPECT_NE(problem(wrapped("", "fmiVersion=\"2.0\"")).message.find("guid"), std::string::npos);
  EXPECT_NE(
      problem(wrapped("", "fmiVersion=\"2.0\" guid=\"g\"", "<ModelExchange/>")).message.find("co-simulation"),
      std::string::npos);
  EXPECT_NE(
      problem(wrapped("", "fmiVersion=\"2.0\" guid=\"g\"", "<CoSimulation modelIdentifier=\"../../evil\"/>"))
          .message.find("no name in C"),
      std::string::npos);
  EXPECT_NE(problem(wrapped("", "fmiVersion=\"2.0\" guid=\"g\"",
                            "<CoSimulation modelIdentifier=\"m\" needsExecutionTool=\"true\"/>"))
                .message.find("needs the tool"),
            std::string::npos);
  const auto nameless = problem(wrapped("\n<ScalarVariable name=\"a\"><Real/></ScalarVariable>"));
  EXPECT_NE(nameless.message.find("value reference"), std::string::npos);
  EXPECT_EQ(nameless.where.line, 5u);
}

TEST(ModelDescription, WhenAnythingStandsInIt_ThenItIsReadOrRefused) {
  const std::string whole = wrapped(kVariables);
  for (std::size_t at = 0; at + 1 < whole.size(); ++at) {  // but for the last newline
    std::string changed = whole;
    changed[at] = '<';
    static_cast<void>(parse_description(changed, "f"));
    EXPECT_FALSE(parse_description(whole.substr(0, at), "f")) << at;
  }
}

TEST(FmuWiring, WhenTheVariablesFit_ThenTheyAreInTheOrderOfTheCell) {
  const auto read = parse_description(wrapped(kVariables), "f").value();
  const auto found = find_variables(read, {{"level", VariableUse::Sensor},
                                           {"valve", VariableUse::Actuator},
                                           {"leak", VariableUse::Fault},
                                           {"gain", VariableUse::Parameter}});
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)[0]->reference, 2u);
  EXPECT_EQ((*found)[3]->reference, 3u);
}

TEST(FmuWiring, WhenAVariableDoesNotFit_ThenAllAreToldWithTheirPlaces) {
  const auto read = parse_description(wrapped(kVariables), "f").value();
  const auto found = find_variables(read, {{"levle", VariableUse::Sensor, {"cell.toml", 3, 1}},
                                           {"level", VariableUse::Actuator, {"cell.toml", 4, 1}},
                                           {"text", VariableUse::Sensor, {"cell.toml", 5, 1}},
                                           {"gain", VariableUse::Fault, {"cell.toml", 6, 1}}});
  ASSERT_FALSE(found);
  ASSERT_EQ(found.error().size(), 4u);
  EXPECT_EQ(found.error()[0].hint, "did you mean 'level'?");
  EXPECT_EQ(found.error()[1].where.line, 4u);
  EXPECT_NE(found.error()[1].message.find("an actuator is an input"), std::string::npos);
  EXPECT_NE(found.error()[2].message.find("no number"), std::string::npos);
  EXPECT_NE(found.error()[3].message.find("tunable"), std::string::npos);
}

}  // namespace
}  // namespace stepwright::fmu
