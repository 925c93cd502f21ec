#include "ladder/exchange/plcopen_schema.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string_view>

#include "ladder/exchange/xml_file.h"

namespace stepwright::exchange::plcopen {
namespace {

// A kind of element. Attributes: "name" has to be there, "name?" may. Children in their order: "name" once,
// "name?" at most once, "name+", "name*", "name|" (one of those with this sign), "name&" (those with this
// sign in any order and number). "name=kind" where the kind is called otherwise than the element; "text" is a
// kind without rules of its own. "placed" and "more" stand for what nearly all have.
struct RuleText {
  const char* kind;
  const char* attributes;
  const char* children;
};

constexpr RuleText kRules[] = {
    {"project", "", "fileHeader contentHeader types instances more"},
    {"fileHeader",
     "companyName companyURL? productName productVersion productRelease? creationDateTime "
     "contentDescription?",
     ""},
    {"contentHeader", "name version? modificationDateTime? organization? author? language?",
     "Comment=text? coordinateInfo addDataInfo=text? more"},
    {"coordinateInfo", "", "pageSize=place? fbd=grid ld=grid sfc=grid"},
    {"grid", "", "scaling=place"},
    {"place", "x y", ""},
    {"text", "*", "*"},
    {"empty", "", ""},
    {"addData", "", "data*"},
    {"data", "name handleUnknown", "*"},
    // Types and values.
    {"types", "", "dataTypes pous"},
    {"dataTypes", "", "dataType*"},
    {"dataType", "name", "baseType=type initialValue=value? more"},
    {"type", "",
     "BOOL=empty| BYTE=empty| WORD=empty| DWORD=empty| LWORD=empty| SINT=empty| INT=empty| DINT=empty| "
     "LINT=empty| USINT=empty| UINT=empty| UDINT=empty| ULINT=empty| REAL=empty| LREAL=empty| TIME=empty| "
     "DATE=empty| DT=empty| TOD=empty| ANY=empty| ANY_DERIVED=empty| ANY_ELEMENTARY=empty| "
     "ANY_MAGNITUDE=empty| ANY_NUM=empty| ANY_REAL=empty| ANY_INT=empty| ANY_BIT=empty| ANY_STRING=empty| "
     "ANY_DATE=empty| string=string| wstring=string| array| derived| enum| struct| subrangeSigned=subrange| "
     "subrangeUnsigned=subrange| pointer|"},
    {"string", "length?", ""},
    {"array", "", "dimension+ baseType=type"},
    {"dimension", "lower upper", ""},
    {"derived", "name", "addData?"},
    {"enum", "", "values baseType=type?"},
    {"values", "", "value=enumerator+"},
    {"enumerator", "name value?", ""},
    {"struct", "", "variable* more"},
    {"subrange", "", "range=dimension baseType=type"},
    {"pointer", "", "baseType=type"},
    {"value", "", "simpleValue| arrayValue| structValue|"},
    {"simpleValue", "value?", ""},
    {"arrayValue", "", "value=element*"},
    {"element", "repetitionValue?", "simpleValue| arrayValue| structValue|"},
    {"structValue", "", "value=member*"},
    {"member", "member", "simpleValue| arrayValue| structValue|"},
    // Declarations.
    {"pous", "", "pou*"},
    {"pou", "name pouType globalId?", "interface? actions? transitions? body* more"},
    {"interface", "",
     "returnType=type? localVars=list& tempVars=list& inputVars=list& outputVars=list& inOutVars=list& "
     "externalVars=list& globalVars=list& accessVars=list& more"},
    {"list", "name? constant? retain? nonretain? persistent? nonpersistent?", "variable* more"},
    {"variable", "name address? globalId?", "type initialValue=value? more"},
    {"actions", "", "action=named*"},
    {"transitions", "", "transition=named*"},
    {"named", "name globalId?", "body more"},
    // Configurations.
    {"instances", "", "configurations"},
    {"configurations", "", "configuration*"},
    {"configuration", "name globalId?", "resource* globalVars=list* accessVars=text? configVars=text? more"},
    {"resource", "name globalId?", "task* globalVars=list* pouInstance* more"},
    {"task", "name single? interval? priority globalId?", "pouInstance* more"},
    {"pouInstance", "name typeName globalId?", "addData? documentation=text?"},
    // Bodies.
    {"body", "WorksheetName? globalId?", "IL=text| ST=text| FBD=diagram| LD=diagram| SFC=diagram| more"},
    {"diagram", "",
     "comment=note& error=note& connector& continuation& actionBlock& vendorElement& block& inVariable& "
     "outVariable& inOutVariable& label& jump& return& leftPowerRail& rightPowerRail& coil=contact& contact& "
     "step& macroStep& jumpStep& transition& selectionDivergence=divergence& "
     "selectionConvergence=convergence& simultaneousDivergence=divergence& "
     "simultaneousConvergence=convergence&"},
    {"note", "localId height width globalId?", "position=place content=text more"},
    {"connector", "placed name", "position=place connectionPointIn=in? more"},
    {"continuation", "placed name", "position=place connectionPointOut=out? more"},
    {"in", "globalId?", "relPosition=place? connection* expression=text? more"},
    {"out", "globalId?", "relPosition=place? expression=text? more"},
    {"namedOut", "formalParameter globalId?", "relPosition=place? expression=text? more"},
    {"connection", "refLocalId formalParameter? globalId?", "position=place* more"},
    {"vendorElement", "placed",
     "position=place alternativeText=text inputVariables=inputs? inOutVariables=inOuts? "
     "outputVariables=outputs? addData documentation=text?"},
    {"block", "placed typeName instanceName?",
     "position=place inputVariables=inputs inOutVariables=inOuts outputVariables=outputs more"},
    {"inputs", "", "variable=input*"},
    {"inOuts", "", "variable=inOut*"},
    {"outputs", "", "variable=output*"},
    {"input", "formalParameter negated? edge? storage? hidden?", "connectionPointIn=in more"},
    {"inOut", "formalParameter negated? edge? storage? hidden?",
     "connectionPointIn=in? connectionPointOut=out? more"},
    {"output", "formalParameter negated? edge? storage? hidden?", "connectionPointOut=out? more"},
    {"inVariable", "placed negated? edge? storage?",
     "position=place connectionPointOut=out? expression=text more"},
    {"outVariable", "placed negated? edge? storage?",
     "position=place connectionPointIn=in? expression=text more"},
    {"inOutVariable", "placed negatedIn? edgeIn? storageIn? negatedOut? edgeOut? storageOut?",
     "position=place connectionPointIn=in? connectionPointOut=out? expression=text more"},
    {"label", "placed label", "position=place more"},
    {"jump", "placed label", "position=place connectionPointIn=in? more"},
    {"return", "placed", "position=place connectionPointIn=in? more"},
    {"leftPowerRail", "placed", "position=place connectionPointOut=namedOut* more"},
    {"rightPowerRail", "placed", "position=place connectionPointIn=in* more"},
    {"contact", "placed negated? edge? storage?",
     "position=place connectionPointIn=in? connectionPointOut=out? variable=text more"},
    {"step", "placed name initialStep? negated?",
     "position=place connectionPointIn=in? connectionPointOut=namedOut? "
     "connectionPointOutAction=namedOut? more"},
    {"macroStep", "placed name?", "position=place connectionPointIn=in? connectionPointOut=out? body? more"},
    {"jumpStep", "placed targetName", "position=place connectionPointIn=in? more"},
    {"transition", "placed priority?",
     "position=place connectionPointIn=in? connectionPointOut=out? condition? more"},
    {"condition", "negated?", "reference| connectionPointIn=in| inline=inlineCondition|"},
    {"reference", "name", ""},
    {"inlineCondition", "name WorksheetName? globalId?",
     "IL=text| ST=text| FBD=diagram| LD=diagram| SFC=diagram| more"},
    {"divergence", "placed name?", "position=place connectionPointIn=in? connectionPointOut=namedOut* more"},
    {"convergence", "placed", "position=place connectionPointIn=in* connectionPointOut=out? more"},
    {"actionBlock", "placed negated?", "position=place connectionPointIn=in? action=blockAction* more"},
    {"blockAction", "placed qualifier? duration? indicator?",
     "relPosition=place reference? inline=body? connectionPointOut=out? more"},
};

// What version 2 requires and files before it lack.
constexpr struct {
  const char* kind;
  const char* name;  // of an attribute or a child
} kOfVersion2[] = {{"pouInstance", "typeName"}, {"blockAction", "localId"}, {"blockAction", "relPosition"}};

constexpr const char* kPlaced = "localId height? width? executionOrderId? globalId? ";
constexpr const char* kMore = "addData? documentation=text?";

struct Child {
  std::string kind;
  char times = '1';
  std::size_t place = 0;  // in the order of the schema
};

struct Rule {
  std::vector<std::string> required;  // attributes
  std::vector<std::string> optional;
  std::vector<std::string> order;  // of children
  std::map<std::string, Child, std::less<>> children;
  bool open = false;  // anything may stand in it
};

std::string expanded(std::string text, const std::string& word, const char* meaning) {
  const std::size_t at = text.find(word);
  return at == std::string::npos ? text : text.replace(at, word.size(), meaning);
}

Rule rule_of(const RuleText& text) {
  Rule rule;
  std::istringstream attributes(expanded(text.attributes, "placed", kPlaced));
  for (std::string name; attributes >> name;) {
    const bool optional = name.back() == '?';
    if (optional) name.pop_back();
    (optional ? rule.optional : rule.required).push_back(name);
  }
  rule.open = std::string_view(text.children) == "*";
  std::istringstream children(rule.open ? "" : expanded(text.children, "more", kMore));
  std::size_t place = 0;
  char before = ' ';
  for (std::string name; children >> name;) {
    Child child;
    if (std::string_view("?*+|&").find(name.back()) != std::string_view::npos) {
      child.times = name.back();
      name.pop_back();
    }
    const std::size_t equals = name.find('=');
    child.kind = equals == std::string::npos ? name : name.substr(equals + 1);
    name.erase(std::min(equals, name.size()));
    if (child.times != '&' || before != '&') ++place;
    before = child.times;
    child.place = place;
    rule.order.push_back(name);
    rule.children.emplace(std::move(name), std::move(child));
  }
  return rule;
}

class Check {
 public:
  explicit Check(Strictness strictness)
      : complete_(strictness == Strictness::Complete), older_(strictness == Strictness::Older) {
    for (const RuleText& each : kRules) rules_.emplace(each.kind, rule_of(each));
  }

