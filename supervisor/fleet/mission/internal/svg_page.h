#pragma once

// Parts of pictures of a fleet: text that grows, colours of vehicles, times on a clock. One thread,
// one page.

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace stepwright::fleet::internal {

// Ten hues that can be told apart on white and on black; beyond ten they begin again.
inline std::string_view hue(std::size_t vehicle) {
  constexpr std::array<std::string_view, 10> kHues = {"#2f6fb5", "#d9822b", "#3a9a5b", "#b5482f", "#8055b3",
                                                      "#1f97a6", "#c2408a", "#7a8b22", "#5b6bd6", "#a5722f"};
  return kHues[vehicle % kHues.size()];
}

// "2:07.4"
inline std::string clock_time(std::chrono::milliseconds time) {
  const auto tenths = (time.count() + 50) / 100;
  return fmt::format("{}:{:02}.{}", tenths / 600, tenths / 10 % 60, tenths % 10);
}

class SvgPage {
 public:
  template <typename... T>
  void print(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<T>(values)...);
  }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace stepwright::fleet::internal
