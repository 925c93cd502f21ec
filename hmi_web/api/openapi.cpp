#include "hmi_web/api/openapi.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hmi_web/api/request_guard.h"

namespace stepwright::api {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
  if (value == static_cast<double>(static_cast<std::int64_t>(value))) return static_cast<std::int64_t>(value);
  return value;
}

ordered_json schema_of(const Field& field) {
  ordered_json schema;
  switch (field.kind) {
    case Kind::Text:
      schema = {{"type", "string"}, {"minLength", number(field.least)}, {"maxLength", number(field.most)}};
      if (!field.choices.empty()) schema["enum"] = field.choices;
      break;
    case Kind::Number:
      schema = {{"type", field.whole ? "integer" : "number"},
                {"minimum", number(field.least)},
                {"maximum", number(field.most)}};
      break;
    case Kind::Boolean:
      schema = {{"type", "boolean"}};
      break;
    case Kind::Points:
      schema = {
          {"type", "array"},
          {"minItems", number(field.least)},
          {"maxItems", number(field.most)},
          {"items", {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", {{"type", "number"}}}}}};
      break;
    case Kind::Texts:
      schema = {{"type", "object"},
                {"minProperties", number(field.least)},
                {"maxProperties", number(field.most)},
                {"additionalProperties", {{"type", "string"}, {"maxLength", field.longest}}}};
      break;
    case Kind::List:
      schema = {{"type", "array"},
                {"minItems", number(field.least)},
                {"maxItems", number(field.most)},
                {"items", {{"type", "string"}, {"maxLength", field.longest}}}};
      break;
  }
  schema["description"] = field.description;
  return schema;
}

ordered_json schema_of(const Shape& shape) {
  ordered_json properties = ordered_json::object();
  ordered_json required = ordered_json::array();
  for (const Field& field : shape.fields) {
    properties[field.name] = schema_of(field);
    if (field.required) required.push_back(field.name);
  }
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

ordered_json reference(const std::string& name) {
  return {{"$ref", "#/components/schemas/" + name}};
}

ordered_json parameters_of(const Route& row) {
  ordered_json list = ordered_json::array();
  for (std::size_t at = row.path.find('{'); at != std::string::npos; at = row.path.find('{', at + 1)) {
    list.push_back({{"name", row.path.substr(at + 1, row.path.find('}', at) - at - 1)},
                    {"in", "path"},
                    {"required", true},
                    {"schema", {{"type", "string"}}}});
  }
  for (const Parameter& each : row.query) {
    list.push_back({{"name", each.name},
                    {"in", "query"},
                    {"description", each.description},
                    {"schema", {{"type", "string"}}}});
  }
  return list;
}

ordered_json responses_of(const Route& row) {
  const std::string good = row.path == "/live" ? "101" : "200";
  ordered_json responses;
  responses[good] = {{"description", row.path == "/live" ? "the WebSocket is open" : "done"}};
  if (good != "101") responses[good]["content"][row.answer_type]["schema"] = ordered_json::parse(row.answer);
  const auto problem = [&](const char* status, const char* why) {
    responses[status] = {{"description", why}};
    responses[status]["content"]["application/json"]["schema"] = reference("Problems");
  };
  if (!row.body.name.empty()) problem("400", "the body is wrong; each problem has its place");
  if (!row.query.empty()) problem("400", "a parameter is wrong");
  if (row.name.starts_with("history.") || row.name.starts_with("alarm."))
    problem("404", "this server keeps no history, or there is no such alarm");
  if (row.name.starts_with("recipe.")) {
    problem("404", "this server has no recipes, or there is no such recipe");
    if (!row.body.name.empty() || row.path.find('{') != std::string::npos)
      problem("409", "the file is damaged, there are too many, or a tag is forced");
    problem("400", "the name, a value or its range is wrong, or a tag is missing");
  }
  if (row.name.starts_with("screen.")) {
    problem("404", "there is no such screen or part");
    if (row.method != "GET") problem("409", "somebody else has saved meanwhile, or there are too many");
  }
  if (row.name.starts_with("change.")) {
    problem("404", "programs cannot be changed here, or there is no such program");
    problem("409", "another program runs meanwhile, the supervisor acts, or the runtime refuses the change");
  }
  if (row.most_body > 0) problem("413", "the body is too long");
  if (row.name.starts_with("alarm.") && row.method != "GET")
    problem("409", "the alarm's state or definition does not allow it");
  if (row.least > Role::None) problem("401", "nobody has logged in");
  if (row.least > Role::None || row.method != "GET")
    problem("403", "the role does not suffice, or the request is not from this page");
  if (row.lane == Lane::Password) problem("429", "too many failed attempts; Retry-After says when");
  if (row.audit != Audit::None) problem("503", "somebody is not there, or the audit trail cannot be written");
  if (row.lane == Lane::Runtime || row.lane == Lane::Stop) {
    problem("409", "not in the state that the cell is in");
    problem("504", "whoever was asked has not answered, and may do it all the same");
  }
  return responses;
}

ordered_json operation_of(const Route& row) {
  ordered_json operation = {{"operationId", row.name}, {"summary", row.summary}};
  operation["tags"] = {row.name.substr(0, row.name.find('.'))};
  operation["x-least-role"] = access::to_string(row.least);
  if (auto parameters = parameters_of(row); !parameters.empty())
    operation["parameters"] = std::move(parameters);
  if (!row.body.name.empty()) {
    operation["requestBody"]["required"] = true;
    operation["requestBody"]["content"]["application/json"]["schema"] = reference(row.body.name);
  }
  operation["responses"] = responses_of(row);
  ordered_json needs = ordered_json::object();
  if (row.least > Role::None) needs["session"] = ordered_json::array();
  if (row.csrf && row.method != "GET") needs["csrf"] = ordered_json::array();
  operation["security"] = needs.empty() ? ordered_json::array() : ordered_json::array({needs});
  return operation;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace

std::string openapi(const RouteTable& table, const std::string& version) {
  ordered_json document = {{"openapi", "3.1.0"}};
  document["info"] = {
      {"title", "Stepwright HMI"},
      {"version", version},
      {"description", "Everything that changes something needs the header Origin of this server's own page."},
      {"license", {{"name", "Apache-2.0"}, {"identifier", "Apache-2.0"}}}};
  document["paths"] = ordered_json::object();
  ordered_json schemas = ordered_json::object();
  for (const Route& row : table.rows()) {
    document["paths"][row.path][lower(row.method)] = operation_of(row);
    if (!row.body.name.empty()) schemas[row.body.name] = schema_of(row.body);
  }
  schemas["Problems"] =
      ordered_json::parse(R"({"type": "object", "required": ["problems"], "properties": {"problems":
    {"type": "array", "items": {"type": "object", "required": ["code", "message"], "properties": {
      "code": {"type": "string"}, "message": {"type": "string"}, "hint": {"type": "string"},
      "file": {"type": "string"}, "severity": {"enum": ["error", "warning", "note"]},
      "line": {"type": "integer"}, "column": {"type": "integer"}}}}}})");
  document["components"]["schemas"] = std::move(schemas);
  document["components"]["securitySchemes"] = {
      {"session", {{"type", "apiKey"}, {"in", "cookie"}, {"name", std::string(kSessionCookie) + "-PORT"}}},
      {"csrf", {{"type", "apiKey"}, {"in", "header"}, {"name", std::string(kCsrfHeader)}}}};
  return document.dump(2) + "\n";
}

}  // namespace stepwright::api
