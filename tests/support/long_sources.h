#pragma once

// ST sources of any size, each with one thing in it that there is a lot of: for benchmarks of the compiler
// and for tests that no input makes it slow or breaks it.
//
//   const std::string text = support::many_steps(1000);

#include <string>

namespace stepwright::support {

// Programs that compile; `count` of what the name says.
std::string many_rungs(int count);  // three contacts and a coil each, chained
std::string many_rungs_in_a_line(int count);
std::string many_tags(int count);   // globals with addresses, used through VAR_EXTERNAL; at most 30,000
std::string many_steps(int count);  // a ring of steps with one action each
std::string many_alternatives(int count);  // transitions out of one step, each into a step of its own
std::string long_condition(int count);     // contacts of one transition
std::string many_selections(int count);    // CASE and FOR with a variable limit, one behind the other
std::string many_locals(int count);        // locals of a function with as many variables less its result
std::string many_tasks(int count);         // each runs a program
std::string many_background_programs(int count);  // without a task, beside 8 tasks
std::string large_frames(int tasks);              // each calls a function with 20 MB of variables
std::string chart_in_blocks(int depth);  // instances of 250 characters in each other, a chart in the last
std::string many_arguments(int count);   // of a call of MAX
std::string bounded_array(const std::string& lower, const std::string& upper);  // of BYTE
std::string string_of(int characters);
std::string variable_at(const std::string& address);  // a BYTE
std::string many_callees(int count);                  // functions, each called by the program
std::string many_fields(int count);                   // members of one structure, each written once
std::string many_enumerators(int count);              // of one type, each a label of a CASE
std::string many_labels(int count);                   // of a CASE
std::string many_branches(int count);                 // of one IF
std::string many_constants(int count);                // different constants of 64 bits
std::string many_elements(int count);                 // first values of an array, each written down
std::string repeated_elements(int count);             // first values of an array, by one repetition

// Programs with mistakes.
std::string many_unknown_names(int count);  // beside as many variables with similar names
std::string many_syntax_errors(int count);

// Constructs nested `depth` levels deep.
std::string nested_parentheses(int depth);
std::string nested_negations(int depth);
std::string nested_ifs(int depth);
std::string nested_cases(int depth);
std::string nested_comments(int depth);
std::string open_comments(int depth);  // without an end
std::string nested_arrays(int depth);  // in one declaration
std::string nested_structures(int depth);
std::string chained_structures(int depth, bool inner_first);  // each a type with a name
std::string chained_blocks(int depth);
std::string chained_calls(int depth);
std::string doubled_blocks(int depth);  // each holds two of the next: 2^depth instances

std::string long_name(int characters);
std::string long_namespaces(int characters);  // a type whose name has so many with its namespaces
std::string nested_namespaces(int depth);
std::string many_namespaces(int count);  // and as many USING, functions and calls
std::string many_dimensions(int count);
std::string huge_types(int count);  // 32 MB each, in no variable

}  // namespace stepwright::support
