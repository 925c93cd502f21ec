#pragma once

// Reads a binding out of a document that is there already, for whoever listens to what it is asked for
// (cell/reference). Problems and vocabulary are those of read_binding in binding.h.

#include <string>

#include "runtime/ground/settings/toml_document.h"
#include "supervisor/translate/binding.h"

namespace stepwright::translate {

[[nodiscard]] result::Result<Binding> read_binding(settings::TomlDocument& document, std::string file,
                                                   const model::Vocabulary* vocabulary = nullptr);

}  // namespace stepwright::translate
