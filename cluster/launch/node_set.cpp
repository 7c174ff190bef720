#include "cluster/launch/node_set.h"

#include <algorithm>
#include <map>
#include <set>

namespace vindu {
namespace {

using Numbers = std::vector<long>;

/// A name cut at its numbers. What has leading zeros or is too long for a number stays text.
struct CutName {
  std::vector<std::string> texts{""};  ///< one more than numbers
  Numbers numbers;
};

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

CutName cut(const std::string& name) {
  constexpr std::size_t kMostDigits = 9;
  CutName parts;
  for (auto at = name.begin(); at != name.end();) {
    const auto end = std::find_if_not(at, name.end(), is_digit);
    const std::string digits(at, end);
    if (digits.empty()) {
      parts.texts.back() += *at++;
      continue;
    }
    if (digits.size() > kMostDigits || (digits.size() > 1 && digits[0] == '0')) {
      parts.texts.back() += digits;
    } else {
      parts.numbers.push_back(std::stol(digits));
      parts.texts.emplace_back();
    }
    at = end;
  }
  return parts;
}

/// "3", "[0-3]", "[0-4,6]"
std::string fold_numbers(const std::set<long>& numbers) {
  std::string text;
  for (auto at = numbers.begin(); at != numbers.end();) {
    const long first = *at;
    long last = first;
    while (++at != numbers.end() && *at == last + 1) last = *at;
    if (!text.empty()) text += ',';
    text += std::to_string(first);
    if (last > first) text += '-' + std::to_string(last);
  }
  return text.find_first_of(",-") == std::string::npos ? text : '[' + text + ']';
}

/// The numbers from axis `axis` on, folded: those of the first axis that have equal rests share a
/// word. `texts` stand between them.
std::vector<std::string> fold_axes(const std::set<Numbers>& all, std::size_t axis,
                                   const std::vector<std::string>& texts) {
  if (axis == texts.size() - 1) return {texts.back()};
  std::map<long, std::set<Numbers>> rests;
  for (const Numbers& numbers : all) rests[numbers[axis]].insert(numbers);
  std::map<std::vector<std::string>, std::set<long>> by_rest;
  for (const auto& [number, rest] : rests) by_rest[fold_axes(rest, axis + 1, texts)].insert(number);
  std::vector<std::pair<std::set<long>, std::vector<std::string>>> ordered;
  for (const auto& [words, numbers] : by_rest) ordered.emplace_back(numbers, words);
  std::ranges::sort(ordered);
  std::vector<std::string> folded;
  for (const auto& [numbers, words] : ordered)
    for (const std::string& word : words)
      folded.push_back(texts[axis] + fold_numbers(numbers) + word);
  return folded;
}

}  // namespace

std::string fold_names(const std::vector<std::string>& names) {
  std::map<std::vector<std::string>, std::set<Numbers>> by_texts;
  for (const std::string& name : names) {
    const CutName parts = cut(name);
    by_texts[parts.texts].insert(parts.numbers);
  }
  std::string text;
  for (const auto& [texts, numbers] : by_texts)
    for (const std::string& word : fold_axes(numbers, 0, texts))
      text += (text.empty() ? "" : ",") + word;
  return text;
}

}  // namespace vindu
