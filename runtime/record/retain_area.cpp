#include "runtime/record/retain_area.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <utility>

#include "runtime/record/state_layout.h"

namespace stepwright::record {
namespace {

using bytecode::Section;

bool belongs(const StateVariable& variable) {
  return (variable.flags & kStateRetain) != 0 && (variable.flags & kStateConstant) == 0;
}

}  // namespace

RetainArea RetainArea::of(const bytecode::Program& program) {
  const bytecode::ContainerView& view = program.container();
  RetainArea area;
  for (std::uint32_t i = 0; i < view.count<Section::RetainMap>(); ++i) {
    const auto record = view.record<Section::RetainMap>(i);
    if (record.size > 0) area.pieces_.push_back({record.address, record.size, 0});
  }
  auto& pieces = area.pieces_;
  std::sort(pieces.begin(), pieces.end(), [](const auto& l, const auto& r) { return l.address < r.address; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    Piece& joined = pieces[last];
    if (pieces[i].address <= joined.address + joined.size) {
      const std::uint32_t end = std::max(joined.address + joined.size, pieces[i].address + pieces[i].size);
      joined.size = end - joined.address;
    } else {
      pieces[++last] = pieces[i];
    }
  }
  if (!pieces.empty()) pieces.resize(last + 1);
  for (Piece& piece : pieces) {
    piece.offset = area.size_;
    area.size_ += piece.size;
  }
  return area;
}

const RetainArea::Piece* RetainArea::piece_of(std::uint32_t address) const {
  auto behind = std::upper_bound(pieces_.begin(), pieces_.end(), address,
                                 [](std::uint32_t at, const Piece& piece) { return at < piece.address; });
  if (behind == pieces_.begin()) return nullptr;
  const Piece& piece = *--behind;
  return address - piece.address < piece.size ? &piece : nullptr;
}

bool RetainArea::holds(std::uint32_t address, std::uint32_t count) const {
  const Piece* piece = piece_of(address);
  return piece != nullptr && count <= piece->size - (address - piece->address);
}

std::optional<std::uint32_t> RetainArea::offset_of(std::uint32_t address) const {
  const Piece* piece = piece_of(address);
  if (piece == nullptr) return std::nullopt;
  return piece->offset + (address - piece->address);
}

void RetainArea::gather(std::span<const std::byte> image, std::span<std::byte> payload) const {
  assert(payload.size() >= size_);
  for (const Piece& piece : pieces_) {
    std::memcpy(payload.data() + piece.offset, image.data() + piece.address, piece.size);
  }
}

StateLayout RetainArea::in_image(const StateLayout& layout) const {
  std::vector<StateVariable> variables;
  for (const StateVariable& each : layout.variables()) {
    if (belongs(each)) variables.push_back(each);
  }
  return {layout.types(), std::move(variables), layout.size()};
}

StateLayout RetainArea::in_payload(const StateLayout& layout) const {
  std::vector<StateVariable> variables;
  for (const StateVariable& each : layout.variables()) {
    if (!belongs(each)) continue;
    variables.push_back(each);
    variables.back().address = *offset_of(each.address);
  }
  return {layout.types(), std::move(variables), size_};
}

}  // namespace stepwright::record
