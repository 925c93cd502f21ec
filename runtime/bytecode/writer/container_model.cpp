#include "runtime/bytecode/writer/container_model.h"

#include <utility>

namespace stepwright::writer {

Type elementary(bytecode::ElementaryType type) {
  Type out;
  out.name = bytecode::name_of(type);
  out.elementary = type;
  out.size = bytecode::size_of(bytecode::mem_type(type));
  return out;
}

Type string_type(bytecode::ElementaryType type, std::uint32_t capacity) {
  Type out;
  out.name = std::string(bytecode::name_of(type)) + "[" + std::to_string(capacity) + "]";
  out.kind = bytecode::TypeKind::String;
  out.elementary = type;
  out.size = bytecode::string_bytes(type, capacity);
  out.count = capacity;
  return out;
}

std::uint32_t ContainerModel::add_type(Type type) {
  for (std::size_t i = 0; i < types.size(); ++i) {
    if (types[i].name == type.name) return static_cast<std::uint32_t>(i);
  }
  types.push_back(std::move(type));
  return static_cast<std::uint32_t>(types.size() - 1);
}

}  // namespace stepwright::writer
