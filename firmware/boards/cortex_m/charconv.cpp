// The C++ library's conversions of floating-point numbers, which bring 200 KB of tables, replaced at link
// time by our own: these definitions come before those of the library.

#include "firmware/decimal/characters.h"

namespace std {

to_chars_result to_chars(char* first, char* last, float value, chars_format format) noexcept {
  return stepwright::decimal::to_characters(first, last, value, format);
}
to_chars_result to_chars(char* first, char* last, double value, chars_format format) noexcept {
  return stepwright::decimal::to_characters(first, last, value, format);
}
from_chars_result from_chars(const char* first, const char* last, float& value, chars_format) noexcept {
  return stepwright::decimal::from_characters(first, last, value);
}
from_chars_result from_chars(const char* first, const char* last, double& value, chars_format) noexcept {
  return stepwright::decimal::from_characters(first, last, value);
}

}  // namespace std
