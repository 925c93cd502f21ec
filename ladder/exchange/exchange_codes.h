#pragma once

// Codes of the writers of exchange files beside those of the compiler (ladder/source/codes.h), with pages in
// ladder/doc/diagnostics.

namespace stepwright::exchange::code {

inline constexpr const char* kNoXmlCharacter = "E0815";

}  // namespace stepwright::exchange::code