  // Elements are nested 256 deep at most (xml_file.h).
  void element(pugi::xml_node node, const std::string& kind) {
    const Rule& rule = rules_.at(kind);
    if (kind == "text") return;
    attributes(node, kind, rule);
    std::size_t place = 0;
    for (const pugi::xml_node each : node.children()) {
      if (each.type() != pugi::node_element) continue;
      const auto known = rule.children.find(local_name(each));
      if (known == rule.children.end()) {
        if (complete_ && !rule.open) fault(node, "must not hold <" + std::string(local_name(each)) + ">");
        continue;
      }
      if (complete_ && known->second.place < place)
        fault(node, "holds <" + std::string(local_name(each)) + "> too late");
      place = known->second.place;
    }
    children(node, kind, rule);
    for (const pugi::xml_node each : node.children())
      if (const auto known = rule.children.find(local_name(each)); known != rule.children.end())
        element(each, known->second.kind);
  }

  std::vector<SchemaFault> take() { return std::move(faults_); }

 private:
  void fault(pugi::xml_node node, const std::string& what) {
    faults_.push_back({node, "<" + std::string(local_name(node)) + "> " + what});
  }

  bool may_lack(const std::string& kind, const std::string& name) const {
    return older_ && std::any_of(std::begin(kOfVersion2), std::end(kOfVersion2),
                                 [&](const auto& each) { return kind == each.kind && name == each.name; });
  }

