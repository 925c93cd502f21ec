#pragma once

// A short text without heap, for messages to and from the scan thread; longer texts are cut.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace stepwright::host {

template <std::size_t Capacity>
class FixedText {
 public:
  FixedText() = default;
  explicit FixedText(std::string_view text) : size_(std::min(text.size(), Capacity)) {
    std::copy_n(text.begin(), size_, chars_.begin());
  }

  std::string_view view() const { return {chars_.data(), size_}; }
  std::string str() const { return std::string(view()); }

 private:
  std::array<char, Capacity> chars_{};
  std::size_t size_ = 0;
};

}  // namespace stepwright::host
