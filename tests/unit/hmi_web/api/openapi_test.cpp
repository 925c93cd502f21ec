#include "hmi_web/api/openapi.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "hmi_web/api/routes.h"

namespace stepwright::api {
namespace {

using nlohmann::json;

class OpenApiTest : public testing::Test {
 protected:
  RouteTable table_{all_routes({})};
  json document_ = json::parse(openapi(table_, "1.2.3"));
};

TEST_F(OpenApiTest, EveryRoute_IsAnOperation) {
  std::size_t operations = 0;
  for (const auto& [path, methods] : document_["paths"].items()) operations += methods.size();
  EXPECT_EQ(operations, table_.rows().size());
  std::set<std::string> names;
  for (const auto& [path, methods] : document_["paths"].items()) {
    for (const auto& [method, operation] : methods.items()) {
      EXPECT_TRUE(names.insert(operation["operationId"]).second) << operation["operationId"];
      EXPECT_NE(operation["summary"], "");
      EXPECT_FALSE(operation["responses"].empty());
    }
  }
}

TEST_F(OpenApiTest, EveryReference_LeadsToASchema) {
  const std::string text = document_.dump();
  for (std::size_t at = text.find("\"$ref\":\""); at != std::string::npos;
       at = text.find("\"$ref\":\"", at + 1)) {
    const std::size_t from = at + 8 + std::string("#/components/schemas/").size();
    const std::string name = text.substr(from, text.find('"', from) - from);
    EXPECT_TRUE(document_["components"]["schemas"].contains(name)) << name;
  }
}

TEST_F(OpenApiTest, EveryPartOfAPath_IsAParameter) {
  for (const auto& [path, methods] : document_["paths"].items()) {
    for (const auto& [method, operation] : methods.items()) {
      std::size_t parts = 0;
      for (const auto& each : operation.value("parameters", json::array())) parts += each["in"] == "path";
      EXPECT_EQ(parts, static_cast<std::size_t>(std::count(path.begin(), path.end(), '{'))) << path;
    }
  }
}

TEST_F(OpenApiTest, WhatTheDoorAsksFor_IsSaid) {
  const json abort = document_["paths"]["/api/plan/abort"]["post"];
  EXPECT_EQ(abort["security"], json::parse(R"([{"session": [], "csrf": []}])"));
  EXPECT_EQ(abort["x-least-role"], "operator");
  const json force = document_["components"]["schemas"]["ForceTag"];
  EXPECT_EQ(force["additionalProperties"], false);
  EXPECT_EQ(force["properties"]["minutes"]["maximum"], 480);
  EXPECT_EQ(force["required"], json({"name", "value", "reason"}));
  for (const char* shape : {"NewGoal", "Start", "WhatIf"}) {
    const std::string goal = document_["components"]["schemas"][shape]["properties"]["goal"]["description"];
    EXPECT_NE(goal.find("PDDL"), std::string::npos) << shape;
    EXPECT_NE(goal.find("visit press"), std::string::npos) << shape;
  }
  EXPECT_EQ(document_["openapi"], "3.1.0");
  EXPECT_EQ(document_["info"]["version"], "1.2.3");
}

}  // namespace
}  // namespace stepwright::api
