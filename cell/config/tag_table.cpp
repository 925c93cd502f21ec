#include "cell/config/tag_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "runtime/ground/csv/csv_rows.h"
#include "runtime/ground/files/files.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/result/utf8_place.h"

namespace stepwright::config {
namespace {

constexpr const char* kNoTable = "C0633";
constexpr int kMostShown = 9;
const std::vector<std::string> kColumns = {"name",     "unit",  "description", "group",
                                           "decimals", "least", "greatest",    "values"};

class TagTable {
 public:
  TagTable(std::istream& in, std::string file, std::vector<TagConfig>& tags)
      : rows_(in, file, kNoTable), file_(std::move(file)), tags_(tags) {
    for (std::size_t i = 0; i < tags_.size(); ++i) known_.emplace(naming::upper(tags_[i].name), i);
  }

  result::Diagnostics read() {
    if (rows_.next()) {
      read_head();
      while (columns_.contains("name") && rows_.next()) read_row();
    } else if (!rows_.error()) {
      report({file_, 1, 1}, kNoTable, "there is no table", "its first line names the columns: name,unit,...");
    }
    if (rows_.error()) problems_.insert(problems_.end(), rows_.error()->begin(), rows_.error()->end());
    return std::move(problems_);
  }

 private:
  void read_head() {
    head_fields_ = rows_.fields().size();
    for (std::size_t i = 0; i < rows_.fields().size(); ++i) {
      const std::string& name = rows_.fields()[i];
      if (!columns_.emplace(name, i).second && std::ranges::find(kColumns, name) != kColumns.end())
        report(rows_.where(i), kNoTable, "the column '" + name + "' is there twice", "leave one of them out");
    }
    if (!columns_.contains("name")) return tell_no_names();
    for (const auto& [name, index] : columns_) tell_unread(name, index);
  }

  void tell_no_names() {
    const std::string& head = columns_.begin()->first;
    const std::size_t other = columns_.size() == 1 ? head.find_first_of(";\t|") : std::string::npos;
    if (other == std::string::npos) return tell_head();
    const std::string what = head[other] == '\t' ? "tabs" : std::string("'") + head[other] + "'";
    report(rows_.where(0), kNoTable, "this table is separated by " + what + " and not by commas",
           "save it with commas between the fields, and points in numbers");
  }

  // "Name", "nmae": at its place, with what is meant.
  void tell_head() {
    for (const auto& [column, index] : columns_) {
      if (settings::closest(small(column), {"name"}).empty()) continue;
      return report(rows_.where(index), kNoTable, "the column '" + column + "' is not read",
                    "did you mean 'name'? Heads are in small letters: name,unit,description,...");
    }
    report(rows_.where(0), kNoTable, "no column is called 'name'",
           "name,unit,description,group,decimals,least,greatest,values");
  }

  static std::string small(std::string text) {
    for (char& c : text) c = naming::to_lower(c);
    return text;
  }

  // Other columns are for people, but for a slip.
  void tell_unread(const std::string& column, std::size_t index) {
    if (std::ranges::find(kColumns, column) != kColumns.end()) return;
    std::vector<std::string> absent;
    std::ranges::copy_if(kColumns, std::back_inserter(absent),
                         [&](const std::string& each) { return !columns_.contains(each); });
    const std::string meant = settings::closest(small(column), absent);
    if (meant.empty()) return;
    problems_.push_back({kNoTable, result::Severity::Warning, rows_.where(index),
                         "the column '" + column + "' is not read", "did you mean '" + meant + "'?"});
  }

  // Blanks behind the last column are a habit of spreadsheets.
  bool fits_head() {
    const std::vector<std::string>& fields = rows_.fields();
    for (std::size_t i = head_fields_; i < fields.size(); ++i) {
      if (fields[i].empty()) continue;
      report(rows_.where(i), kNoTable,
             "this row has more fields than the " + std::to_string(head_fields_) + " columns of the head",
             "a text with a comma in it stands in quotes: \"level, net\"");
      return false;
    }
    return true;
  }

  std::string_view field(const std::string& column) const {
    const auto found = columns_.find(column);
    return found == columns_.end() || found->second >= rows_.fields().size()
               ? std::string_view()
               : std::string_view(rows_.fields()[found->second]);
  }

