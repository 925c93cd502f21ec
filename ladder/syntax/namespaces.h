#pragma once

// Names in namespaces (IEC 61131-3, 6.9): behind the parser every declaration of a namespace has its full
// name, "PLANT.TWICE"; here every use of one gets the full name, too, so that later stages know nothing of
// namespaces. A name is looked for in the namespaces around it, from the inside out, then outside of all,
// then in those that USING names.
//
//   parse_unit(...);  resolve_namespaces(context, unit);  analyze(...)

#include "ladder/syntax/parser.h"

namespace stepwright::syntax {

// Once, when all sources of the unit are parsed and its charts are lowered. Reports E0201 for a USING of what
// is no namespace and for a name that several of them have, E0204 for what is INTERNAL elsewhere.
void resolve_namespaces(SyntaxContext& context, Unit& unit);

}  // namespace stepwright::syntax
