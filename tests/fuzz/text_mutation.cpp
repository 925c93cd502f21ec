#include "tests/fuzz/text_mutation.h"

#include <algorithm>

namespace stepwright::fuzz {

void TextMutation::change_number(std::string& text, std::size_t from) {
  const std::size_t begin = text.find_first_of("-0123456789", from);
  if (begin == std::string::npos) return;
  const std::size_t end = std::min(text.find_first_not_of("-.0123456789e", begin), text.size());
  text.replace(begin, end - begin, piece());
}

std::string TextMutation::mutated(std::string text) {
  for (std::size_t k = 0, changes = 1 + below(2); k < changes && !text.empty(); ++k) {
    const std::size_t at = below(text.size());
    const std::size_t length = 1 + below(below(4) == 0 ? 60 : 4);
    switch (below(20)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, piece());
        break;
      case 2:
        text.insert(below(text.size()), text.substr(at, length));
        break;
      default:
        change_number(text, at);
    }
  }
  return text;
}

}  // namespace stepwright::fuzz
