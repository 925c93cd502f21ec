#include "supervisor/ltl/trace/read_trace.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <sstream>
#include <utility>

#include "runtime/ground/csv/csv_rows.h"
#include "runtime/ground/naming/ascii_names.h"
#include "runtime/ground/result/closest.h"
#include "supervisor/ltl/trace/timed_letters.h"

namespace stepwright::ltl {

namespace {

std::optional<double> number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// A whole number of any length, without its leading zeros; of zero there is neither a sign nor a digit.
struct Whole {
  bool negative = false;
  std::string_view digits;
};

std::optional<Whole> whole(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative) text.remove_prefix(1);
  if (text.empty() || text.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
  return Whole{negative && !text.empty(), text};
}

// Below, at or above 0 as a is less than, equal to or greater than b.
int order(const Whole& a, const Whole& b) {
  if (a.negative != b.negative) return a.negative ? -1 : 1;
  const auto key = [](const Whole& each) { return std::pair(each.digits.size(), each.digits); };
  const int size = key(a) < key(b) ? -1 : key(b) < key(a) ? 1 : 0;
  return a.negative ? -size : size;
}

std::optional<bool> truth(std::string_view text) {
  if (text == "1" || naming::same_name(text, "true")) return true;
  if (text == "0" || naming::same_name(text, "false")) return false;
  return std::nullopt;
}

template <typename T>
bool compare(Relation relation, const T& a, const T& b) {
  switch (relation) {
    case Relation::Less:
      return a < b;
    case Relation::LessEqual:
      return a <= b;
    case Relation::Equal:
      return a == b;
    case Relation::Unequal:
      return a != b;
    case Relation::GreaterEqual:
      return a >= b;
    case Relation::Greater:
      return a > b;
    default:
      return false;
  }
}

// Whether a field satisfies a binding; nothing if it is of another kind.
std::optional<bool> satisfied(const Binding& binding, const std::string& field) {
  if (binding.relation == Relation::Holds || binding.relation == Relation::HoldsNot) {
    const auto value = truth(field);
    if (!value) return std::nullopt;
    return *value == (binding.relation == Relation::Holds);
  }
  // A LINT or an ULINT may have more digits than a double.
  const auto a = whole(field), b = whole(binding.value);
  if (a && b) return compare(binding.relation, order(*a, *b), 0);
  const auto left = number(field), right = number(binding.value);
  if (left && right) return compare(binding.relation, *left, *right);
  if (binding.relation != Relation::Equal && binding.relation != Relation::Unequal) return std::nullopt;
  const auto is = truth(field), wanted = truth(binding.value);
  if (is && wanted) return compare(binding.relation, *is, *wanted);
  return compare(binding.relation, naming::upper(field), naming::upper(binding.value));
}

std::string without_unit(const std::string& column) {
  const std::size_t unit = column.rfind(" [");
  return unit == std::string::npos || !column.ends_with(']') ? column : column.substr(0, unit);
}

class Reader {
 public:
  Reader(std::istream& in, const std::string& file) : rows_(in, file, "L0041"), file_(file) {}

  result::Result<Trace> run(const SyntaxTree& formula, const std::vector<Binding>& bindings) {
    if (!rows_.next())
      return failed("L0041", {file_, 1, 1}, "there is no table", "its first line names the columns");
    names_ = rows_.fields();
    if (auto bound = bind(formula, bindings); !bound) return result::forward(bound);
    const auto scan_column = column("scan"), time_column = column("time_s");
    if (!scan_column) return tl::unexpected<result::Diagnostics>(scan_column.error());
    if (!time_column) return tl::unexpected<result::Diagnostics>(time_column.error());
    const auto scan = *scan_column, time = *time_column;
    if (!formula.timed.empty() && !time)
      return failed("L0042", {file_, 1, 1}, "no column 'time_s' for '" + formula.timed.front().duration + "'",
                    "`stepwright exec --csv` writes one");
    TimedLetters timers(formula);
    std::int64_t last_ns = 0;
    Trace trace;
    while (rows_.next()) {
      if (rows_.fields().size() != names_.size())
        return failed("L0041", rows_.where(0),
                      "this row has " + std::to_string(rows_.fields().size()) + " fields, and " +
                          std::to_string(names_.size()) + " columns have names",
                      "each row has a field for each column");
      auto letter = read_letter();
      if (!letter) return tl::unexpected<result::Diagnostics>(letter.error());
      if (!formula.timed.empty()) {
        const auto seconds = number(rows_.fields()[*time]);
        if (!seconds || !(std::abs(*seconds) < 1e9))
          return failed("L0044", rows_.where(*time), "'" + rows_.fields()[*time] + "' is no time",
                        "seconds since the first scan");
        const std::int64_t now_ns = std::llround(*seconds * 1e9);
        if (trace.rows > 0 && now_ns < last_ns)
          return failed("L0044", rows_.where(*time),
                        "'" + rows_.fields()[*time] + "' is before the time of the row above it",
                        "timers need rows in the order of time");
        last_ns = now_ns;
        *letter = timers.with_timed(*letter, now_ns);
      }
      ++trace.rows;
      if (!trace.changes.empty() && trace.changes.back().letter == *letter) continue;
      trace.changes.push_back({trace.rows, rows_.line(), scan ? rows_.fields()[*scan] : "",
                               time ? rows_.fields()[*time] : "", *letter});
    }
    if (rows_.error()) return tl::unexpected<result::Diagnostics>(*rows_.error());
    return trace;
  }

