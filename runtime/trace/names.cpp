#include "runtime/trace/names.h"

#include <algorithm>
#include <iterator>
#include <sstream>
#include <utility>

#include "runtime/ground/files/files.h"

namespace stepwright::trace {

std::vector<std::string> split_names(std::string_view list) {
  std::vector<std::string> names;
  std::string name;
  int brackets = 0;
  const auto finish = [&] {
    if (!name.empty()) names.push_back(std::move(name));
    name.clear();
  };
  for (const char c : list) {
    brackets += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (c == ',' && brackets == 0) {
      finish();
    } else if (c != ' ') {
      name += c;
    }
  }
  finish();
  return names;
}

result::Result<std::vector<AskedName>> read_names(const std::string& file) {
  auto text = files::read_file(file);
  if (!text) return result::forward(text);
  std::vector<AskedName> names;
  std::istringstream lines(*text);
  std::uint32_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line.resize(std::min(line.find('#'), line.size()));
    line.resize(std::min(line.find("//"), line.size()));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos) continue;
    const std::size_t last = line.find_last_not_of(" \t\r");
    names.push_back(
        {line.substr(first, last + 1 - first), {file, number, static_cast<std::uint32_t>(first + 1)}});
  }
  return names;
}

result::Result<std::vector<reader::NamedVariable>> resolve_names(const reader::ProgramInfo& info,
                                                                 const std::vector<AskedName>& names,
                                                                 const char* code) {
  std::vector<reader::NamedVariable> variables;
  result::Diagnostics problems;
  for (const AskedName& asked : names) {
    auto found = reader::resolve_values(info, asked.name, code, asked.where);
    if (found) {
      std::ranges::move(*found, std::back_inserter(variables));
    } else {
      problems.insert(problems.end(), found.error().begin(), found.error().end());
    }
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return variables;
}

std::vector<AskedName> asked(const std::vector<std::string>& names) {
  std::vector<AskedName> list;
  for (const std::string& name : names) list.push_back({name, {}});
  return list;
}

}  // namespace stepwright::trace
