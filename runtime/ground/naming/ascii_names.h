#pragma once

// Names without regard to case, as identifiers are in IEC 61131-3 (6.1.2): only ASCII letters have a case, in
// every locale. Pure.
//
//   same_name("Drive_Left", "drive_LEFT")  ->  true

#include <cstddef>
#include <string>
#include <string_view>

namespace stepwright::naming {

constexpr char to_upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

constexpr char to_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// The key under which a name is looked up.
inline std::string upper(std::string_view name) {
  std::string result(name);
  for (char& c : result) c = to_upper(c);
  return result;
}

constexpr bool same_name(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (to_upper(a[i]) != to_upper(b[i])) return false;
  }
  return true;
}

}  // namespace stepwright::naming
