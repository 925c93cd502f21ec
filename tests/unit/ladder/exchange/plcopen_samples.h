#pragma once

// PLCopen projects in the shapes that editors write.

#include <string>

namespace stepwright::exchange {

// A project with this text below <pous>, one program instance "run" of POU "main", every 20 ms, in the shape
// of the editors that share Beremiz' format: attributes, name spaces and order are theirs.
std::string editor_project(const std::string& pous, const std::string& data_types = "");

// POU "main" with these variables (XML of <variable>s) and body.
std::string editor_program(const std::string& variables, const std::string& body);

// <variable name="..."><type><TYPE/></type></variable> for each name.
std::string bools(const std::string& names);

// Ladder: a self-holding contact pair, a TON in the rung, a set coil behind its output, a comment, a
// connector.
std::string editor_ladder();
// FBD: a counter that feeds back through an inOutVariable, a comparison, an inverted input.
std::string editor_blocks();
// SFC: selection, jump, actions of every form, transitions inline, by reference and drawn.
std::string editor_chart();

}  // namespace stepwright::exchange
