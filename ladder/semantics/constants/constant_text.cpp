#include "ladder/semantics/constants/constant_text.h"

#include <algorithm>

#include "ladder/semantics/constants/constant_conversion.h"
#include "runtime/base/number_text.h"
#include "runtime/base/time_text.h"

namespace stepwright::semantics {

namespace {

using bytecode::StringOpId;
using Operands = std::span<const Constant>;
using Text = std::u16string;

constexpr std::size_t kLongestNumber = 255;  // as the machine has it

std::optional<std::size_t> clamped(const Constant& count, std::size_t most) {
  if (count.integer < 0) return std::nullopt;
  return count.integer < static_cast<__int128>(most) ? static_cast<std::size_t>(count.integer) : most;
}

struct Range {
  std::size_t start = 0;
  std::size_t count = 0;
};

// L and P of MID, DELETE and REPLACE; P = 0 counts as 1.
std::optional<Range> range_of(const Text& text, const Constant& length, const Constant& position) {
  auto start = clamped(position, text.size() + 1);
  if (!start) return std::nullopt;
  if (*start > 0) --*start;
  const auto count = clamped(length, text.size() - *start);
  return count ? std::optional(Range{*start, *count}) : std::nullopt;
}

std::optional<Text> edited(StringOpId op, Operands operands) {
  const Text& first = operands[0].text;
  switch (op) {
    case StringOpId::CopyS:
      return first;
    case StringOpId::ConcatS: {
      Text all;
      for (const Constant& each : operands) all += each.text;
      return all;
    }
    case StringOpId::LeftS:
    case StringOpId::RightS: {
      const auto count = clamped(operands[1], first.size());
      if (!count) return std::nullopt;
      return op == StringOpId::LeftS ? first.substr(0, *count) : first.substr(first.size() - *count);
    }
    case StringOpId::MidS:
    case StringOpId::DeleteS: {
      const auto range = range_of(first, operands[1], operands[2]);
      if (!range) return std::nullopt;
      if (op == StringOpId::MidS) return first.substr(range->start, range->count);
      return Text(first).erase(range->start, range->count);
    }
    case StringOpId::InsertS: {
      const auto after = clamped(operands[2], first.size());
      return after ? std::optional(Text(first).insert(*after, operands[1].text)) : std::nullopt;
    }
    case StringOpId::ReplaceS: {
      const auto range = range_of(first, operands[2], operands[3]);
      if (!range) return std::nullopt;
      return Text(first).replace(range->start, range->count, operands[1].text);
    }
    case StringOpId::SetCharAtS:
      return Text(1, static_cast<char16_t>(operands[0].integer));
    case StringOpId::StringToWstring:
      return first;
    case StringOpId::WstringToString: {
      Text narrow = first;
      std::ranges::replace_if(
          narrow, [](char16_t c) { return c > 0xFF; }, char16_t{kNoCharacter});
      return narrow;
    }
    default:
      return std::nullopt;
  }
}

Text plain(const base::ShortText& text) {
  return {text.view().begin(), text.view().end()};
}

std::optional<Text> written(StringOpId op, const Constant& value) {
  const auto whole = static_cast<std::int64_t>(value.integer);
  switch (op) {
    case StringOpId::FromBoolS:
      return whole != 0 ? u"TRUE" : u"FALSE";
    case StringOpId::FromI64S:
      return plain(base::text_of(whole));
    case StringOpId::FromU64S:
      return plain(base::text_of(static_cast<std::uint64_t>(value.integer)));
    case StringOpId::FromF32S:
      return plain(base::text_of(static_cast<float>(value.real)));
    case StringOpId::FromF64S:
      return plain(base::text_of(value.real));
    case StringOpId::FromTimeS:
      return plain(base::text_of_time(whole));
    case StringOpId::FromDateS:
      return plain(base::text_of_date(whole));
    case StringOpId::FromTodS:
      return plain(base::text_of_time_of_day(whole));
    case StringOpId::FromDtS:
      return plain(base::text_of_date_and_time(whole));
    default:
      return std::nullopt;
  }
}

template <typename T>
std::optional<Constant> parsed(const std::string& text, bool (*parse)(std::span<const char>, T&)) {
  T value{};
  if (!parse(text, value)) return std::nullopt;
  if constexpr (std::is_floating_point_v<T>) return Constant{0, value};
  return Constant{static_cast<__int128>(value)};
}

std::optional<Constant> read(StringOpId op, const Text& text) {
  if (text.size() > kLongestNumber) return std::nullopt;
  std::string narrow;
  for (const char16_t c : text) narrow += c < 0x80 ? static_cast<char>(c) : '?';
  switch (op) {
    case StringOpId::ToBoolS:
      return parsed<bool>(narrow, base::parse);
    case StringOpId::ToI64S:
      return parsed<std::int64_t>(narrow, base::parse);
    case StringOpId::ToU64S:
      return parsed<std::uint64_t>(narrow, base::parse);
    case StringOpId::ToF32S:
      return parsed<float>(narrow, base::parse);
    case StringOpId::ToF64S:
      return parsed<double>(narrow, base::parse);
    case StringOpId::ToTimeS:
      return parsed<std::int64_t>(narrow, base::parse_time);
    case StringOpId::ToDateS:
      return parsed<std::int64_t>(narrow, base::parse_date);
    case StringOpId::ToTodS:
      return parsed<std::int64_t>(narrow, base::parse_time_of_day);
    case StringOpId::ToDtS:
      return parsed<std::int64_t>(narrow, base::parse_date_and_time);
    default:
      return std::nullopt;
  }
}

std::optional<Constant> measured(StringOpId op, Operands operands) {
  const Text& text = operands[0].text;
  switch (op) {
    case StringOpId::LengthS:
      return Constant{static_cast<__int128>(text.size())};
    case StringOpId::FindS: {
      const std::size_t at = text.find(operands[1].text);
      const bool found = at != Text::npos && !operands[1].text.empty();
      return Constant{found ? static_cast<__int128>(at) + 1 : 0};
    }
    case StringOpId::CompareS:
      return Constant{compare_texts(text, operands[1].text)};
    case StringOpId::CharAtS: {
      const __int128 at = operands[1].integer;
      if (at < 1 || at > static_cast<__int128>(text.size())) return std::nullopt;
      return Constant{text[static_cast<std::size_t>(at) - 1]};
    }
    default:
      return std::nullopt;
  }
}

}  // namespace

int compare_texts(const std::u16string& left, const std::u16string& right) {
  const int order = left.compare(right);
  return (order > 0) - (order < 0);
}

std::optional<Constant> evaluate_text(StringOpId narrow, std::span<const Constant> operands,
                                      const Type& result) {
  if (!result.is_string()) {
    if (const auto value = measured(narrow, operands)) return value;
    const auto value = read(narrow, operands[0].text);
    const bool held = value && (result.is_real() || fits(*value, result));
    return held ? value : std::nullopt;
  }
  auto text = edited(narrow, operands);
  if (!text) text = written(narrow, operands[0]);
  if (!text) return std::nullopt;
  if (text->size() > result.capacity) text->resize(result.capacity);
  return Constant{0, 0, std::move(*text)};
}

}  // namespace stepwright::semantics
