#include "firmware/storage/retain_store.h"

namespace stepwright::storage {

RetainStore::RetainStore(port::Flash& flash)
    : areas_{FlashLayout(flash).retain(0), FlashLayout(flash).retain(1)}, page_bytes_(flash.page_bytes()) {}

std::span<const std::byte> RetainStore::values_of(const Digest& program) const {
  FlashRecord record;
  if (newest_of(areas_, record) < 0 || record.digest != program) return {};
  return record.data;
}

void RetainStore::write(const Digest& program, std::span<const std::byte> values) {
  FlashRecord record;
  const int newest = newest_of(areas_, record);
  target_ = newest == 0 ? 1 : 0;
  sequence_ = newest < 0 ? 1 : record.sequence + 1;
  program_ = program;
  values_ = values;
  left_ = values.size();
  begun_ = areas_[target_].begin();
  if (!begun_) left_ = 0;
}

void RetainStore::step() {
  if (!busy()) return;
  if (left_ == 0) {
    begun_ = false;
    static_cast<void>(areas_[target_].finish(sequence_, program_));  // if it failed, the record before holds
    return;
  }
  const std::size_t part = left_ < page_bytes_ ? left_ : page_bytes_;
  if (areas_[target_].append(values_.subspan(values_.size() - left_, part))) {
    left_ -= part;
  } else {
    left_ = 0;
    begun_ = false;
  }
}

bool RetainStore::clear() {
  left_ = 0;
  begun_ = false;
  const bool first = areas_[0].clear();
  return areas_[1].clear() && first;
}

}  // namespace stepwright::storage
