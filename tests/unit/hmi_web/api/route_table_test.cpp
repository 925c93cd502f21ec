#include "hmi_web/api/route_table.h"

#include <gtest/gtest.h>

namespace stepwright::api {
namespace {

Route row(const char* method, const char* path) {
  Route route;
  route.method = method;
  route.path = path;
  route.name = std::string(method) + path;
  return route;
}

class RouteTableTest : public testing::Test {
 protected:
  static RouteTable make() {
    Route list = row("GET", "/api/users");
    list.query = {{"before", ""}};
    return RouteTable({row("GET", "/"), row("GET", "/{file}"), list, row("POST", "/api/users"),
                       row("DELETE", "/api/users/{name}"), row("DELETE", "/api/users/all")});
  }
  std::string name(std::string_view method, std::string_view target) const {
    const Match match = table_.find(method, target);
    return match.route != nullptr ? match.route->name : "none";
  }
  RouteTable table_ = make();
};

TEST_F(RouteTableTest, WhenMethodAndPathFit_ThenItIsThatRow) {
  EXPECT_EQ(name("GET", "/"), "GET/");
  EXPECT_EQ(name("HEAD", "/"), "GET/");
  EXPECT_EQ(name("GET", "/favicon.svg"), "GET/{file}");
  EXPECT_EQ(name("POST", "/api/users"), "POST/api/users");
  EXPECT_EQ(name("DELETE", "/api/users/all"), "DELETE/api/users/all");
  EXPECT_EQ(name("DELETE", "/api/users/ada"), "DELETE/api/users/{name}");
}

TEST_F(RouteTableTest, WhenThePathHasParts_ThenTheyAreDecoded) {
  const Match match = table_.find("DELETE", "/api/users/a%20b%2Fc");
  ASSERT_NE(match.route, nullptr);
  EXPECT_EQ(match.parameters.at("name"), "a b/c");
}

TEST_F(RouteTableTest, WhenTheQueryNamesParameters_ThenKnownOnesAreTakenAndTheFirstOtherOneIsTold) {
  EXPECT_EQ(table_.find("GET", "/api/users?before=7").unknown, "");
  const Match match = table_.find("GET", "/api/users?x=1&before=7&before=8&y");
  ASSERT_NE(match.route, nullptr);
  EXPECT_TRUE(match.readable);
  EXPECT_EQ(match.unknown, "x");
  EXPECT_EQ(match.parameters.size(), 1u);
  EXPECT_EQ(match.parameters.at("before"), "7");
}

TEST_F(RouteTableTest, WhenTheQueryCannotBeDecoded_ThenThatIsSaid) {
  for (const char* query : {"%=", "before=%", "before=7%0", "x=%zz", "before=%00"}) {
    const Match match = table_.find("GET", std::string("/api/users?") + query);
    ASSERT_NE(match.route, nullptr) << query;
    EXPECT_FALSE(match.readable) << query;
  }
}

TEST_F(RouteTableTest, WhenOnlyTheMethodIsWrong_ThenTheRightOnesAreTold) {
  const Match match = table_.find("PUT", "/api/users");
  EXPECT_EQ(match.route, nullptr);
  EXPECT_EQ(match.allowed, "GET, POST");
}

TEST_F(RouteTableTest, WhenNothingFits_ThenThereIsNone) {
  for (const char* target : {"", "x", "//", "/api", "/api/", "/api/users/", "/api/users//", "/api/users/a/b",
                             "http://x/", "/api/users/%", "/api/users/%zz", "/api/users/%00", "/api/../x"}) {
    const Match match = table_.find("DELETE", target);
    EXPECT_EQ(match.route, nullptr) << target;
  }
}

}  // namespace
}  // namespace stepwright::api
