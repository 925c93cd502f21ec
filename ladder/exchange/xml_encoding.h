#pragma once

// The text of an XML file as UTF-8, whatever its declaration says it is (XML 1.0, 4.3.3). Internal to this
// folder. Pure; any thread.

#include <string>

#include "runtime/ground/result/result.h"

namespace stepwright::exchange {

// Of UTF-8, US-ASCII, ISO-8859-1 and Windows-1252, with a byte order mark or without; the lines stay what
// they are, and what is declared is UTF-8 then. Fails with E0801 where another encoding is declared, or at
// the first byte that is not of UTF-8.
[[nodiscard]] result::Result<std::string> as_utf8(const std::string& name, std::string text);

}  // namespace stepwright::exchange
