#include "firmware/storage/program_store.h"

namespace stepwright::storage {

ProgramStore::ProgramStore(port::Flash& flash)
    : slots_{FlashLayout(flash).slot(0), FlashLayout(flash).slot(1)} {}

int ProgramStore::newest(std::uint32_t except) const {
  int best = -1;
  FlashRecord best_record;
  for (int slot = 0; slot < 2; ++slot) {
    FlashRecord record;
    if ((except >> slot & 1) != 0 || !slots_[slot].read(record)) continue;
    if (sha256(record.data) != record.digest) continue;
    if (best >= 0 && static_cast<std::int32_t>(record.sequence - best_record.sequence) < 0) continue;
    best = slot;
    best_record = record;
  }
  return best;
}

std::span<const std::byte> ProgramStore::container(int slot) const {
  FlashRecord record;
  return slots_[slot].read(record) ? record.data : std::span<const std::byte>();
}

Digest ProgramStore::digest(int slot) const {
  FlashRecord record;
  return slots_[slot].read(record) ? record.digest : Digest{};
}

bool ProgramStore::begin(int in_use) {
  target_ = in_use == 0 ? 1 : 0;
  return slots_[target_].begin();
}

bool ProgramStore::finish(const Digest& digest) {
  return slots_[target_].finish(slots_[1 - target_].sequence() + 1, digest);
}

}  // namespace stepwright::storage
