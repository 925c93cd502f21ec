#include "cell/import/instruction_lists.h"

#include <algorithm>
#include <functional>
#include <string_view>
#include <variant>

#include "cell/import/named_bodies.h"
#include "runtime/ground/markup/xml_scan.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::cell_import {
namespace {

bool has_list(const graphic::DiagramBody& body) {
  if (body.language == graphic::BodyLanguage::InstructionList) return true;
  return std::ranges::any_of(body.diagram.elements, [](const graphic::Element& element) {
    return std::ranges::any_of(element.condition.body, has_list) ||
           std::ranges::any_of(element.actions, [](const graphic::DiagramAction& action) {
             return std::ranges::any_of(action.body, has_list);
           });
  });
}

bool has_list(const graphic::Pou& pou) {
  const auto* const drawn = std::get_if<graphic::DrawnBody>(&pou.body);
  if (drawn == nullptr) return false;
  const auto named = [](const graphic::NamedBody& each) { return has_list(each.body); };
  if (has_list(drawn->body)) return true;
  return takes_named_bodies(*drawn) &&
         (std::ranges::any_of(drawn->actions, named) || std::ranges::any_of(drawn->transitions, named));
}

// Behind the element whose '<' is at `begin`, in a file that is well-formed.
std::size_t end_of_element(std::string_view xml, std::size_t begin) {
  int depth = 0;
  for (std::size_t at = begin; at < xml.size(); at = xml.find('<', at)) {
    if (const std::size_t plain = markup::end_of_plain(xml, at); plain != at) {
      at = plain;
      continue;
    }
    const std::size_t end = markup::end_of_tag(xml, at);
    if (xml.substr(at).starts_with("</"))
      --depth;
    else if (xml[end - 2] != '/')
      ++depth;
    if (depth == 0) return end;
    at = end;
  }
  return xml.size();
}

// `inside`: a place in the element's first tag.
void cut_element(std::string& xml, std::size_t inside) {
  const std::size_t begin = xml.rfind('<', inside);
  if (begin != std::string::npos) xml.erase(begin, end_of_element(xml, begin) - begin);
}

std::string told(const graphic::Pou& pou, const graphic::Project& project) {
  std::string line = pou.name + ": an instruction list, which is not read";
  for (const graphic::ProgramInstance& each : project.instances) {
    if (naming::same_name(each.program, pou.name))
      line += "; " + each.name + (each.task.empty() ? "" : " in the task " + each.task) + " does not run";
  }
  return line + ": write it in ST";
}

}  // namespace

std::string without_instruction_lists(const graphic::Project& project, std::vector<std::string>& left) {
  std::vector<std::size_t> cuts;
  std::vector<std::string> names;
  std::vector<std::string> lines;
  for (const graphic::Pou& pou : project.pous) {
    if (!has_list(pou)) continue;
    cuts.push_back(pou.where);
    names.push_back(pou.name);
    lines.push_back(told(pou, project));
  }
  const auto is_cut = [&](const graphic::ProgramInstance& instance) {
    return std::ranges::any_of(
        names, [&](const std::string& name) { return naming::same_name(instance.program, name); });
  };
  if (!project.instances.empty() && std::ranges::all_of(project.instances, is_cut)) return project.file_text;
  for (const graphic::ProgramInstance& each : project.instances)
    if (is_cut(each)) cuts.push_back(each.where);
  std::ranges::sort(cuts, std::greater());  // from the end on, so that places before stay
  std::string xml = project.file_text;
  for (const std::size_t each : cuts) cut_element(xml, each);
  left.insert(left.end(), lines.begin(), lines.end());
  return xml;
}

}  // namespace stepwright::cell_import
