#include "runtime/operations/string_ops.h"

#include <array>
#include <type_traits>

#include "runtime/base/number_text.h"
#include "runtime/base/time_text.h"
#include "runtime/operations/string_text.h"

namespace stepwright::operations {

namespace {

using bytecode::StringOpId;
using bytecode::TrapCode;

constexpr std::uint32_t kLongestNumber = 255;  // characters of a text that is read as a number or a time

constexpr auto kOperandCounts = [] {
  std::array<std::uint8_t, bytecode::kStringOpCount> counts{};
  for (std::uint32_t i = 0; i < bytecode::kStringOpCount; ++i) {
    for (const char* c = bytecode::kStringOps[i].pops; *c != '\0'; ++c) ++counts[i];
  }
  return counts;
}();

// One operation on strings of one width. `args` are its operands, the deepest first.
template <typename Char>
class StringOperation {
 public:
  using Text = StringText<Char>;

  StringOperation(const Slot* args, std::span<std::byte> memory, std::uint64_t& budget)
      : args_(args), memory_(memory), budget_(budget) {}

  Slot result() const { return result_; }

  TrapCode init() {
    const std::int64_t capacity = number(1);
    if (capacity < 0 || capacity > std::int64_t{bytecode::kMaxStringCapacity}) return TrapCode::BadArgument;
    const std::uint64_t bytes =
        bytecode::kStringHeaderBytes + static_cast<std::uint64_t>(capacity) * sizeof(Char);
    if (!within(args_[0], bytes, memory_.size())) return reference_fault(args_[0]);
    write_as(memory_.data() + args_[0], static_cast<std::uint16_t>(capacity));
    write_as(memory_.data() + args_[0] + 2, std::uint16_t{0});
    return TrapCode::None;
  }

  TrapCode clear() {
    if (!open(0, a_)) return fault_;
    a_.set_length(0);
    return TrapCode::None;
  }

  TrapCode length() {
    if (!open(0, a_)) return fault_;
    result_ = a_.length();
    return TrapCode::None;
  }

  TrapCode copy() { return open_target_and_source() ? slice(0, a_.length()) : fault_; }

  TrapCode left() {
    std::uint32_t count = 0;
    if (!open_target_and_source() || !clamped(2, a_.length(), count)) return fault_;
    return slice(0, count);
  }

  TrapCode right() {
    std::uint32_t count = 0;
    if (!open_target_and_source() || !clamped(2, a_.length(), count)) return fault_;
    return slice(a_.length() - count, count);
  }

  TrapCode mid() {
    std::uint32_t count = 0, start = 0;
    if (!open_target_and_source() || !start_and_count(2, start, count)) return fault_;
    return slice(start, count);
  }

  TrapCode concat() { return open_target_and_sources() ? splice(a_.length(), 0) : fault_; }

  TrapCode insert() {
    std::uint32_t after = 0;
    if (!open_target_and_sources() || !clamped(3, a_.length(), after)) return fault_;
    return splice(after, 0);
  }

  TrapCode erase() {
    std::uint32_t count = 0, start = 0;
    if (!open_target_and_source() || !start_and_count(2, start, count)) return fault_;
    b_ = Text();
    return splice(start, count);
  }

  TrapCode replace() {
    std::uint32_t count = 0, start = 0;
    if (!open_target_and_sources() || !start_and_count(3, start, count)) return fault_;
    return splice(start, count);
  }

  // The position of the first occurrence; 0 if there is none or the second string is empty.
  TrapCode find() {
    if (!open(0, a_) || !open(1, b_)) return fault_;
    if (b_.length() == 0 || b_.length() > a_.length()) return TrapCode::None;
    const std::uint32_t places = a_.length() - b_.length() + 1;
    if (!charge(std::uint64_t{places} * b_.length())) return fault_;
    for (std::uint32_t place = 0; place < places; ++place) {
      std::uint32_t same = 0;
      while (same < b_.length() && a_.at(place + same) == b_.at(same)) ++same;
      if (same < b_.length()) continue;
      result_ = place + 1;
      break;
    }
    return TrapCode::None;
  }

  TrapCode compare() {
    if (!open(0, a_) || !open(1, b_)) return fault_;
    const std::uint32_t common = a_.length() < b_.length() ? a_.length() : b_.length();
    if (!charge(common)) return fault_;
    std::uint32_t same = 0;
    while (same < common && a_.at(same) == b_.at(same)) ++same;
    const std::int64_t difference =
        same < common ? std::int64_t{a_.at(same)} - b_.at(same) : std::int64_t{a_.length()} - b_.length();
    result_ = to_slot(std::int32_t{(difference > 0) - (difference < 0)});
    return TrapCode::None;
  }

  TrapCode char_at() {
    if (!open(0, a_)) return fault_;
    if (number(1) < 1 || number(1) > std::int64_t{a_.length()}) return TrapCode::IndexRange;
    result_ = a_.at(static_cast<std::uint32_t>(number(1) - 1));
    return TrapCode::None;
  }

