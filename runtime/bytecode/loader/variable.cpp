#include "runtime/bytecode/loader/variable.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "runtime/bytecode/loader/loaded_program.h"

namespace stepwright::loader {

using bytecode::Section;
using bytecode::TypeKind;

namespace {

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool equal_names(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

bool ends_name(std::string_view rest) {
  return rest.empty() || rest.front() == '.' || rest.front() == '[';
}

// A place on the way down from a symbol.
struct Place {
  std::uint32_t type = 0;
  std::uint32_t address = 0;
};

class PathWalker {
 public:
  PathWalker(const bytecode::ContainerView& view, Place place, std::string_view rest)
      : view_(view), place_(place), rest_(rest) {}

  // Follows the rest of the path; false if it leads nowhere.
  bool walk() {
    while (!rest_.empty()) {
      const bool found = rest_.front() == '.' ? member() : elements();
      if (!found) return false;
    }
    return true;
  }

  Place place() const { return place_; }

 private:
  bytecode::TypeRecord type() const { return view_.record<Section::Types>(place_.type); }

  bool member() {
    rest_.remove_prefix(1);
    const std::string_view name = rest_.substr(0, rest_.find_first_of(".["));
    const bytecode::TypeRecord record = type();
    const auto kind = static_cast<TypeKind>(record.kind);
    if (kind != TypeKind::Struct && kind != TypeKind::Instance) return false;
    for (std::uint32_t i = record.first; i < record.first + record.count; ++i) {
      const auto candidate = view_.record<Section::Members>(i);
      if (!equal_names(text_of(view_, candidate.name), name)) continue;
      place_ = {candidate.type, place_.address + candidate.offset};
      rest_.remove_prefix(name.size());
      return true;
    }
    return false;
  }

  // "[1]", "[1,2]"
  bool elements() {
    if (rest_.front() != '[') return false;
    do {
      rest_.remove_prefix(1);
      if (!element()) return false;
    } while (!rest_.empty() && rest_.front() == ',');
    if (rest_.empty() || rest_.front() != ']') return false;
    rest_.remove_prefix(1);
    return ends_name(rest_);
  }

  bool element() {
    while (!rest_.empty() && rest_.front() == ' ') rest_.remove_prefix(1);
    std::int32_t index = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), index);
    const bytecode::TypeRecord record = type();
    if (error != std::errc() || static_cast<TypeKind>(record.kind) != TypeKind::Array) return false;
    const std::int64_t position = std::int64_t{index} - record.lower;
    if (position < 0 || position >= std::int64_t{record.count}) return false;
    const std::uint32_t stride = view_.record<Section::Types>(record.first).size;
    place_ = {record.first, place_.address + static_cast<std::uint32_t>(position) * stride};
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return true;
  }

  const bytecode::ContainerView& view_;
  Place place_;
  std::string_view rest_;
};

template <typename T>
T read_as(std::span<const std::byte> image, std::uint32_t address) {
  T value;
  std::memcpy(&value, image.data() + address, sizeof(T));
  return value;
}

double shortest(float value) {
  char text[32];
  const auto written = std::to_chars(text, text + sizeof(text), value);
  double wide = value;
  std::from_chars(text, written.ptr, wide);
  return wide;
}

}  // namespace

result::Result<Variable> find_variable(const bytecode::Program& program, std::string_view path) {
  const bytecode::ContainerView& view = program.container();
  for (std::uint32_t i = 0; i < view.count<Section::Symbols>(); ++i) {
    const auto symbol = view.record<Section::Symbols>(i);
    const std::string name = text_of(view, symbol.name);
    if (name.size() > path.size() || !equal_names(name, path.substr(0, name.size()))) continue;
    const std::string_view rest = path.substr(name.size());
    if (!ends_name(rest)) continue;
    PathWalker walker(view, {symbol.type, symbol.address}, rest);
    if (!walker.walk()) continue;  // a longer symbol may match
    const auto type = view.record<Section::Types>(walker.place().type);
    if (static_cast<TypeKind>(type.kind) != TypeKind::Elementary) {
      return result::fail(
          "B0301", {},
          "`" + std::string(path) + "` is of type " + text_of(view, type.name) + " and has no single value",
          "name one of its elements or members");
    }
    return Variable{std::string(path), static_cast<bytecode::ElementaryType>(type.elementary),
                    walker.place().address, symbol.bit};
  }
  return result::fail("B0300", {}, "there is no variable `" + std::string(path) + "`",
                      "variables are named INSTANCE.variable, e.g. MAIN.level");
}

Value read_value(const Variable& variable, std::span<const std::byte> image) {
  using bytecode::ElementaryType;
  const std::uint32_t at = variable.address;
  switch (variable.type) {
    case ElementaryType::Bool: {
      const auto byte = read_as<std::uint8_t>(image, at);
      return variable.bit == bytecode::kNoBit ? byte != 0 : ((byte >> variable.bit) & 1) != 0;
    }
    case ElementaryType::Sint:
      return std::int64_t{read_as<std::int8_t>(image, at)};
    case ElementaryType::Int:
      return std::int64_t{read_as<std::int16_t>(image, at)};
    case ElementaryType::Dint:
      return std::int64_t{read_as<std::int32_t>(image, at)};
    case ElementaryType::Lint:
    case ElementaryType::Time:
      return read_as<std::int64_t>(image, at);
    case ElementaryType::Usint:
    case ElementaryType::Byte:
      return std::uint64_t{read_as<std::uint8_t>(image, at)};
    case ElementaryType::Uint:
    case ElementaryType::Word:
      return std::uint64_t{read_as<std::uint16_t>(image, at)};
    case ElementaryType::Udint:
    case ElementaryType::Dword:
      return std::uint64_t{read_as<std::uint32_t>(image, at)};
    case ElementaryType::Ulint:
    case ElementaryType::Lword:
      return read_as<std::uint64_t>(image, at);
    case ElementaryType::Real:
      return shortest(read_as<float>(image, at));
    case ElementaryType::Lreal:
      return read_as<double>(image, at);
  }
  return false;
}

}  // namespace stepwright::loader
