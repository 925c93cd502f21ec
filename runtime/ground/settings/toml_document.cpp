#include "runtime/ground/settings/toml_document.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "runtime/ground/settings/key_parts.h"
#include "runtime/ground/settings/toml_state.h"

namespace stepwright::settings {

namespace {

// What reads it may have others wait.
constexpr std::size_t kMostBytes = 1u << 20;

const toml::table* as_table(const void* node) {
  return static_cast<const toml::table*>(node);
}
const toml::node* as_node(const void* node) {
  return static_cast<const toml::node*>(node);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

}  // namespace

namespace {

tl::unexpected<result::Diagnostics> not_an_override(const std::string& code, const std::string& dotted_key,
                                                    const std::string& value) {
  return result::fail(code + "0001", {"--set " + dotted_key + "=" + value, 0, 0},
                      "this is not KEY=VALUE with a dotted key", "for example --set plant.seed=7");
}

// Everything in `source` wins over what `target` has; tables are merged key by key.
void merge(const toml::table& source, toml::table& target) {
  for (const auto& [key, value] : source) {
    const toml::table* inner = value.as_table();
    if (inner == nullptr) {
      target.insert_or_assign(key, value);
      continue;
    }
    const toml::node* present = target.get(key);
    if (present == nullptr || !present->is_table()) target.insert_or_assign(key, toml::table{});
    merge(*inner, *target.get(key)->as_table());
  }
}

}  // namespace

TomlDocument::TomlDocument() : state_(std::make_unique<State>()) {}
TomlDocument::~TomlDocument() = default;

result::Result<std::unique_ptr<TomlDocument>> TomlDocument::load(const std::filesystem::path& file,
                                                                 std::string code) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return result::fail(
        code + "0001", {file.string(), 0, 0}, "there is no such file",
        "check the path: a cell names files from its own folder, the command line from the current one");
  }
  if (::access(file.c_str(), R_OK) != 0) {
    return result::fail(code + "0001", {file.string(), 0, 0},
                        std::string("the file cannot be read: ") + std::strerror(errno));
  }
  // Of a file that somebody goes on writing to, no more is read either.
  std::string text(kMostBytes + 1, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return parse(text, file.string(), std::move(code));
}

result::Result<std::unique_ptr<TomlDocument>> TomlDocument::parse(std::string_view text, std::string file,
                                                                  std::string code) {
  std::unique_ptr<TomlDocument> document(new TomlDocument());
  document->state_->file = std::move(file);
  document->state_->code = code;
  if (text.size() > kMostBytes) {
    return result::fail(code + "0001", {document->state_->file, 0, 0},
                        "there is more than " + std::to_string(kMostBytes >> 20) + " MiB of it",
                        "settings are a few kB: is this the file that was meant?");
  }
  if (const auto deep = too_deep_key(text)) {
    return result::fail(code + "0001", {document->state_->file, deep->line, deep->column},
                        "a key has more than " + std::to_string(kMostKeyParts) + " parts",
                        "no setting is so deep: is a dot a slip?");
  }
  try {
    document->state_->root = toml::parse(text);
  } catch (const toml::parse_error& problem) {
    return result::fail(code + "0001", document->state_->place(problem.source()),
                        std::string(problem.description()), "the text is not valid TOML");
  }
  return document;
}

result::Result<void> TomlDocument::override_value(const std::string& dotted_key, const std::string& value) {
  toml::table parsed;
  const std::string origin = "--set " + dotted_key + "=" + value;
  if (too_deep_key(dotted_key + " = " + value)) return not_an_override(state_->code, dotted_key, value);
  try {
    parsed = toml::parse(dotted_key + " = " + value);
  } catch (const toml::parse_error&) {
    try {
      parsed = toml::parse(dotted_key + " = \"" + value + "\"");
    } catch (const toml::parse_error&) {
      return not_an_override(state_->code, dotted_key, value);
    }
  }
  // A key that begins a comment, or a value that begins another line.
  if (parsed.size() != 1) return not_an_override(state_->code, dotted_key, value);
  merge(parsed, state_->root);
  state_->origins[dotted_key] = origin;
  return {};
}

void TomlDocument::listen(KeyListener listener) {
  state_->listener = std::move(listener);
}

TomlTable TomlDocument::root() {
  return {this, &state_->root, ""};
}

void TomlDocument::State::report_unknown(const toml::table& table, const std::string& path,
                                         const KeyAdvice& advice) {
  const auto& read = asked[&table];
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (!read.contains(name)) {
      // A key that is read only where it stands is as good a guess as the others.
      std::set<std::string, std::less<>> known = read;
      known.insert(looked_for[&table].begin(), looked_for[&table].end());
      known.erase(name);
      const std::vector<std::string> names(known.begin(), known.end());
      const std::string meant = closest(name, names);
      std::string hint = meant.empty() ? "known here: " + joined(names) : "did you mean '" + meant + "'?";
      const std::string other =
          meant.empty() && advice ? advice(path.substr(0, path.empty() ? 0 : path.size() - 1), name) : "";
      if (!other.empty()) hint = other + "; " + hint;
      add("0002", place(path + name, key.source()), "unknown key '" + path + name + "'", std::move(hint));
    } else if (const toml::table* inner = node.as_table(); inner != nullptr && asked.count(inner) != 0) {
      report_unknown(*inner, path + name + ".", advice);
    } else if (const toml::array* array = node.as_array()) {
      for (const toml::node& element : *array) {
        const toml::table* row = element.as_table();
        if (row != nullptr && asked.count(row) != 0) report_unknown(*row, path + name + ".", advice);
      }
    }
  }
}

