#include "runtime/bytecode/table_check.h"

#include "runtime/bytecode/member_bit.h"
#include "runtime/bytecode/utf8.h"
#include "runtime/bytecode/whole_number.h"

namespace stepwright::bytecode {

namespace {

bool in_range(std::uint64_t first, std::uint64_t count, std::uint64_t size) {
  return first <= size && count <= size - first;
}

class TableChecker {
 public:
  explicit TableChecker(const ContainerView& view) : view_(view) {}

  VerifyResult run() {
    VerifyResult result = sizes();
    const auto next = [&](auto check) {
      if (result.ok()) result = check();
    };
    next([&] { return each<Section::Members>([&](auto& r, auto) { return member(r); }); });
    next([&] { return each<Section::Types>([&](auto& r, auto i) { return type(r, i); }); });
    next([&] { return each<Section::Symbols>([&](auto& r, auto) { return symbol(r); }); });
    next([&] { return each<Section::Locals>([&](auto& r, auto) { return valid(r < kStackTypeCount); }); });
    next([&] { return each<Section::Functions>([&](auto& r, auto) { return function(r); }); });
    next([&] { return each<Section::ProgramCalls>([&](auto& r, auto) { return program_call(r); }); });
    next([&] { return each<Section::Tasks>([&](auto& r, auto) { return task(r); }); });
    next([&] { return task_count(); });
    next([&] { return initial_data(); });
    next([&] { return each<Section::IoMap>([&](auto& r, auto) { return io(r); }); });
    next([&] { return each<Section::RetainMap>([&](auto& r, auto) { return address(r.address, r.size); }); });
    next([&] { return each<Section::SfcCharts>([&](auto& r, auto) { return chart(r); }); });
    next([&] { return each<Section::SfcSteps>([&](auto& r, auto) { return step(r); }); });
    next([&] { return each<Section::SfcTransitions>([&](auto& r, auto) { return transition(r); }); });
    next([&] { return each<Section::SourceFiles>([&](auto& r, auto) { return string(r); }); });
    next([&] { return each<Section::SourceMap>([&](auto& r, auto i) { return source(r, i); }); });
    return result;
  }

 private:
  using Status = VerifyStatus;

  template <Section S, typename Check>
  VerifyResult each(Check check) {
    for (std::uint32_t i = 0; i < view_.count<S>(); ++i) {
      const Record<S> record = view_.record<S>(i);
      const Status status = check(record, i);
      if (status != Status::Ok) return {status, S, i, 0};
    }
    return {};
  }

  static Status valid(bool condition) { return condition ? Status::Ok : Status::BadRecord; }
  static Status first_of(Status a, Status b) { return a != Status::Ok ? a : b; }

  Status string(StringRef ref) const { return string(ref, kMaxStringBytes); }

  // Long ones are counted together: a small file may use one many times, and viewers copy each use.
  Status text(StringRef ref) {
    if (ref.length > kMaxStringBytes) long_texts_ += ref.length;
    return long_texts_ > kMaxLongTextBytes ? Status::BadString : string(ref, kMaxTextBytes);
  }

  Status string(StringRef ref, std::uint32_t longest) const {
    if (ref.length > longest) return Status::BadString;
    if (!in_range(ref.offset, ref.length, view_.section(Section::Strings).size())) return Status::BadString;
    return is_utf8(view_.string(ref)) ? Status::Ok : Status::BadString;
  }

  Status address(std::uint64_t start, std::uint64_t size) const {
    return in_range(start, size, image_size_) ? Status::Ok : Status::BadAddress;
  }

  // Owned ranges follow each other, so that no file can make the verifier read one range many times.
  static bool next_range(std::uint32_t& cursor, std::uint32_t first, std::uint32_t count,
                         std::uint32_t size) {
    if (first != cursor || !in_range(first, count, size)) return false;
    cursor += count;
    return true;
  }

  // The place of a boolean: a byte of the image, or a bit of one.
  Status bit_address(std::uint32_t byte, std::uint8_t bit) const {
    return first_of(address(byte, 1), valid(bit == kNoBit || bit < 8));
  }

  VerifyResult sizes() {
    if (view_.count<Section::Sizes>() != 1) return {Status::BadRecord, Section::Sizes, 0, 0};
    const SizesRecord sizes = view_.sizes();
    image_size_ = image_bytes(sizes);
    if (memory_bytes(sizes, view_.count<Section::Tasks>()) > kMaxImageBytes ||
        sizes.stack_slots > kMaxStackSlots || sizes.call_depth > kMaxCallDepth) {
      return {Status::TooLarge, Section::Sizes, 0, 0};
    }
    return {};
  }

  Status member(const MemberRecord& r) const {
    const std::uint32_t possible = r.type == kNoIndex ? 0 : kMemberFlagMask | kMemberBitMask;
    const bool has_bit = (r.flags & kMemberBit) != 0 || r.flags >> kMemberBitShift == 0;
    return first_of(valid((r.flags & ~possible) == 0 && has_bit), string(r.name));
  }

