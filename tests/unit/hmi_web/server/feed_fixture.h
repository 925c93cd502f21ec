#pragma once

// A feed of two points and ten tags, and pages that hear it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hmi_web/server/feed.h"

namespace stepwright::server {

class FeedTest : public testing::Test {
 protected:
  static constexpr int kTags = 10;

  FeedTest() {
    view_.state.runtime_alive = true;
    view_.state.points = {10.0, 1.0};
  }

  static protocol::Synoptic synoptic() {
    protocol::Synoptic result;
    result.points = {{"a1.level", "a1", "%", true}, {"fc1", "fc1", "", false}};
    return result;
  }

  static std::shared_ptr<const ProgramLayout> layout(const std::string& digest) {
    auto result = std::make_shared<ProgramLayout>();
    result->program.digest = digest;
    for (int i = 0; i < kTags; ++i) result->program.tags.push_back({"t" + std::to_string(i), "DINT", ""});
    return result;
  }

  bool update() { return feed_.update(view_, now_); }

  // First message of a page that shows everything, and of one that has some data already.
  static std::string begin(const std::string& show = R"("tags":"all")", const std::string& has = {}) {
    return R"({"type":"begin","protocol":5,"epoch":"e1",)" + (has.empty() ? "" : "\"has\":{" + has + "},") +
           R"("show":{"number":1,"also":["plan","routes","pictures","trend"],)" + show + "}}";
  }
  static std::string show(int number, const std::string& tags) {
    return R"({"type":"show","number":)" + std::to_string(number) + R"(,"digest":"ab","tags":)" + tags + "}";
  }
  Feed::Cursor viewer(const std::string& first = begin()) const {
    Feed::Cursor cursor;
    EXPECT_EQ(feed_.hear(cursor, first), std::nullopt);
    return cursor;
  }

  // All that a viewer at `cursor` is told now.
  std::vector<nlohmann::json> drain(Feed::Cursor& cursor) const {
    std::vector<nlohmann::json> messages;
    while (const auto message = feed_.next(cursor)) messages.push_back(nlohmann::json::parse(*message));
    return messages;
  }

  static std::vector<std::string> types(const std::vector<nlohmann::json>& messages) {
    std::vector<std::string> result;
    for (const nlohmann::json& message : messages) result.push_back(message["type"]);
    return result;
  }

  Feed feed_{{"bench", "1"}, synoptic(), {.trend_rows = 20, .trend_rows_per_message = 3, .epoch = "e1"}};
  CellView view_;
  std::chrono::steady_clock::time_point now_{std::chrono::hours(1)};
};

// Every tag has a value, and a page may choose some.
class ChosenTags : public FeedTest {
 protected:
  ChosenTags() {
    view_.layout = layout("ab");
    view_.state.program_digest = "ab";
    for (int i = 0; i < kTags; ++i) view_.state.tags.push_back(i);
    update();
  }
  void count() {
    view_.state.scan += 1;
    for (auto& tag : view_.state.tags) *tag += 100;
    now_ += std::chrono::milliseconds(100);
    view_.state.time_s += 0.1;
    update();
  }
  nlohmann::json newest(Feed::Cursor& cursor) const {
    nlohmann::json found;
    for (const nlohmann::json& message : drain(cursor)) {
      if (message["type"] == "state" || message["type"] == "delta") found = message;
    }
    return found;
  }
};

using Types = std::vector<std::string>;

}  // namespace stepwright::server
