#pragma once

// A generated program as ST: one file, types first, PROGRAM main last.

#include <set>
#include <string>

#include "tests/fuzz/st/tree.h"

namespace stepwright::st_fuzz {

// The ids of statements to leave out (reduce.h).
using Dropped = std::set<int>;

std::string write_st(const Program& program, const Dropped& dropped);

std::string st_expression(const Expression& expression);
std::string st_place(const Place& place);
std::string st_literal(const Type& type, std::uint64_t bits);

}  // namespace stepwright::st_fuzz
