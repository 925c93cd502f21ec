#pragma once

// Random FBD bodies for property tests: values of two types through blocks, modifiers, connectors and
// variables, with layouts and notes that only a file has.

#include <random>

#include "ladder/graphic/project.h"

namespace stepwright::exchange {

// POU "main" with BOOL b0..b3 and INT n0..n3, all local. Compiles.
graphic::Pou random_diagram(std::mt19937& random);

// Everything that a body holds, but for its places in a file.
std::string text_of(const graphic::DrawnBody& body);

}  // namespace stepwright::exchange
