#include "tests/fuzz/fleet/mutation.h"

#include <array>
#include <cctype>
#include <string_view>

namespace stepwright::fuzz::fleet {

namespace {

constexpr std::array<const char*, 30> kWords = {"null",
                                                "true",
                                                "[]",
                                                "{}",
                                                "\"\"",
                                                "0",
                                                "-1",
                                                "1e308",
                                                "1e-320",
                                                "1e999",
                                                "100000001",
                                                "0.5",
                                                "\"v1\"",
                                                "\"dock\"",
                                                "\"start\"",
                                                "\"end\"",
                                                "-100000000",
                                                "4294967296",
                                                "[0, null]",
                                                "[1, 0]",
                                                "\"path\"",
                                                "\"polygons\"",
                                                "\"\\ud800\"",
                                                "\x80",
                                                "9223372036854775808",
                                                "[[0,0],[1,0],[0,1]]",
                                                "NaN",
                                                "resolution: 1e-300",
                                                "P5\n65536 65536\n255\n",
                                                "\"x\": 1,"};

struct Span {
  std::size_t first = 0, size = 0;
};

class Mutator {
 public:
  Mutator(std::string& text, const std::vector<std::string>& all, std::mt19937& random)
      : text_(text), all_(all), random_(random) {}

  void change() {
    const Span value = span(text_);
    switch (below(8)) {
      case 0:
        text_.erase(value.first, value.size);
        break;
      case 1:
        text_.insert(value.first, text_.substr(value.first, value.size) + ",");
        break;
      case 2:
      case 3:
        text_.replace(value.first, value.size, kWords[below(kWords.size())]);
        break;
      case 4:
      case 5: {
        const std::string& other = all_[below(all_.size())];
        const Span from = span(other);
        text_.replace(value.first, value.size, other.substr(from.first, from.size));
        break;
      }
      case 6:
        if (!text_.empty()) text_[below(text_.size())] = static_cast<char>(below(256));
        break;
      default:
        if (below(4) == 0) text_.resize(below(text_.size() + 1));
        break;
    }
  }

 private:
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  static bool ends(char c) { return std::string_view(",:[]{}\n").find(c) != std::string_view::npos; }

  // A value, or a whole list or object; mostly of the problem, which stands before the long image.
  Span span(const std::string& text) {
    if (text.empty()) return {};
    constexpr std::size_t kProblem = 2000;
    std::size_t first = below(below(8) != 0 && text.size() > kProblem ? kProblem : text.size());
    while (first > 0 && !ends(text[first]) && !ends(text[first - 1])) --first;
    std::size_t end = first;
    int depth = 0;
    do {
      if (text[end] == '[' || text[end] == '{') ++depth;
      if (text[end] == ']' || text[end] == '}') --depth;
      ++end;
    } while (end < text.size() && (depth > 0 || !ends(text[end])));
    return {first, end - first};
  }

  std::string& text_;
  const std::vector<std::string>& all_;
  std::mt19937& random_;
};

}  // namespace

std::string mutated(std::string text, const std::vector<std::string>& all, std::mt19937& random) {
  Mutator mutator(text, all, random);
  const auto changes = 1 + random() % 4;
  for (std::size_t k = 0; k < changes; ++k) mutator.change();
  return text;
}

}  // namespace stepwright::fuzz::fleet
