#include "supervisor/ltl/trace/csv_rows.h"

#include <utility>

namespace stepwright::ltl {

bool CsvRows::next() {
  while (at_ < text_.size() && !error_) {
    row();
    const bool empty = fields_.size() == 1 && fields_.front().empty();
    if (!empty) return !error_;
  }
  return false;
}

void CsvRows::row() {
  fields_.clear();
  columns_.clear();
  line_ = next_line_;
  const std::size_t begin = at_;
  for (bool more = true; more && !error_;) {
    columns_.push_back(static_cast<std::uint32_t>(at_ - begin + 1));
    std::string field;
    if (at_ < text_.size() && text_[at_] == '"') {
      if (!quoted(field)) return;
    } else {
      const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
      field = text_.substr(at_, end - at_);
      at_ = end;
    }
    fields_.push_back(std::move(field));
    more = at_ < text_.size() && text_[at_] == ',';
    if (more) ++at_;
  }
  if (at_ < text_.size() && text_[at_] == '\r') ++at_;
  if (at_ < text_.size() && text_[at_] == '\n') ++at_;
  ++next_line_;
}

bool CsvRows::quoted(std::string& field) {
  const result::Location begin = where(columns_.size() - 1);
  for (++at_; at_ < text_.size(); ++at_) {
    if (text_[at_] == '\n') ++next_line_;
    if (text_[at_] != '"') {
      field += text_[at_];
    } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
      field += text_[++at_];
    } else {
      ++at_;
      if (at_ == text_.size() || text_[at_] == ',' || text_[at_] == '\r' || text_[at_] == '\n') return true;
      error_ = result::fail("L0041", begin, "behind the quotes of this field stands something else",
                            "a quote within a field is written twice")
                   .value();
      return false;
    }
  }
  error_ = result::fail("L0041", begin, "the quotes of this field do not end", "close them with \"").value();
  return false;
}

}  // namespace stepwright::ltl