  Status type(const TypeRecord& r, std::uint32_t index) {
    const bool ok = r.kind < kTypeKindCount && r.elementary < kElementaryTypeCount && r.reserved == 0 &&
                    r.size <= kMaxImageBytes && kind(r, index);
    return first_of(ok ? Status::Ok : Status::BadType, string(r.name));
  }

  // The rules of each kind. Types contain earlier ones only, so that no type contains itself; a reference may
  // lead to any.
  bool kind(const TypeRecord& r, std::uint32_t index) {
    const auto elementary = static_cast<ElementaryType>(r.elementary);
    const bool scalar = !is_string(elementary) && r.size == size_of(mem_type(elementary));
    const bool no_parts = r.first == 0 && r.count == 0;
    const bool no_bounds = r.lower == 0 && r.upper == 0;
    switch (static_cast<TypeKind>(r.kind)) {
      case TypeKind::Elementary:
        return scalar && no_parts && no_bounds;
      case TypeKind::Array:
        return r.elementary == 0 && r.first < index && r.count > 0 && is_i32(r.lower) && is_i32(r.upper) &&
               r.upper - r.lower + 1 == std::int64_t{r.count} &&
               std::uint64_t{r.count} * view_.record<Section::Types>(r.first).size == r.size;
      case TypeKind::Struct:
      case TypeKind::Instance:
        return r.elementary == 0 && no_bounds && members(r, index);
      case TypeKind::String:
        return is_string(elementary) && r.first == 0 && no_bounds && r.count <= kMaxStringCapacity &&
               r.size == string_bytes(elementary, r.count);
      case TypeKind::Enumeration:
        return scalar && is_whole_number(elementary) && no_bounds && enumerators(r);
      case TypeKind::Reference:
        return r.elementary == 0 && r.size == size_of(MemType::Ref) && r.count == 0 && no_bounds &&
               r.first < view_.count<Section::Types>();
      case TypeKind::Subrange:
        return scalar && is_whole_number(elementary) && no_parts &&
               (is_unsigned(elementary)
                    ? static_cast<std::uint64_t>(r.lower) <= static_cast<std::uint64_t>(r.upper)
                    : r.lower <= r.upper);
    }
    return false;
  }

  static bool is_i32(std::int64_t value) { return value == static_cast<std::int32_t>(value); }

  bool enumerators(const TypeRecord& r) {
    if (!next_range(next_member_, r.first, r.count, view_.count<Section::Members>())) return false;
    for (std::uint32_t m = r.first; m < r.first + r.count; ++m) {
      if (view_.record<Section::Members>(m).type != kNoIndex) return false;
    }
    return true;
  }

  bool members(const TypeRecord& r, std::uint32_t index) {
    if (!next_range(next_member_, r.first, r.count, view_.count<Section::Members>())) return false;
    for (std::uint32_t m = r.first; m < r.first + r.count; ++m) {
      const MemberRecord member = view_.record<Section::Members>(m);
      if (member.type >= index) return false;
      const bool is_bit = member_bit(member.flags) != kNoBit;
      if (is_bit && !is_bool_type(view_.record<Section::Types>(member.type))) return false;
      if (!in_range(member.offset, view_.record<Section::Types>(member.type).size, r.size)) return false;
    }
    return true;
  }

  Status symbol(const SymbolRecord& r) const {
    if (r.type >= view_.count<Section::Types>()) return Status::BadType;
    const TypeRecord type = view_.record<Section::Types>(r.type);
    const bool is_bool = is_bool_type(type);
    if (r.section >= kSymbolSectionCount || (r.flags & ~kSymbolFlagMask) != 0) return Status::BadRecord;
    if (r.bit != kNoBit && (r.bit > 7 || !is_bool)) return Status::BadRecord;
    return first_of(string(r.name), address(r.address, type.size));
  }

  static bool is_bool_type(const TypeRecord& type) {
    return type.kind == static_cast<std::uint8_t>(TypeKind::Elementary) &&
           type.elementary == static_cast<std::uint8_t>(ElementaryType::Bool);
  }

  Status function(const FunctionRecord& r) {
    if (r.kind >= kFunctionKindCount || (r.flags & ~kFunctionFlagMask) != 0) return Status::BadRecord;
    const bool is_function = r.kind == static_cast<std::uint8_t>(FunctionKind::Function);
    const bool signature = is_function
                               ? r.instance_size == 0 && (r.result < kStackTypeCount || r.result == kNoResult)
                               : r.param_count == 0 && r.result == kNoResult;
    const bool ranges =
        r.param_count <= r.local_count && r.local_count <= kMaxLocals &&
        next_range(next_local_, r.first_local, r.local_count, view_.count<Section::Locals>()) &&
        next_range(next_code_, r.code_offset, r.code_size, view_.count<Section::Code>());
    const Status frame =
        in_range(r.frame_offset, r.frame_size, view_.sizes().frame_bytes) ? Status::Ok : Status::BadFrame;
    return first_of(first_of(valid(signature && ranges), frame),
                    first_of(string(r.name), address(0, r.instance_size)));
  }