result::Diagnostics TomlDocument::finish(const KeyAdvice& advice) {
  state_->report_unknown(state_->root, "", advice);
  return std::move(state_->problems);
}

TomlTable::TomlTable(TomlDocument* document, const void* node, std::string path)
    : document_(document), node_(node), path_(std::move(path)) {
  if (node_ != nullptr) document_->state_->asked[node_];
}

const void* TomlTable::find(std::string_view key) const {
  if (node_ == nullptr) return nullptr;
  document_->state_->asked[node_].emplace(key);
  return as_table(node_)->get(key);
}

void TomlTable::tell(std::string_view key, AskedKey asked) const {
  const KeyListener& listener = document_->state_->listener;
  if (!listener) return;
  asked.table = path_.substr(0, path_.empty() ? 0 : path_.size() - 1);
  asked.key = key;
  listener(asked);
}

bool TomlTable::has(std::string_view key) const {
  tell(key, {});
  if (node_ == nullptr) return false;
  document_->state_->looked_for[node_].emplace(key);
  return as_table(node_)->get(key) != nullptr;
}

void TomlTable::accept_all() const {
  for (const std::string& key : keys()) static_cast<void>(find(key));
}

bool TomlTable::has_table(std::string_view key) const {
  return has(key) && as_table(node_)->get(key)->is_table();
}

bool TomlTable::is_text(std::string_view key) const {
  return has(key) && as_table(node_)->get(key)->is_string();
}

namespace {

// The shortest text of the number that keeps it.
std::string number_text(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

}  // namespace

void TomlTable::wrong_type(std::string_view key, const char* expected) const {
  document_->state_->add("0003", where(key), "'" + path_ + std::string(key) + "' must be " + expected, "");
}

double TomlTable::ranged(std::string_view key, double value, Range range, double fallback) const {
  if (value >= range.low && value <= range.high) return value;
  std::ostringstream hint;
  if (std::isfinite(range.low) || std::isfinite(range.high))
    hint << "it must lie between " << range.low << " and " << range.high;
  else
    hint << "it must be a number";
  document_->state_->add("0004", where(key), "'" + path_ + std::string(key) + "' is out of range",
                         hint.str());
  return fallback;
}

std::string TomlTable::text(std::string_view key, std::string fallback) const {
  tell(key, {.kind = ValueKind::Text, .fallback = fallback.empty() ? fallback : '"' + fallback + '"'});
  const toml::node* node = as_node(find(key));
  if (node == nullptr) return fallback;
  if (const auto value = node->value_exact<std::string>()) return *value;
  wrong_type(key, "a string");
  return fallback;
}

double TomlTable::number(std::string_view key, double fallback, Range range) const {
  tell(key, {.kind = ValueKind::Number, .fallback = number_text(fallback), .range = range});
  const toml::node* node = as_node(find(key));
  if (node == nullptr) return fallback;
  if (!node->is_number()) {
    wrong_type(key, "a number");
    return fallback;
  }
  return ranged(key, *node->value<double>(), range, fallback);
}

std::int64_t TomlTable::integer(std::string_view key, std::int64_t fallback, Range range) const {
  tell(key, {.kind = ValueKind::Integer, .fallback = std::to_string(fallback), .range = range});
  const toml::node* node = as_node(find(key));
  if (node == nullptr) return fallback;
  if (!node->is_integer()) {
    wrong_type(key, "a whole number");
    return fallback;
  }
  const std::int64_t value = *node->value<std::int64_t>();
  const double checked = ranged(key, static_cast<double>(value), range, static_cast<double>(fallback));
  return checked == static_cast<double>(value) ? value : fallback;
}

bool TomlTable::boolean(std::string_view key, bool fallback) const {
  tell(key, {.kind = ValueKind::Boolean, .fallback = fallback ? "true" : "false"});
  const toml::node* node = as_node(find(key));
  if (node == nullptr) return fallback;
  if (const auto value = node->value_exact<bool>()) return *value;
  wrong_type(key, "true or false");
  return fallback;
}

std::string TomlTable::choice(std::string_view key, std::string fallback,
                              const std::vector<std::string>& choices) const {
  tell(key, {.kind = ValueKind::Choice, .fallback = '"' + fallback + '"', .choices = choices});
  const std::string value = text(key, fallback);
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) return value;
  const std::string meant = closest(value, choices);
  report(key, "'" + value + "' is not a choice for '" + path_ + std::string(key) + "'",
         meant.empty() ? "one of: " + joined(choices) : "did you mean '" + meant + "'?");
  return fallback;
}