  TrapCode set_char_at() {
    if (!open(0, a_)) return fault_;
    if (number(1) < 1 || number(1) > std::int64_t{a_.length()}) return TrapCode::IndexRange;
    a_.put(static_cast<std::uint32_t>(number(1) - 1), static_cast<Char>(args_[2]));
    return TrapCode::None;
  }

  // Writes a text of our own.
  template <typename T>
  TrapCode from(base::ShortText (*write)(T)) {
    const base::ShortText text = write(from_slot<T>(args_[1]));
    return write_plain(text.view());
  }

  TrapCode from_bool() {
    constexpr char kTrue[] = {'T', 'R', 'U', 'E'};
    constexpr char kFalse[] = {'F', 'A', 'L', 'S', 'E'};
    return args_[1] != 0 ? write_plain(kTrue) : write_plain(kFalse);
  }

  // Reads the whole text as a value.
  template <typename T>
  TrapCode to(bool (*read)(std::span<const char>, T&)) {
    if (!open(0, a_)) return fault_;
    if (a_.length() > kLongestNumber) return TrapCode::BadArgument;
    if (!charge(a_.length())) return fault_;
    char plain[kLongestNumber];
    for (std::uint32_t i = 0; i < a_.length(); ++i) {
      // What is not ASCII is in no number.
      plain[i] = a_.at(i) < 0x80 ? static_cast<char>(a_.at(i)) : '?';
    }
    T value{};
    if (!read(std::span(plain).first(a_.length()), value)) return TrapCode::BadArgument;
    result_ = to_slot(value);
    return TrapCode::None;
  }

  // From the other width. A character that a STRING cannot hold becomes a question mark.
  template <typename Other>
  TrapCode convert() {
    StringText<Other> source;
    fault_ = StringText<Other>::open(memory_, args_[1], source);
    if (fault_ != TrapCode::None || !open(0, target_)) return fault_;
    if (!target_.is_or_is_apart_from(source)) return TrapCode::BadReference;
    if (!charge(source.length())) return fault_;
    for (std::uint32_t i = 0; i < source.length() && i < target_.capacity(); ++i) {
      const Other c = source.at(i);
      target_.put(i, static_cast<Char>(c) == c ? static_cast<Char>(c) : Char{'?'});
    }
    target_.set_length(source.length());
    return TrapCode::None;
  }

 private:
  std::int64_t number(std::uint32_t arg) const { return from_slot<std::int32_t>(args_[arg]); }

  bool fail(TrapCode code) {
    fault_ = code;
    return false;
  }
  bool charge(std::uint64_t characters) {
    if (characters > budget_) return fail(TrapCode::Watchdog);
    budget_ -= characters;
    return true;
  }
  bool open(std::uint32_t arg, Text& text) {
    fault_ = Text::open(memory_, args_[arg], text);
    return fault_ == TrapCode::None;
  }
  bool open_target_and_source() {
    if (!open(0, target_) || !open(1, a_)) return false;
    return target_.is_or_is_apart_from(a_) || fail(TrapCode::BadReference);
  }
  bool open_target_and_sources() {
    if (!open_target_and_source() || !open(2, b_)) return false;
    return target_.is_or_is_apart_from(b_) || fail(TrapCode::BadReference);
  }

  // A count or position operand, cut to `most`; negative is outside the function's domain.
  bool clamped(std::uint32_t arg, std::uint32_t most, std::uint32_t& value) {
    if (number(arg) < 0) return fail(TrapCode::BadArgument);
    value = number(arg) < std::int64_t{most} ? static_cast<std::uint32_t>(number(arg)) : most;
    return true;
  }

  // The operands L and P of MID, DELETE and REPLACE: a start from 0 and a count within the source. P = 0
  // counts as 1.
  bool start_and_count(std::uint32_t arg, std::uint32_t& start, std::uint32_t& count) {
    if (!clamped(arg + 1, a_.length() + 1, start)) return false;
    if (start > 0) --start;
    return clamped(arg, a_.length() - start, count);
  }

  TrapCode slice(std::uint32_t start, std::uint32_t count) {
    if (!charge(count)) return fault_;
    target_.copy(0, a_, start, count);
    target_.set_length(count);
    return TrapCode::None;
  }

  // target := a[0..head) b a[head + removed..). The order of the copies keeps what a later one still needs,
  // also where the target is one source or both.
  TrapCode splice(std::uint32_t head, std::uint32_t removed) {
    const std::uint32_t tail = a_.length() - head - removed;
    if (!charge(std::uint64_t{head} + b_.length() + tail)) return fault_;
    if (target_.is(a_)) {
      target_.copy(head + b_.length(), a_, head + removed, tail);
      target_.copy(head, b_, 0, b_.length());
    } else {
      target_.copy(head, b_, 0, b_.length());
      target_.copy(0, a_, 0, head);
      target_.copy(head + b_.length(), a_, head + removed, tail);
    }
    target_.set_length(head + b_.length() + tail);
    return TrapCode::None;
  }

