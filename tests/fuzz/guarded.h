#pragma once

// Elements flush against a page that nothing may touch, in front of them or behind them: the slightest step
// over that side stops the process, also in machine code that no sanitizer sees. The rest of the last page
// on the other side holds a pattern that must stay.
//
//   Guarded<std::uint64_t> stack(100, Side::Back);  // stack.inner()[100] is a fault

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>

namespace stepwright::fuzz {

enum class Side : std::uint8_t { Front, Back };

// Bytes between two pages without access.
class GuardedPages {
 public:
  GuardedPages(std::size_t bytes, Side side) : bytes_(bytes), side_(side) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    usable_ = std::max<std::size_t>(1, (bytes + page - 1) / page) * page;
    mapped_ = usable_ + 2 * page;
    void* const all = ::mmap(nullptr, mapped_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED) throw std::bad_alloc();
    mapping_ = static_cast<std::byte*>(all);
    first_ = mapping_ + page;
    if (::mprotect(first_, usable_, PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
    std::ranges::fill(slack(), kPattern);
  }
  ~GuardedPages() { ::munmap(mapping_, mapped_); }
  GuardedPages(const GuardedPages&) = delete;
  GuardedPages& operator=(const GuardedPages&) = delete;

  std::byte* data() const { return side_ == Side::Front ? first_ : first_ + usable_ - bytes_; }

  bool intact() const {
    return std::ranges::all_of(slack(), [](std::byte value) { return value == kPattern; });
  }

 private:
  static constexpr std::byte kPattern{0xA5};

  // The rest of the pages on the side without a guard.
  std::span<std::byte> slack() const {
    return {side_ == Side::Front ? first_ + bytes_ : first_, usable_ - bytes_};
  }

  std::size_t bytes_;
  Side side_;
  std::size_t usable_ = 0;
  std::size_t mapped_ = 0;
  std::byte* mapping_ = nullptr;
  std::byte* first_ = nullptr;
};

template <typename T>
class Guarded {
 public:
  // `size` elements of value zero.
  Guarded(std::size_t size, Side side) : pages_(size * sizeof(T), side), size_(size) {}

  std::span<T> inner() { return {reinterpret_cast<T*>(pages_.data()), size_}; }
  bool intact() const { return pages_.intact(); }

 private:
  GuardedPages pages_;
  std::size_t size_;
};

}  // namespace stepwright::fuzz