  void attributes(pugi::xml_node node, const std::string& kind, const Rule& rule) {
    for (const std::string& each : rule.required)
      if (!node.attribute(each.c_str()) && !may_lack(kind, each))
        fault(node, "has no attribute '" + each + "'");
    if (!complete_) return;
    for (const pugi::xml_attribute each : node.attributes()) {
      const auto is_it = [&](const std::string& name) { return name == each.name(); };
      if (std::string_view(each.name()).rfind("xmlns", 0) != 0 &&
          std::none_of(rule.required.begin(), rule.required.end(), is_it) &&
          std::none_of(rule.optional.begin(), rule.optional.end(), is_it))
        fault(node, std::string("must not have the attribute '") + each.name() + "'");
    }
  }

  void children(pugi::xml_node node, const std::string& kind, const Rule& rule) {
    std::size_t chosen = 0;
    bool choice = false;
    for (const std::string& name : rule.order) {
      const char times = rule.children.find(name)->second.times;
      const auto count = static_cast<std::size_t>(
          std::count_if(node.begin(), node.end(), [&](pugi::xml_node n) { return local_name(n) == name; }));
      if ((times == '1' || times == '+') && count == 0 && !may_lack(kind, name))
        fault(node, "has no child <" + name + ">");
      if (complete_ && (times == '1' || times == '?') && count > 1)
        fault(node, "has several children <" + name + ">");
      choice = choice || times == '|';
      if (times == '|') chosen += count;
    }
    if (complete_ && choice && chosen != 1) fault(node, "holds not exactly one of its alternatives");
  }

  bool complete_;
  bool older_;
  std::map<std::string, Rule> rules_;
  std::vector<SchemaFault> faults_;
};

}  // namespace

std::vector<SchemaFault> schema_faults(pugi::xml_node project, Strictness strictness) {
  Check check(strictness);
  check.element(project, "project");
  return check.take();
}

}  // namespace stepwright::exchange::plcopen
