#pragma once

// Types and initial values as a project holds them (project.h): ST text, taken apart without a parser. Pure
// functions; use from any thread.
//
//   split_outside("a : INT; b : ARRAY[1..2] OF INT", ';')  ->  "a : INT", "b : ARRAY[1..2] OF INT"
//   element_type("ARRAY[1..2] OF STRING[5]")               ->  "STRING[5]"

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stepwright::graphic {

// Without blanks and line ends at both sides.
std::string trimmed(std::string_view text);

// The trimmed pieces between `separator`s that stand in no brackets, no string and no STRUCT .. END_STRUCT;
// without an empty last one.
std::vector<std::string> split_outside(std::string_view text, char separator);
// Where `what` stands in `text` outside of brackets, strings and structures; npos if nowhere.
std::size_t find_outside(std::string_view text, std::string_view what);

// "STRING", "string[20]", "WSTRING(5)"; not a type of the user whose name only begins so.
bool is_string_type(std::string_view type);
bool is_wide_string_type(std::string_view type);

// The type of the elements of "ARRAY[0..3, 1..2] OF INT"; empty if it is no array.
std::string element_type(const std::string& type);

struct StructureMember {
  std::string name;
  std::string address;
  std::string type;
  std::string initial;
};
// The members of "STRUCT a : INT := 1; b AT %QW1 : REAL; END_STRUCT"; none if it is no structure.
bool is_structure(const std::string& type);
std::vector<StructureMember> members_of(const std::string& structure);
std::string structure_text(const std::vector<StructureMember>& members);

// "3(x)" of an array value as 3 and x; 1 and the whole text for anything else.
std::pair<std::string, std::string> repetition_of(const std::string& value);

// The ST text of the type that a name stands for; the name itself if it stands for none.
using TypeBehind = std::function<std::string(const std::string& name)>;

// Exchange files hold values of strings without quotes; in ST they are literals. `value` with quotes where
// `type` (and what it is made of) is a string and it has none: "blup" -> "'blup'".
std::string with_quotes(const std::string& value, const std::string& type, const TypeBehind& behind);
// The same for the initial values inside of a type.
std::string with_quotes_inside(const std::string& type, const TypeBehind& behind);

// The literal of a string with this content: it's -> 'it$'s'; `wide` has double quotes.
std::string string_literal(const std::string& content, bool wide);

}  // namespace stepwright::graphic