  result::Location where(const std::string& column) const {
    const auto found = columns_.find(column);
    return found == columns_.end() || found->second >= rows_.fields().size() ? rows_.where(0)
                                                                             : rows_.where(found->second);
  }

  std::optional<double> number(const std::string& column) {
    const std::string_view text = field(column);
    if (text.empty()) return std::nullopt;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    if (whole && std::isfinite(value)) return value;  // "nan" and "inf" are read, too
    report(where(column), kNoTable, "'" + std::string(text) + "' is no number",
           "with a point, without blanks: 12.5");
    return std::nullopt;
  }

  void read_row() {
    if (!fits_head()) return;
    TagConfig tag;
    tag.name = field("name");
    tag.unit = field("unit");
    tag.description = field("description");
    tag.group = field("group");
    tag.where = rows_.where(0);
    read_decimals(tag);
    read_range(tag);
    read_values(tag);
    if (tag.name.empty()) {
      report(tag.where, "C0630", "this tag has no name", "the name that the program has for it");
    } else if (const auto other = known_.find(naming::upper(tag.name)); other != known_.end()) {
      const result::Location& first = tags_[other->second].where;
      report(tag.where, "C0630", "the tag '" + tag.name + "' is described twice",
             "the first time in line " + std::to_string(first.line) + " of " + first.file);
    } else if (says_something(tag)) {
      known_.emplace(naming::upper(tag.name), tags_.size());
      tags_.push_back(std::move(tag));
    }
  }

  void read_decimals(TagConfig& tag) {
    const auto decimals = number("decimals");
    if (!decimals) return;
    tag.decimals = static_cast<int>(std::clamp(*decimals, -1.0, kMostShown + 1.0));
    if (*tag.decimals == *decimals && *decimals >= 0 && *decimals <= kMostShown) return;
    report(where("decimals"), kNoTable, "so many decimals cannot be shown", "0 to 9");
    tag.decimals.reset();
  }

  void read_range(TagConfig& tag) {
    const auto least = number("least");
    const auto greatest = number("greatest");
    if (field("least").empty() != field("greatest").empty())
      return report(where("least"), "C0631", "half of a range", "both, least and greatest, or none");
    if (!least || !greatest) return;
    if (*least >= *greatest)
      return report(where("least"), "C0631", "this range has nothing in it",
                    "the least is below the greatest");
    tag.range = settings::Range{*least, *greatest};
  }

  // "off|by hand"; `\|` and `\\` are signs of a name.
  void read_values(TagConfig& tag) const {
    const std::string_view text = field("values");
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '|') {
        tag.values.push_back(std::exchange(name, {}));
        continue;
      }
      if (text[i] == '\\' && i + 1 < text.size() && (text[i + 1] == '|' || text[i + 1] == '\\')) ++i;
      name += text[i];
    }
    if (!name.empty()) tag.values.push_back(std::move(name));
  }

  static bool says_something(const TagConfig& tag) {
    return !tag.unit.empty() || !tag.description.empty() || !tag.group.empty() || tag.decimals || tag.range ||
           !tag.values.empty();
  }

  void report(const result::Location& at, const char* code, std::string message, std::string hint) {
    problems_.push_back({code, result::Severity::Error, at, std::move(message), std::move(hint)});
  }

  csv::CsvRows rows_;
  std::string file_;
  std::vector<TagConfig>& tags_;
  std::unordered_map<std::string, std::size_t> known_;  // by the name in capitals, where in `tags_`
  std::map<std::string, std::size_t, std::less<>> columns_;
  std::size_t head_fields_ = 0;
  result::Diagnostics problems_;
};

}  // namespace

result::Diagnostics read_tag_table(const std::filesystem::path& file, std::vector<TagConfig>& tags) {
  if (file.empty()) return {};
  auto text = files::read_file(file.string());
  if (!text) return text.error();
  if (const auto broken = result::place_of_no_utf8(file.string(), *text))
    return result::fail(kNoTable, *broken, "this is no UTF-8", result::kUtf8Hint).value();
  std::istringstream in(*std::move(text));
  return TagTable(in, file.string(), tags).read();
}

}  // namespace stepwright::config
