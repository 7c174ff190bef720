// Finds equal values fast: a hash table with open addressing over the bytes of values that lie in
// somebody else's array. Used to join equal vertices and equal positions.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

namespace vindu {

/// Values are equal when their bytes are: give -0.0 as 0.0.
template <class Value>
class Deduplicator {
  static_assert(std::is_standard_layout_v<Value>);

 public:
  /// Appends to `values`, from their present end on; holds at most `capacity` distinct ones.
  /// `values` must outlive this and be changed by nobody else.
  Deduplicator(std::vector<Value>& values, std::size_t capacity) : values_(values) {
    std::size_t slots = 16;
    while (slots < 2 * capacity) slots *= 2;
    slots_.assign(slots, kFree);
  }

  /// Where the equal value lies in `values`.
  std::uint32_t index_of(const Value& value) {
    const Words words = words_of(value);
    std::size_t slot = hash_of(words) & (slots_.size() - 1);
    for (; slots_[slot] != kFree; slot = (slot + 1) & (slots_.size() - 1))
      if (words_of(values_[slots_[slot]]) == words) return slots_[slot];
    slots_[slot] = static_cast<std::uint32_t>(values_.size());
    values_.push_back(value);
    return slots_[slot];
  }

 private:
  static_assert(sizeof(Value) % sizeof(std::uint32_t) == 0);
  using Words = std::array<std::uint32_t, sizeof(Value) / sizeof(std::uint32_t)>;
  static constexpr std::uint32_t kFree = 0xffffffff;

  /// The bytes as they are, on purpose: values are small vectors of floats without padding.
  static Words words_of(const Value& value) {
    Words words;
    std::memcpy(words.data(), static_cast<const void*>(&value), sizeof(Value));
    return words;
  }

  /// FNV-1a over 32-bit words, its high bits folded down (the low ones of floats hardly differ).
  static std::size_t hash_of(const Words& words) {
    std::uint64_t hash = 14695981039346656037u;
    for (const std::uint32_t word : words) hash = (hash ^ word) * 1099511628211u;
    return hash ^ (hash >> 29) ^ (hash >> 43);
  }

  std::vector<Value>& values_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace vindu
