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

std::uint32_t ContainerModel::add_type(Type type) {
  for (std::size_t i = 0; i < types.size(); ++i) {
    if (types[i].name == type.name) return static_cast<std::uint32_t>(i);
  }
  types.push_back(std::move(type));
  return static_cast<std::uint32_t>(types.size() - 1);
}

}  // namespace stepwright::writer
