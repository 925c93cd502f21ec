#pragma once

// Texts of people, where they are searched without regard to case: "Überlauf" is found by "überlauf". Names
// of programs have ASCII letters only (ascii_names.h).
//
// Thread-safe: pure.

#include <string>
#include <string_view>

namespace stepwright::naming {

// `utf8` with each letter in lower case, as Unicode has it without regard to language. Bytes that are no
// UTF-8 stay.
std::string folded(std::string_view utf8);

}  // namespace stepwright::naming
