#include "tests/unit/ladder/exchange/plcopen_checker.h"

#include <algorithm>
#include <map>

namespace stepwright::exchange {
namespace {

using Names = std::set<std::string>;

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : "+") + name;
  return text;
}

std::map<std::string, pugi::xml_node> by_id(pugi::xml_node graphic) {
  std::map<std::string, pugi::xml_node> nodes;
  for (const pugi::xml_node node : graphic.children()) nodes[node.attribute("localId").as_string()] = node;
  return nodes;
}

// The children of every graphical element come in this order in the schema.
const std::vector<std::string>& child_order() {
  static const std::vector<std::string> order{
      "position",  "content",        "connectionPointIn", "connectionPointOut", "connectionPointOutAction",
      "condition", "inputVariables", "inOutVariables",    "outputVariables",    "action",
      "variable",  "expression",     "addData",           "documentation"};
  return order;
}

void check_order(pugi::xml_node node, std::vector<std::string>& faults) {
  std::ptrdiff_t last = 0;
  for (const pugi::xml_node child : node.children()) {
    const auto place =
        std::find(child_order().begin(), child_order().end(), child.name()) - child_order().begin();
    if (place == static_cast<std::ptrdiff_t>(child_order().size()))
      faults.push_back(std::string("unknown ") + child.name());
    if (place < last) faults.push_back(std::string(node.name()) + ": " + child.name() + " is out of order");
    last = std::max(last, place);
  }
}

bool has_output(pugi::xml_node node, const std::string& formal) {
  for (const auto& found : node.select_nodes(".//connectionPointOut")) {
    const pugi::xml_node out = found.node();
    const std::string own = out.parent() == node ? out.attribute("formalParameter").as_string()
                                                 : out.parent().attribute("formalParameter").as_string();
    if (own == formal) return true;
  }
  return formal.empty() && node.child("connectionPointOutAction");
}

class Tracer {
 public:
  explicit Tracer(pugi::xml_node sfc) : nodes_(by_id(sfc)) {}

  // Steps above a transition.
  Names steps_above(pugi::xml_node node) const {
    Names names;
    for (const pugi::xml_node above : parents(node)) {
      if (std::string(above.name()) == "step") {
        names.insert(above.attribute("name").as_string());
      } else {
        names.merge(steps_above(above));
      }
    }
    return names;
  }

  // Transitions above a step or jump, by id.
  Names transitions_above(pugi::xml_node node) const {
    Names ids;
    for (const pugi::xml_node above : parents(node)) {
      if (std::string(above.name()) == "transition") {
        ids.insert(above.attribute("localId").as_string());
      } else {
        ids.merge(transitions_above(above));
      }
    }
    return ids;
  }

 private:
  std::vector<pugi::xml_node> parents(pugi::xml_node node) const {
    std::vector<pugi::xml_node> list;
    for (const pugi::xml_node in : node.children("connectionPointIn")) {
      for (const pugi::xml_node connection : in.children("connection")) {
        list.push_back(nodes_.at(connection.attribute("refLocalId").as_string()));
      }
    }
    return list;
  }

  std::map<std::string, pugi::xml_node> nodes_;
};

}  // namespace

std::vector<std::string> faults_of(pugi::xml_node body) {
  std::vector<std::string> faults;
  const pugi::xml_node graphic = body.first_child();
  std::set<std::string> ids;
  for (const pugi::xml_node node : graphic.children()) {
    const std::string id = node.attribute("localId").as_string();
    if (id.empty() || !ids.insert(id).second) faults.push_back("localId " + id + " is missing or used twice");
    if (std::string(node.first_child().name()) != "position") faults.push_back(id + " has no position");
    check_order(node, faults);
  }
  const std::map<std::string, pugi::xml_node> nodes = by_id(graphic);
  for (const auto& found : graphic.select_nodes(".//connection")) {
    const auto source = nodes.find(found.node().attribute("refLocalId").as_string());
    if (source == nodes.end()) {
      faults.push_back("connection to nothing");
    } else if (!has_output(source->second, found.node().attribute("formalParameter").as_string())) {
      faults.push_back("no such output of element " + source->first);
    }
  }
  for (const auto& found : graphic.select_nodes(".//connectionPointIn")) {
    if (!found.node().child("connection")) faults.push_back("connectionPointIn without connection");
  }
  return faults;
}

std::multiset<std::string> transitions_of(pugi::xml_node sfc) {
  const Tracer tracer(sfc);
  std::map<std::string, Names> targets;
  for (const pugi::xml_node node : sfc.children()) {
    const std::string kind = node.name();
    if (kind != "step" && kind != "jumpStep") continue;
    const std::string name = node.attribute(kind == "step" ? "name" : "targetName").as_string();
    for (const std::string& id : tracer.transitions_above(node)) targets[id].insert(name);
  }
  std::multiset<std::string> result;
  for (const pugi::xml_node node : sfc.children("transition")) {
    const std::string name = node.child("condition").child("inline").attribute("name").as_string();
    result.insert(joined(tracer.steps_above(node)) + " -" + name + "-> " +
                  joined(targets[node.attribute("localId").as_string()]));
  }
  return result;
}

}  // namespace stepwright::exchange
