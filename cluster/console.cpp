#include "cluster/console.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "core/error.h"

namespace vindu {
namespace {

/// So long a wall may take to be found; with keys, and many hosts, some seconds.
constexpr Duration kSearch = std::chrono::seconds(10);

/// A command on its way, until it is answered or the master has gone.
class Asking {
 public:
  Asking(Transport& transport, Participant self, const Request& request, Duration patience)
      : self_(std::move(self)),
        bus_(transport.join({self_, {Topic::command}, {Topic::answer, Topic::presence}})),
        patience_(patience),
        command_{.sender = self_.name,
                 .request = static_cast<std::uint64_t>(begin_.time_since_epoch().count()) | 1,
                 .verb = request.verb,
                 .argument = request.argument,
                 .clip = request.clip} {}

  /// Asks when it is time to, and waits for what comes.
  void turn() {
    if (const Time now = std::chrono::steady_clock::now(); now >= next_) {
      bus_->publish(command_);
      next_ = now + kAskAgain;
    }
    bus_->wait({Topic::answer, Topic::presence}, next_);
    for (const Presence& presence : bus_->take<Presence>())
      if (presence.who.role == Role::master) hear(presence);
    for (AnswerMessage& answer : bus_->take<AnswerMessage>())
      if (answer.sender == self_.name && answer.request == command_.request)
        answer_ = std::move(answer);
  }

  bool patient() const { return std::chrono::steady_clock::now() < limit(); }
  const std::optional<AnswerMessage>& answer() const { return answer_; }
  bool master_left() const { return master_left_; }

  /// Throws Error with why nobody answers.
  [[noreturn]] void give_up() const {
    if (other_) throw Error({version_complaint(self_, *other_), "the wall", ""});
    if (!master_)
      throw Error(
          {"no master is found", "the wall",
           "start one (vindu launch), or name the wall file that it was started with (--wall)"});
    throw Error(
        {"does not answer", "the master on " + master_->host,
         "look at its lines (vindu logs; of a wall on one machine, where vindu launch runs), or "
         "start it again; a wall with keys answers to them alone ([cluster] keys in the wall "
         "file)"});
  }

 private:
  void hear(const Presence& presence) {
    if (presence.change == PresenceChange::other_version)
      other_ = presence.who;
    else if (presence.change != PresenceChange::left)
      master_ = presence.who;
    else if (master_ == presence.who)
      master_left_ = true;
  }

  /// Who is found has longer to answer than there is to find him.
  Time limit() const { return begin_ + (master_ ? patience_ : std::min(patience_, kSearch)); }

  const Participant self_;
  const std::unique_ptr<Bus> bus_;
  const Time begin_ = std::chrono::steady_clock::now();
  const Duration patience_;
  const CommandMessage command_;
  Time next_ = begin_;
  std::optional<Participant> master_, other_;
  std::optional<AnswerMessage> answer_;
  bool master_left_ = false;  // the one that was found
};

void expect_short(const Request& request) {
  for (const std::string& text : {request.argument, request.clip})
    if (text.size() > kLongestArgument)
      throw Error({"is too long, " + std::to_string(text.size()) + " characters",
                   text.substr(0, 40) + "...",
                   "name it in " + std::to_string(kLongestArgument) + " at most"});
}

}  // namespace

AnswerMessage ask_wall(Transport& transport, const Participant& self, const Request& request,
                       Duration patience) {
  expect_short(request);
  Asking asking(transport, self, request, patience);
  while (!asking.answer() && asking.patient()) asking.turn();
  if (!asking.answer()) asking.give_up();
  return *asking.answer();
}

void stop_wall(Transport& transport, const Participant& self, Duration patience,
               Duration patience_of_end) {
  Asking asking(transport, self, {.verb = Verb::stop}, patience);
  while (!asking.master_left() && !asking.answer() && asking.patient()) asking.turn();
  if (asking.master_left()) return;
  if (!asking.answer()) asking.give_up();
  expect_done(*asking.answer());
  const Time limit = std::chrono::steady_clock::now() + patience_of_end;
  while (!asking.master_left() && std::chrono::steady_clock::now() < limit) asking.turn();
  if (!asking.master_left())
    throw Error({"was told to end and has not", "the master",
                 "see what it says; if it hangs, end it where it runs: pkill -KILL -f 'vindu "
                 "(launch|master)'"});
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
