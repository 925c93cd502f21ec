#include "runtime/ground/naming/folded_text.h"

#include <algorithm>
#include <array>
#include <clocale>
#include <cwchar>
#include <cwctype>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::naming {
namespace {

// What the C library knows of characters, whatever the locale of the process is.
class UnicodeLocale {
 public:
  UnicodeLocale() : locale_(newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr)) {}
  ~UnicodeLocale() {
    if (locale_ != nullptr) freelocale(locale_);
  }
  UnicodeLocale(const UnicodeLocale&) = delete;
  UnicodeLocale& operator=(const UnicodeLocale&) = delete;
  locale_t get() const { return locale_; }

 private:
  locale_t locale_;
};

// The calling thread's locale, as long as this lives.
class LocaleScope {
 public:
  explicit LocaleScope(locale_t locale) : before_(uselocale(locale)) {}
  ~LocaleScope() { uselocale(before_); }
  LocaleScope(const LocaleScope&) = delete;
  LocaleScope& operator=(const LocaleScope&) = delete;

 private:
  locale_t before_;
};

void append_lower(std::string& text, wchar_t character) {
  std::array<char, 16> bytes{};
  std::mbstate_t state{};
  const std::size_t count =
      std::wcrtomb(bytes.data(), static_cast<wchar_t>(std::towlower(character)), &state);
  if (count <= bytes.size()) text.append(bytes.data(), count);
}

}  // namespace

std::string folded(std::string_view utf8) {
  const bool is_ascii = std::all_of(utf8.begin(), utf8.end(), [](char c) { return (c & 0x80) == 0; });
  static const UnicodeLocale locale;
  std::string text;
  text.reserve(utf8.size());
  if (is_ascii || locale.get() == nullptr) {
    std::transform(utf8.begin(), utf8.end(), std::back_inserter(text), to_lower);
    return text;
  }
  const LocaleScope scope(locale.get());
  while (!utf8.empty()) {
    wchar_t character = 0;
    std::mbstate_t state{};
    const std::size_t used = std::mbrtowc(&character, utf8.data(), utf8.size(), &state);
    const bool is_character = used != 0 && used <= utf8.size();
    if (is_character) append_lower(text, character);
    if (!is_character) text += utf8.front();
    utf8.remove_prefix(is_character ? used : 1);
  }
  return text;
}

}  // namespace stepwright::naming
