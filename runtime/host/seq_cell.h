#pragma once

// The newest value of a plain type, written by one thread and copied by any others without a lock (a seqlock
// of atomic words, so that a copy that overlaps a write is well defined and thrown away).
//
// Thread rule: one writer, which never waits; readers repeat until their copy is whole, and let others run
// meanwhile: the writer may have been interrupted in the middle.

#include <array>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <thread>
#include <type_traits>

namespace stepwright::host {

template <typename T>
class SeqCell {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void store(const T& value) {
    std::array<std::uint64_t, kWords> words{};
    std::memcpy(words.data(), &value, sizeof(T));
    const std::uint64_t begin = sequence_.load(std::memory_order_relaxed) + 1;
    sequence_.store(begin, std::memory_order_relaxed);
    // Each word is a release: whoever sees one of them sees that a write has begun.
    for (std::size_t i = 0; i < kWords; ++i) words_[i].store(words[i], std::memory_order_release);
    sequence_.store(begin + 1, std::memory_order_release);
  }

  T load() const {
    std::array<std::uint64_t, kWords> words{};
    for (int attempt = 0;; ++attempt) {
      if (attempt >= kAtOnce) std::this_thread::yield();
      const std::uint64_t before = sequence_.load(std::memory_order_acquire);
      for (std::size_t i = 0; i < kWords; ++i) words[i] = words_[i].load(std::memory_order_acquire);
      if (before % 2 == 0 && sequence_.load(std::memory_order_relaxed) == before) break;
    }
    T value;
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
    return value;
  }

 private:
  static constexpr int kAtOnce = 4;
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
  std::atomic<std::uint64_t> sequence_{0};
  std::array<std::atomic<std::uint64_t>, kWords> words_{};
};

}  // namespace stepwright::host
