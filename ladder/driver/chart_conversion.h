#pragma once

// Textual SFC -> graphic::SfcChart. Internal to this folder.

#include "ladder/graphic/sfc_chart.h"
#include "ladder/source/diagnostic_sink.h"
#include "ladder/syntax/declaration.h"

namespace stepwright::driver {

// How conditions and action bodies name the places they were copied from: with marks for what is compiled,
// plain for what people see.
enum class Marks : std::uint8_t { None, Source };

// Reports unknown qualifiers and steps. Steps and transitions keep the order of the text.
graphic::SfcChart to_graphic(const syntax::Chart& chart, Marks marks, const source::SourceSet& sources,
                             source::DiagnosticSink& sink);

}  // namespace stepwright::driver
