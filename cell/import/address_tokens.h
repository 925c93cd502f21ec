#pragma once

// The direct addresses of a PLCopen file that are addresses of its programs: tokens of bodies and
// expressions, and the attributes that hold one. What people wrote about them, in comments and
// documentation, and what texts of a program say, is none of them. Pure; any thread.

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace stepwright::cell_import {

// In their order, each with the place where it begins.
using EachAddress = std::function<void(std::size_t at, std::string_view address)>;
// `xml`: a file that is well-formed.
void for_each_address(std::string_view xml, const EachAddress& each);

std::vector<std::string> addresses_in(std::string_view xml);
// The same file with other addresses.
std::string with_addresses(const std::string& xml, const std::function<std::string(const std::string&)>& now);

}  // namespace stepwright::cell_import
