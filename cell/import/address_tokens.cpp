#include "cell/import/address_tokens.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "ladder/syntax/blank.h"
#include "runtime/ground/markup/xml_scan.h"

namespace stepwright::cell_import {
namespace {

constexpr std::string_view kCdata = "<![CDATA[";
constexpr std::string_view kCdataEnd = "]]>";

template <std::size_t Count>
bool is_one_of(std::string_view word, const std::array<std::string_view, Count>& words) {
  return std::ranges::find(words, word) != words.end();
}

// An address in a text begins at `at`: where it ends, or `at`.
std::size_t end_of_address(std::string_view text, std::size_t at) {
  std::size_t end = at + 1;
  if (end >= text.size() || std::string_view("IQMiqm").find(text[end]) == std::string_view::npos) return at;
  ++end;
  if (end < text.size() && std::string_view("XBWDLxbwdl").find(text[end]) != std::string_view::npos) ++end;
  const std::size_t first = end;
  while (end < text.size() && (std::isdigit(static_cast<unsigned char>(text[end])) != 0 || text[end] == '.'))
    ++end;
  while (end > first && text[end - 1] == '.') --end;  // of a range
  return end > first ? end : at;
}

// Behind the quote that ends the literal which begins at `at`; '$' takes the next sign away.
std::size_t end_of_literal(std::string_view text, std::size_t at) {
  const char quote = text[at];
  for (++at; at < text.size(); ++at) {
    if (text[at] == '$')
      ++at;
    else if (text[at] == quote)
      return at + 1;
  }
  return text.size();
}

// Without its prefix: "p" of "<xhtml:p>" and of "</xhtml:p>".
std::string_view name_of(std::string_view tag) {
  const std::size_t begin = tag.starts_with("</") ? 2 : 1;
  const std::size_t end = tag.find_first_of(" \t\r\n/>", begin);
  const std::string_view name = tag.substr(begin, end - begin);
  return name.substr(name.find(':') + 1);
}

class Scan {
 public:
  Scan(std::string_view xml, const EachAddress& each) : xml_(xml), each_(each), code_(xml.size(), ' ') {}

  void run() {
    for (std::size_t at = 0; at < xml_.size();) {
      if (xml_[at] != '<') {
        const std::size_t end = std::min(xml_.find('<', at), xml_.size());
        copy(at, end);
        at = end;
      } else if (const std::size_t plain = markup::end_of_plain(xml_, at); plain != at) {
        if (xml_.substr(at).starts_with(kCdata) && untold_ == 0)
          std::copy(xml_.begin() + static_cast<std::ptrdiff_t>(at + kCdata.size()),
                    xml_.begin() + static_cast<std::ptrdiff_t>(plain - kCdataEnd.size()),
                    code_.begin() + static_cast<std::ptrdiff_t>(at + kCdata.size()));
        at = plain;
      } else {
        const std::size_t end = markup::end_of_tag(xml_, at);
        tag(at, end);
        at = end;
      }
    }
    take(xml_.size());
  }

 private:
  // What stands here is code, if it is no word about it.
  void copy(std::size_t at, std::size_t end) {
    using Entity = std::pair<std::string_view, char>;
    constexpr std::array kQuotes = {Entity{"&apos;", '\''}, Entity{"&#39;", '\''}, Entity{"&#x27;", '\''},
                                    Entity{"&quot;", '"'},  Entity{"&#34;", '"'},  Entity{"&#x22;", '"'}};
    if (untold_ != 0) return;
    while (at < end) {
      const auto quote = std::ranges::find_if(
          kQuotes, [&](const Entity& each) { return xml_.substr(at).starts_with(each.first); });
      code_[at] = quote == kQuotes.end() ? xml_[at] : quote->second;
      at += quote == kQuotes.end() ? 1 : quote->first.size();
    }
  }

  void tag(std::size_t at, std::size_t end) {
    // Paragraphs divide a text into lines and nothing else.
    constexpr std::array<std::string_view, 4> kOfText = {"p", "br", "span", "xhtml"};
    constexpr std::array<std::string_view, 6> kWords = {"documentation", "comment",     "Comment",
                                                        "addData",       "addDataInfo", "vendorElement"};
    const std::string_view text = xml_.substr(at, end - at);
    const std::string_view name = name_of(text);
    if (!is_one_of(name, kOfText)) take(at);
    if (text.starts_with("</")) {
      if (untold_ != 0) --untold_;
    } else if (!text.ends_with("/>") && (untold_ != 0 || is_one_of(name, kWords))) {
      ++untold_;
    }
    if (untold_ == 0 && !is_one_of(name, kWords)) attributes(at, text, name);
  }

  void attributes(std::size_t tag_at, std::string_view tag, std::string_view element) {
    for (std::size_t at = tag.find('='); at != std::string_view::npos; at = tag.find('=', at)) {
      const std::size_t last = tag.find_last_not_of(" \t\r\n", at - 1);
      const std::size_t first = tag.find_last_of(" \t\r\n", last) + 1;
      const std::string_view name = tag.substr(first, last + 1 - first);
      const std::size_t open = tag.find_first_of("\"'", at);
      if (open == std::string_view::npos) return;
      const std::size_t close = std::min(tag.find(tag[open], open + 1), tag.size());
      const bool holds = name == "address" || name == "single" || (element == "reference" && name == "name");
      const std::size_t percent = tag.find('%', open);
      if (holds && percent < close) {
        const std::size_t end = end_of_address(tag, percent);
        if (end > percent) each_(tag_at + percent, tag.substr(percent, end - percent));
      }
      at = close;
    }
  }

  // The code before `end` of which nothing was taken yet.
  void take(std::size_t end) {
    const std::string_view code = std::string_view(code_).substr(0, end);
    for (std::size_t at = taken_; at < end;) {
      if (const auto blank = syntax::blank_at(code, at); blank.kind != syntax::BlankKind::None) {
        at = std::max(blank.end, at + 1);
      } else if (code[at] == '\'' || code[at] == '"') {
        at = end_of_literal(code, at);
      } else if (const std::size_t behind = code[at] == '%' ? end_of_address(code, at) : at; behind > at) {
        each_(at, xml_.substr(at, behind - at));
        at = behind;
      } else {
        ++at;
      }
    }
    taken_ = end;
  }

  std::string_view xml_;
  const EachAddress& each_;
  std::string code_;        // the code alone, each sign where the file has it
  std::size_t taken_ = 0;   // addresses before this place have been told
  std::size_t untold_ = 0;  // so deep in words about a program
};

}  // namespace

void for_each_address(std::string_view xml, const EachAddress& each) {
  Scan(xml, each).run();
}

std::vector<std::string> addresses_in(std::string_view xml) {
  std::vector<std::string> addresses;
  for_each_address(xml, [&](std::size_t, std::string_view address) { addresses.emplace_back(address); });
  return addresses;
}

std::string with_addresses(const std::string& xml,
                           const std::function<std::string(const std::string&)>& now) {
  std::string changed;
  std::size_t done = 0;
  for_each_address(xml, [&](std::size_t at, std::string_view address) {
    changed.append(xml, done, at - done);
    changed += now(std::string(address));
    done = at + address.size();
  });
  return changed.append(xml, done, std::string::npos);
}

}  // namespace stepwright::cell_import
