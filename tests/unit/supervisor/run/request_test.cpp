#include "supervisor/run/request.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "supervisor/run/due_requests.h"

namespace stepwright::run {
namespace {

TEST(Request, WhenItIsAWordAlone_ThenThatIsRead) {
  for (const char* word : {"abort", "hold", "resume", "dance"}) {
    const auto request = Request::parse(std::string(R"_({"request": ")_") + word + "\"}");
    ASSERT_TRUE(request.has_value()) << word;
    EXPECT_EQ(request->word(), word);
  }
}

TEST(Request, WhenSomethingGoesWithIt_ThenItIsReadByItsType) {
  const auto request = Request::parse(R"_({"request": "order", "name": "box", "value": 8.5, "amount": 2,
                                           "corners_m": [[1, 1], [3, 1.5]]})_");
  ASSERT_TRUE(request.has_value());
  EXPECT_EQ(request->text("name"), "box");
  EXPECT_EQ(request->number("value"), 8.5);
  EXPECT_EQ(request->number("amount"), 2.0);
  EXPECT_EQ(request->count_or("amount", 1, 10), 2u);
  EXPECT_EQ(request->rows("corners_m", 2, 2), (Request::Rows{{1, 1}, {3, 1.5}}));
  EXPECT_EQ(request->text("value"), std::nullopt);
  EXPECT_EQ(request->number("name"), std::nullopt);
  EXPECT_EQ(request->count_or("value", 1, 10), std::nullopt) << "no whole number";
  EXPECT_EQ(request->count_or("amount", 1, 1), std::nullopt) << "too many";
  EXPECT_EQ(request->rows("corners_m", 3, 2), std::nullopt);
  EXPECT_EQ(request->rows("corners_m", 2, 1), std::nullopt);
}

TEST(Request, WhenSomethingMayBeLeftOut_ThenItIsTheDefaultOnlyIfItIs) {
  const auto request = Request::parse(R"_({"request": "start", "goal": 4, "amount": -1})_");
  ASSERT_TRUE(request.has_value());
  EXPECT_EQ(request->text_or("id", "none"), "none");
  EXPECT_EQ(request->text_or("goal", "none"), std::nullopt);
  EXPECT_EQ(request->count_or("corners", 1, 9), 1u);
  EXPECT_EQ(request->count_or("amount", 1, 9), std::nullopt);
}

TEST(Request, WhenTheTextIsAnythingElse_ThenItIsRefused) {
  for (const char* text : {"", "{", "7", "null", "[]", "{}", R"_({"request": 7})_", R"_({"request": null})_",
                           R"_({"request": ["abort"]})_", R"_({"request": "change", "value": 1e999})_",
                           "{\"request\": \"\xff\"}"}) {
    const auto request = Request::parse(text);
    ASSERT_FALSE(request.has_value()) << text;
    EXPECT_EQ(request.error()[0].code, "X0005");
  }
}

struct Wanted {
  double at_s = 0.0;
  std::string what;
};

TEST(DueRequests, WhenTheirTimeHasCome_ThenPeoplesComeFirstAndEachOnce) {
  DueRequests<Wanted> requests({{1.0, "first"}, {2.0, "second"}, {9.0, "late"}});
  requests.add({0.0, "asked"});
  std::vector<std::string> taken;
  for (const Wanted& each : requests.take(2.0)) taken.push_back(each.what);
  EXPECT_EQ(taken, (std::vector<std::string>{"asked", "first", "second"}));
  EXPECT_TRUE(requests.take(2.0).empty());
  EXPECT_EQ(requests.next(), 2u);
  EXPECT_FALSE(requests.none_to_come());
  requests.go_on_at(3);
  EXPECT_TRUE(requests.take(99.0).empty());
  EXPECT_TRUE(requests.none_to_come());
}

TEST(DueRequests, WhenWhatWasAskedIsForgotten_ThenTheFilesOwnStay) {
  DueRequests<Wanted> requests({{1.0, "file"}});
  requests.add({0.0, "asked"});
  requests.forget_asked();
  ASSERT_EQ(requests.take(1.0).size(), 1u);
}

}  // namespace
}  // namespace stepwright::run
