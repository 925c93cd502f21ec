#pragma once

// The POUs of a PLCopen file that have an instruction list, which the compiler does not read: a cell runs
// without those that nothing else needs. Pure; any thread.

#include <string>
#include <vector>

#include "ladder/graphic/project.h"

namespace stepwright::cell_import {

// The text of the file (Project::file_text) without these POUs and their instances; a line for each in
// `left`. Where all that runs is an instruction list, the file stays as it is: a program that ran in no task
// must not begin to.
std::string without_instruction_lists(const graphic::Project& project, std::vector<std::string>& left);

}  // namespace stepwright::cell_import