  Status program_call(const ProgramCallRecord& r) const {
    if (r.function >= view_.count<Section::Functions>()) return Status::BadRecord;
    const FunctionRecord function = view_.record<Section::Functions>(r.function);
    if (function.kind != static_cast<std::uint8_t>(FunctionKind::Program)) return Status::BadRecord;
    return first_of(string(r.name), address(r.instance, function.instance_size));
  }

  Status task(const TaskRecord& r) const {
    const bool calls = in_range(r.first_call, r.call_count, view_.count<Section::ProgramCalls>());
    return first_of(valid(calls && trigger(r)), string(r.name));
  }

  bool trigger(const TaskRecord& r) const {
    if (r.trigger == kNoIndex) return true;
    if (r.trigger >= view_.count<Section::Symbols>()) return false;
    return is_bool_type(view_.record<Section::Types>(view_.record<Section::Symbols>(r.trigger).type));
  }

  // Triggers are looked at in the scans of the tasks without one: were there none, nothing would ever run.
  VerifyResult task_count() const {
    const std::uint32_t count = view_.count<Section::Tasks>();
    bool periodic = false;
    for (std::uint32_t i = 0; i < count; ++i) {
      const TaskRecord task = view_.record<Section::Tasks>(i);
      periodic = periodic || task.interval_us > 0 || task.trigger == kNoIndex;
    }
    if (periodic && count <= kMaxTasks) return {};
    return {Status::BadRecord, Section::Tasks, count, 0};
  }

  VerifyResult initial_data() const {
    if (view_.section(Section::InitialData).size() <= image_size_) return {};
    return {Status::BadAddress, Section::InitialData, 0, 0};
  }

  Status io(const IoRecord& r) const {
    if (r.symbol >= view_.count<Section::Symbols>()) return Status::BadRecord;
    const SymbolRecord symbol = view_.record<Section::Symbols>(r.symbol);
    return first_of(valid((symbol.flags & kSymbolLocated) != 0), string(r.address));
  }

  Status chart(const SfcChartRecord& r) {
    if (!next_range(next_step_, r.first_step, r.step_count, view_.count<Section::SfcSteps>()) ||
        !next_range(next_transition_, r.first_transition, r.transition_count,
                    view_.count<Section::SfcTransitions>())) {
      return Status::BadRecord;
    }
    for (std::uint32_t t = r.first_transition; t < r.first_transition + r.transition_count; ++t) {
      const SfcTransitionRecord transition = view_.record<Section::SfcTransitions>(t);
      if (!links(transition.first_source, transition.source_count, r.step_count) ||
          !links(transition.first_target, transition.target_count, r.step_count)) {
        return Status::BadRecord;
      }
    }
    return string(r.name);
  }

  bool links(std::uint32_t first, std::uint32_t count, std::uint32_t step_count) {
    if (!next_range(next_link_, first, count, view_.count<Section::SfcLinks>())) return false;
    for (std::uint32_t i = first; i < first + count; ++i) {
      if (view_.record<Section::SfcLinks>(i) >= step_count) return false;
    }
    return true;
  }

  Status step(const SfcStepRecord& r) {
    return first_of(valid(r.reserved == 0 && (r.flags & ~kStepInitial) == 0),
                    first_of(bit_address(r.address, r.bit), first_of(string(r.name), text(r.comment))));
  }

  Status transition(const SfcTransitionRecord& r) {
    const Status place = r.address == kNoIndex ? valid(r.bit == kNoBit) : bit_address(r.address, r.bit);
    const Status links_in_file =
        valid(in_range(r.first_source, r.source_count, view_.count<Section::SfcLinks>()) &&
              in_range(r.first_target, r.target_count, view_.count<Section::SfcLinks>()));
    return first_of(first_of(place, links_in_file), first_of(string(r.name), text(r.condition)));
  }

  Status source(const SourceMapRecord& r, std::uint32_t index) const {
    if (r.function >= view_.count<Section::Functions>()) return Status::BadRecord;
    if (r.pc >= view_.record<Section::Functions>(r.function).code_size) return Status::BadRecord;
    if (r.file >= view_.count<Section::SourceFiles>() || r.line == 0) return Status::BadRecord;
    if (index == 0) return Status::Ok;
    const SourceMapRecord before = view_.record<Section::SourceMap>(index - 1);
    return valid(before.function < r.function || (before.function == r.function && before.pc < r.pc));
  }

  const ContainerView& view_;
  std::uint64_t image_size_ = 0;
  std::uint32_t next_member_ = 0;
  std::uint32_t next_local_ = 0;
  std::uint32_t next_code_ = 0;
  std::uint32_t next_step_ = 0;
  std::uint32_t next_transition_ = 0;
  std::uint32_t next_link_ = 0;
  std::uint64_t long_texts_ = 0;  // bytes
};

}  // namespace

VerifyResult check_tables(const ContainerView& view) {
  return TableChecker(view).run();
}

}  // namespace stepwright::bytecode