 private:
  // The first error is that of the table.
  tl::unexpected<result::Diagnostics> failed(const char* code, const result::Location& where,
                                             std::string message, std::string hint) const {
    if (rows_.error()) return tl::unexpected<result::Diagnostics>(*rows_.error());
    return result::fail(code, where, std::move(message), std::move(hint));
  }

  // Nothing without such a column. Exact names go before those that differ in case or in a unit.
  result::Result<std::optional<std::size_t>> column(std::string_view name) const {
    std::vector<std::size_t> exact, similar;
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (names_[k] == name)
        exact.push_back(k);
      else if (naming::same_name(names_[k], name) || naming::same_name(without_unit(names_[k]), name))
        similar.push_back(k);
    }
    const std::vector<std::size_t>& found = exact.empty() ? similar : exact;
    if (found.empty()) return std::nullopt;
    if (found.size() > 1)
      return result::fail("L0046", rows_.where(found[1]),
                          "two columns are called '" + std::string(name) + "'",
                          "case and units do not tell columns apart: leave one of them out");
    return found.front();
  }

  result::Result<void> bind(const SyntaxTree& formula, const std::vector<Binding>& bindings) {
    std::vector<std::string> propositions;  // with columns
    for (std::uint32_t k = 0; k < formula.propositions.size(); ++k) {
      if (timed_of(formula, k) != nullptr) continue;
      propositions.push_back(formula.propositions[k]);
      bits_.push_back(k);
    }
    for (const Binding& each : bindings)
      if (std::ranges::find(propositions, each.proposition) == propositions.end())
        return result::fail("L0045", {}, "the formula has no proposition '" + each.proposition + "'",
                            propositions.empty() ? "it has none at all" : "it has " + listed(propositions));
    for (const std::string& name : propositions) {
      if (std::ranges::count(bindings, name, &Binding::proposition) > 1)
        return result::fail("L0046", {}, "two bindings say what '" + name + "' means",
                            "leave one of them out");
      const auto given = std::ranges::find(bindings, name, &Binding::proposition);
      bindings_.push_back(given != bindings.end() ? *given : Binding{name, name, Relation::Holds, ""});
      const auto found = column(bindings_.back().column);
      if (!found) return tl::unexpected<result::Diagnostics>(found.error());
      if (!*found) return missing(bindings_.back());
      columns_.push_back(**found);
    }
    return {};
  }

  tl::unexpected<result::Diagnostics> missing(const Binding& binding) const {
    const std::string* meant = result::closest(binding.column, names_, 3);
    const std::string hint = "say what it means: --let " + binding.proposition + "=COLUMN or COLUMN>VALUE";
    return result::fail(
        "L0042", {file_, 1, 1},
        "no column '" + binding.column + "' for the proposition '" + binding.proposition + "'",
        meant != nullptr ? "did you mean '" + *meant + "'? " + hint : hint);
  }

  static std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& each : names) text += (text.empty() ? "" : ", ") + each;
    return text;
  }

  result::Result<Letter> read_letter() const {
    Letter letter = 0;
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      const std::string& field = rows_.fields()[columns_[k]];
      const auto holds = satisfied(bindings_[k], field);
      if (!holds) {
        const bool plain =
            bindings_[k].relation == Relation::Holds || bindings_[k].relation == Relation::HoldsNot;
        return result::fail(
            "L0044", rows_.where(columns_[k]),
            "'" + field + "' of " + names_[columns_[k]] +
                (plain ? " is neither 0 nor 1" : " cannot be compared with '" + bindings_[k].value + "'"),
            "compare numbers with numbers, texts by = and <>: --let " + bindings_[k].proposition + "=" +
                bindings_[k].column + ">VALUE");
      }
      if (*holds) letter |= Letter{1} << bits_[k];
    }
    return letter;
  }

  csv::CsvRows rows_;
  std::string file_;
  std::vector<std::string> names_;
  std::vector<Binding> bindings_;     // of each proposition with a column
  std::vector<std::size_t> columns_;  // likewise
  std::vector<std::uint32_t> bits_;   // likewise
};

}  // namespace

result::Result<Trace> read_trace(std::istream& in, const std::string& file, const SyntaxTree& formula,
                                 const std::vector<Binding>& bindings) {
  return Reader(in, file).run(formula, bindings);
}

result::Result<Trace> read_trace(std::istream& in, const std::string& file,
                                 const std::vector<std::string>& propositions,
                                 const std::vector<Binding>& bindings) {
  SyntaxTree tree;
  tree.propositions = propositions;
  return read_trace(in, file, tree, bindings);
}

result::Result<Trace> read_trace(std::string_view text, const std::string& file, const SyntaxTree& formula,
                                 const std::vector<Binding>& bindings) {
  std::istringstream in{std::string(text)};
  return read_trace(in, file, formula, bindings);
}

result::Result<Trace> read_trace(std::string_view text, const std::string& file,
                                 const std::vector<std::string>& propositions,
                                 const std::vector<Binding>& bindings) {
  std::istringstream in{std::string(text)};
  return read_trace(in, file, propositions, bindings);
}

}  // namespace stepwright::ltl
