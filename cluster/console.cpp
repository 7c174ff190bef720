#include "cluster/console.h"

#include <algorithm>

#include "core/error.h"

namespace vindu {
namespace {

/// So long a wall may take to be found; with keys, and many hosts, some seconds.
constexpr Duration kSearch = std::chrono::seconds(10);

[[noreturn]] void no_answer(const std::optional<Participant>& master,
                            const std::optional<Participant>& other, const Participant& self) {
  if (other) throw Error({version_complaint(self, *other), "the wall", ""});
  if (!master)
    throw Error(
        {"no master is found", "the wall",
         "start one (vindu launch), or name the wall file that it was started with (--wall)"});
  throw Error(
      {"does not answer", "the master on " + master->host,
       "look at its lines (vindu logs; of a wall on one machine, where vindu launch runs), or "
       "start "
       "it again; a wall with keys answers to them alone ([cluster] keys in the wall file)"});
}

}  // namespace

AnswerMessage ask_wall(Transport& transport, const Participant& self, const Request& request,
                       Duration patience) {
  for (const std::string& text : {request.argument, request.clip})
    if (text.size() > kLongestArgument)
      throw Error({"is too long, " + std::to_string(text.size()) + " characters",
                   text.substr(0, 40) + "...",
                   "name it in " + std::to_string(kLongestArgument) + " at most"});
  const auto bus = transport.join({self, {Topic::command}, {Topic::answer, Topic::presence}});
  const Time begin = std::chrono::steady_clock::now();
  const auto number = static_cast<std::uint64_t>(begin.time_since_epoch().count()) | 1;
  std::optional<Participant> master, other;
  const auto until = [&] { return begin + (master ? patience : std::min(patience, kSearch)); };
  for (Time next = begin; std::chrono::steady_clock::now() < until();) {
    if (std::chrono::steady_clock::now() >= next) {
      bus->publish(CommandMessage{.sender = self.name,
                                  .request = number,
                                  .verb = request.verb,
                                  .argument = request.argument,
                                  .clip = request.clip});
      next = std::chrono::steady_clock::now() + kAskAgain;
    }
    bus->wait({Topic::answer, Topic::presence}, std::min(next, until()));
    for (const Presence& presence : bus->take<Presence>())
      if (presence.who.role == Role::master)
        (presence.change == PresenceChange::other_version ? other : master) = presence.who;
    for (AnswerMessage& answer : bus->take<AnswerMessage>())
      if (answer.sender == self.name && answer.request == number) return answer;
  }
  no_answer(master, other, self);
}

void expect_done(const AnswerMessage& answer) {
  if (!answer.done) throw Error({answer.text, "", ""});
}

std::vector<CommandMessage> CommandDesk::take() {
  std::vector<CommandMessage> fresh;
  for (CommandMessage& command : bus_.take<CommandMessage>()) {
    if (last_.size() >= kMostSenders && !last_.contains(command.sender)) last_.clear();
    Last& last = last_[command.sender];
    if (last.request == command.request) {
      if (last.answer) bus_.publish(*last.answer);
      continue;
    }
    last = {command.request, std::nullopt};
    fresh.push_back(std::move(command));
  }
  return fresh;
}

void CommandDesk::answer(const CommandMessage& command, bool done, const std::string& text) {
  const AnswerMessage answer{.sender = command.sender,
                             .request = command.request,
                             .from = self_,
                             .done = done,
                             .text = text};
  if (const auto found = last_.find(command.sender);
      found != last_.end() && found->second.request == command.request)
    found->second.answer = answer;
  bus_.publish(answer);
}

}  // namespace vindu