std::vector<std::string> TomlTable::texts(std::string_view key) const {
  tell(key, {.kind = ValueKind::Texts});
  const toml::node* node = as_node(find(key));
  std::vector<std::string> values;
  if (node == nullptr) return values;
  const toml::array* array = node->as_array();
  if (array == nullptr || !(array->empty() || array->is_homogeneous<std::string>())) {
    wrong_type(key, "an array of strings");
    return values;
  }
  for (const toml::node& element : *array) values.push_back(*element.value_exact<std::string>());
  return values;
}

namespace {

// False if `node` is no array of numbers.
bool read_numbers(const toml::node& node, std::vector<double>& values) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return false;
  for (const toml::node& element : *array) {
    if (!element.is_number()) return false;
    values.push_back(*element.value<double>());
  }
  return true;
}

}  // namespace

std::vector<double> TomlTable::numbers(std::string_view key) const {
  tell(key, {.kind = ValueKind::Numbers});
  const toml::node* node = as_node(find(key));
  std::vector<double> values;
  if (node != nullptr && !read_numbers(*node, values)) {
    wrong_type(key, "an array of numbers");
    values.clear();
  }
  return values;
}

std::vector<std::vector<double>> TomlTable::number_rows(std::string_view key, std::size_t width) const {
  tell(key, {.kind = ValueKind::NumberRows});
  const toml::node* node = as_node(find(key));
  std::vector<std::vector<double>> rows;
  if (node == nullptr) return rows;
  const toml::array* array = node->as_array();
  bool good = array != nullptr;
  for (std::size_t i = 0; good && i < array->size(); ++i) {
    rows.emplace_back();
    good = read_numbers(*array->get(i), rows.back()) && rows.back().size() == width;
  }
  if (good) return rows;
  wrong_type(key, ("an array of arrays of " + std::to_string(width) + " numbers").c_str());
  return {};
}

std::string TomlTable::required_text(std::string_view key, const char* empty_number) const {
  tell(key, {.kind = ValueKind::Text, .required = true});
  const toml::node* node = as_node(find(key));
  if (node == nullptr) {
    document_->state_->add("0005", where(), "'" + path_ + std::string(key) + "' is missing", "");
    return {};
  }
  const std::string value = text(key, {});
  if (value.empty() && node->is_string())
    report(key, "'" + path_ + std::string(key) + "' is empty", "write what is meant between the quotes",
           empty_number);
  return value;
}

double TomlTable::required_number(std::string_view key, Range range) const {
  tell(key, {.kind = ValueKind::Number, .required = true, .range = range});
  if (find(key) == nullptr) {
    document_->state_->add("0005", where(), "'" + path_ + std::string(key) + "' is missing", "");
    return 0.0;
  }
  return number(key, 0.0, range);
}

TomlTable TomlTable::table(std::string_view key) const {
  tell(key, {.kind = ValueKind::Table});
  const std::string path = path_ + std::string(key) + ".";
  const toml::node* node = as_node(find(key));
  if (node == nullptr) return {document_, nullptr, path};
  if (const toml::table* inner = node->as_table()) return {document_, inner, path};
  wrong_type(key, "a table");
  return {document_, nullptr, path};
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  tell(key, {.kind = ValueKind::Tables});
  std::vector<TomlTable> rows;
  const toml::node* node = as_node(find(key));
  if (node == nullptr) return rows;
  const toml::array* array = node->as_array();
  if (array == nullptr || !(array->empty() || array->is_array_of_tables())) {
    wrong_type(key, "an array of tables");
    return rows;
  }
  for (const toml::node& element : *array) {
    rows.push_back(TomlTable(document_, element.as_table(), path_ + std::string(key) + "."));
  }
  return rows;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::string>> found;
  if (node_ != nullptr) {
    for (const auto& [key, node] : *as_table(node_)) {
      found.push_back({{key.source().begin.line, key.source().begin.column}, std::string(key.str())});
    }
  }
  std::sort(found.begin(), found.end());
  std::vector<std::string> names;
  for (auto& entry : found) names.push_back(std::move(entry.second));
  return names;
}

result::Location TomlTable::where(std::string_view key) const {
  if (node_ == nullptr) return {document_->state_->file, 0, 0};
  const toml::node* node = key.empty() ? nullptr : as_table(node_)->get(key);
  return document_->state_->place(path_ + std::string(key),
                                  node != nullptr ? node->source() : as_table(node_)->source());
}

void TomlTable::report(std::string_view key, std::string message, std::string hint,
                       const char* number) const {
  document_->state_->add(number, where(key), std::move(message), std::move(hint));
}

}  // namespace stepwright::settings
