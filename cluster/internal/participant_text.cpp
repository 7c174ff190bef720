#include "cluster/internal/participant_text.h"

#include <algorithm>
#include <charconv>

#include "core/error.h"

namespace vindu::internal {
namespace {

constexpr std::size_t kLongestText = 1024;
constexpr std::size_t kLongestWord = 255;

bool is_word(std::string_view text) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("-_.:@+~").find(c) != std::string_view::npos;
  };
  return !text.empty() && text.size() <= kLongestWord && std::ranges::all_of(text, allowed);
}

std::optional<Role> role_from(std::string_view name) {
  for (const Role role : kRoles)
    if (name == name_of(role)) return role;
  return std::nullopt;
}

template <class Number>
std::optional<Number> whole_number(std::string_view text) {
  Number value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// What follows "key=" up to the next space; empty when it is not there or no word.
std::string_view word(std::string_view text, std::string_view key) {
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), part.size() + 1));
    if (part.starts_with(key) && part.size() > key.size() && part[key.size()] == '=')
      return is_word(part.substr(key.size() + 1)) ? part.substr(key.size() + 1) : "";
  }
  return {};
}

}  // namespace

std::string text_of(const Participant& participant) {
  std::string text = "role=" + std::string(name_of(participant.role));
  const auto add = [&text](const std::string& key, const std::string& value) {
    if (!is_word(value))
      throw Error({.what = "a participant's " + key + " is \"" + value + "\"",
                   .where = "cluster",
                   .remedy = "use 1 to 255 letters, digits and - _ . : @ + ~"});
    text += " " + key + "=" + value;
  };
  add("name", participant.name);
  add("host", participant.host);
  add("version", participant.version);
  add("protocol", std::to_string(participant.protocol));
  if (participant.epoch != 0) add("epoch", std::to_string(participant.epoch));
  if (!participant.wall.empty()) add("wall", participant.wall);
  return text;
}

std::optional<Participant> participant_from(std::string_view text) {
  if (text.size() > kLongestText) return std::nullopt;
  const auto role = role_from(word(text, "role"));
  const auto protocol = whole_number<int>(word(text, "protocol"));
  Participant participant{.name = std::string(word(text, "name")),
                          .host = std::string(word(text, "host")),
                          .version = std::string(word(text, "version")),
                          .epoch = whole_number<std::uint64_t>(word(text, "epoch")).value_or(0),
                          .wall = std::string(word(text, "wall"))};
  if (!role || !protocol || participant.name.empty() || participant.host.empty() ||
      participant.version.empty())
    return std::nullopt;
  participant.role = *role;
  participant.protocol = *protocol;
  return participant;
}

}  // namespace vindu::internal