  TrapCode write_plain(std::span<const char> text) {
    if (!open(0, target_) || !charge(text.size())) return fault_;
    for (std::uint32_t i = 0; i < text.size() && i < target_.capacity(); ++i) {
      target_.put(i, static_cast<Char>(text[i]));
    }
    target_.set_length(static_cast<std::uint32_t>(text.size()));
    return TrapCode::None;
  }

  const Slot* args_;
  std::span<std::byte> memory_;
  std::uint64_t& budget_;
  Text target_;
  Text a_;
  Text b_;
  Slot result_ = 0;
  TrapCode fault_ = TrapCode::None;
};

// `id` is the operation on STRING.
template <typename Char>
TrapCode run(StringOpId id, StringOperation<Char>& op) {
  using Id = StringOpId;
  switch (id) {
    case Id::InitS:
      return op.init();
    case Id::ClearS:
      return op.clear();
    case Id::LengthS:
      return op.length();
    case Id::CopyS:
      return op.copy();
    case Id::ConcatS:
      return op.concat();
    case Id::LeftS:
      return op.left();
    case Id::RightS:
      return op.right();
    case Id::MidS:
      return op.mid();
    case Id::InsertS:
      return op.insert();
    case Id::DeleteS:
      return op.erase();
    case Id::ReplaceS:
      return op.replace();
    case Id::FindS:
      return op.find();
    case Id::CompareS:
      return op.compare();
    case Id::CharAtS:
      return op.char_at();
    case Id::SetCharAtS:
      return op.set_char_at();
    case Id::FromBoolS:
      return op.from_bool();
    case Id::ToBoolS:
      return op.template to<bool>(base::parse);
    case Id::FromI64S:
      return op.template from<std::int64_t>(base::text_of);
    case Id::ToI64S:
      return op.template to<std::int64_t>(base::parse);
    case Id::FromU64S:
      return op.template from<std::uint64_t>(base::text_of);
    case Id::ToU64S:
      return op.template to<std::uint64_t>(base::parse);
    case Id::FromF32S:
      return op.template from<float>(base::text_of);
    case Id::ToF32S:
      return op.template to<float>(base::parse);
    case Id::FromF64S:
      return op.template from<double>(base::text_of);
    case Id::ToF64S:
      return op.template to<double>(base::parse);
    case Id::FromTimeS:
      return op.template from<std::int64_t>(base::text_of_time);
    case Id::ToTimeS:
      return op.template to<std::int64_t>(base::parse_time);
    case Id::FromDateS:
      return op.template from<std::int64_t>(base::text_of_date);
    case Id::ToDateS:
      return op.template to<std::int64_t>(base::parse_date);
    case Id::FromTodS:
      return op.template from<std::int64_t>(base::text_of_time_of_day);
    case Id::ToTodS:
      return op.template to<std::int64_t>(base::parse_time_of_day);
    case Id::FromDtS:
      return op.template from<std::int64_t>(base::text_of_date_and_time);
    case Id::ToDtS:
      return op.template to<std::int64_t>(base::parse_date_and_time);
    case Id::WstringToString:
      return op.template convert<std::conditional_t<sizeof(Char) == 1, std::uint16_t, std::uint8_t>>();
    default:
      return TrapCode::BadArgument;
  }
}

// Between the widths: belongs to that of its destination.
constexpr bool converts(StringOpId id) {
  return id == StringOpId::StringToWstring || id == StringOpId::WstringToString;
}

// The two widths of an operation are neighbours. A test reads as the conversion does of which it tells.
template <typename Char>
TrapCode run_as(StringOpId id, Slot*& sp, std::span<std::byte> memory, std::uint64_t& budget) {
  const auto number = static_cast<std::uint8_t>(id);
  Slot* const args = sp - kOperandCounts[number];
  StringOperation<Char> op(args, memory, budget);
  const bool tests = bytecode::is_test(id);
  const auto narrow = static_cast<StringOpId>(number - number % 2);
  const StringOpId same = tests ? bytecode::tested_by(narrow) : narrow;
  const TrapCode code = run(converts(id) ? StringOpId::WstringToString : same, op);
  if (code != TrapCode::None && !(tests && code == TrapCode::BadArgument)) return code;
  sp = args;
  if (tests) {
    *sp++ = code == TrapCode::None ? 1 : 0;
  } else if (*bytecode::kStringOps[number].pushes != '\0') {
    *sp++ = op.result();
  }
  return TrapCode::None;
}

static_assert(static_cast<int>(StringOpId::InitS) == 0 &&
              static_cast<int>(StringOpId::StringToWstring) % 2 == 0);

}  // namespace

TrapCode call_string_op(StringOpId id, Slot*& sp, std::span<std::byte> memory, std::uint64_t& budget) {
  const bool odd = static_cast<std::uint8_t>(id) % 2 == 1;
  const bool wide = id == StringOpId::StringToWstring || (odd && id != StringOpId::WstringToString);
  return wide ? run_as<std::uint16_t>(id, sp, memory, budget) : run_as<std::uint8_t>(id, sp, memory, budget);
}

}  // namespace stepwright::operations
