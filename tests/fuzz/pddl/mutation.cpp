#include "tests/fuzz/pddl/mutation.h"

#include <array>
#include <cctype>
#include <string_view>

namespace stepwright::fuzz::pddl {
namespace {

constexpr std::array<const char*, 38> kWords = {"(",
                                                ")",
                                                "()",
                                                "-",
                                                "=",
                                                "<=",
                                                "/",
                                                "*",
                                                "0",
                                                "1e308",
                                                "1e999",
                                                "-0",
                                                "1e-400",
                                                "?x",
                                                ":derived",
                                                "either",
                                                "forall",
                                                "exists",
                                                "when",
                                                "not",
                                                "and",
                                                "or",
                                                "imply",
                                                "increase",
                                                "assign",
                                                "object",
                                                "(either a b)",
                                                "number",
                                                ":adl",
                                                "(not ())",
                                                "(and)",
                                                "scale-up",
                                                "\x80",
                                                "\"",
                                                ":metric",
                                                "total-time",
                                                ":durative-actions",
                                                ";;plan\n"};

struct Span {
  std::size_t first = 0, size = 0;
};

class Mutator {
 public:
  Mutator(std::string& text, const std::vector<std::string>& all, std::mt19937& random)
      : text_(text), all_(all), random_(random) {}

  void change() {
    const Span word = span(text_);
    switch (below(9)) {
      case 0:
        text_.erase(word.first, word.size);
        break;
      case 1:
        text_.insert(word.first, text_.substr(word.first, word.size) + " ");
        break;
      case 2:
        exchange(word);
        break;
      case 3:
        text_.replace(word.first, word.size, kWords[below(kWords.size())]);
        break;
      case 4:
        text_.insert(word.first, std::string(kWords[below(kWords.size())]) + " ");
        break;
      case 5:
      case 6: {
        const std::string& other = all_[below(all_.size())];
        const Span from = span(other);
        text_.replace(word.first, word.size, other.substr(from.first, from.size));
        break;
      }
      case 7:
        if (!text_.empty()) text_[below(text_.size())] = static_cast<char>(below(256));
        break;
      default:
        if (below(4) == 0) text_.resize(below(text_.size() + 1));
        break;
    }
  }

 private:
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  // A word, or a whole list.
  Span span(const std::string& text) {
    if (text.empty()) return {};
    std::size_t first = below(text.size());
    const auto blank = [&](std::size_t at) {
      return std::isspace(static_cast<unsigned char>(text[at])) != 0;
    };
    while (first > 0 && !blank(first - 1) && text[first] != '(' && text[first] != ')' &&
           text[first - 1] != '(') {
      --first;
    }
    std::size_t end = first;
    int depth = 0;
    do {
      if (text[end] == '(') ++depth;
      if (text[end] == ')') --depth;
      ++end;
    } while (end < text.size() && (depth > 0 || (text[first] != '(' && !blank(end) && text[end] != ')')));
    return {first, end - first};
  }

  void exchange(Span a) {
    Span b = span(text_);
    if (b.first < a.first) std::swap(a, b);
    if (a.first + a.size > b.first) return;
    const std::string left = text_.substr(a.first, a.size), right = text_.substr(b.first, b.size);
    text_.replace(b.first, b.size, left);
    text_.replace(a.first, a.size, right);
  }

  std::string& text_;
  const std::vector<std::string>& all_;
  std::mt19937& random_;
};

}  // namespace

std::string mutated(std::string text, const std::vector<std::string>& all, std::mt19937& random) {
  Mutator mutator(text, all, random);
  const auto changes = 1 + random() % 4;
  for (std::size_t i = 0; i < changes; ++i) mutator.change();
  return text;
}

}  // namespace stepwright::fuzz::pddl
