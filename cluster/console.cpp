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
/// So often a page that does not change is said again.
constexpr Duration kPageAgain = std::chrono::milliseconds(500);
/// So long a console that takes its page away waits for the answer.
constexpr Duration kPageEnd = std::chrono::seconds(2);

constexpr Topics kAsks = {Topic::command}, kHearsOf = {Topic::answer, Topic::presence};

/// Larger than that of any command before of the same process.
std::uint64_t new_request() {
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count()) |
         1;
}

CommandMessage command_of(const Participant& self, const Request& request) {
  return {.sender = self.name,
          .request = new_request(),
          .verb = request.verb,
          .argument = request.argument,
          .clip = request.clip,
          .touch_page = request.touch_page};
}

/// A command on its way, until it is answered or the master has gone.
class Asking {
 public:
  /// The bus must outlive it. `master`: one that is known of before.
  Asking(Bus& bus, Participant self, const Request& request, Duration patience,
         std::optional<Participant> master = std::nullopt)
      : self_(std::move(self)),
        bus_(bus),
        patience_(patience),
        command_(command_of(self_, request)),
        master_(std::move(master)) {}

  /// Asks when it is time to, and waits for what comes.
  void turn() {
    if (const Time now = std::chrono::steady_clock::now(); now >= next_) {
      bus_.publish(command_);
      next_ = now + kAskAgain;
    }
    bus_.wait(kHearsOf, next_);
    for (const Presence& presence : bus_.take<Presence>())
      if (presence.who.role == Role::master) hear(presence);
    for (AnswerMessage& answer : bus_.take<AnswerMessage>())
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
  Bus& bus_;
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
  const auto bus = transport.join({self, kAsks, kHearsOf});
  Asking asking(*bus, self, request, patience);
  while (!asking.answer() && asking.patient()) asking.turn();
  if (!asking.answer()) asking.give_up();
  return *asking.answer();
}

void stop_wall(Transport& transport, const Participant& self, Duration patience,
               Duration patience_of_end) {
  const auto bus = transport.join({self, kAsks, kHearsOf});
  Asking asking(*bus, self, {.verb = Verb::stop}, patience);
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

WallPage::WallPage(Transport& transport, Participant self)
    : self_(std::move(self)), bus_(transport.join({self_, kAsks, kHearsOf})) {}

WallPage::~WallPage() {
  if (!shown_) return;
  Asking asking(*bus_, self_, {.verb = Verb::touch_page}, kPageEnd);
  while (!asking.answer() && !asking.master_left() && asking.patient()) asking.turn();
}

std::optional<Participant> WallPage::find_master(Duration search) {
  const Time limit = std::chrono::steady_clock::now() + search;
  while (std::chrono::steady_clock::now() < limit) {
    bus_->wait({Topic::presence}, limit);
    for (const Presence& presence : bus_->take<Presence>()) {
      if (presence.who.role != Role::master || presence.change == PresenceChange::left) continue;
      if (presence.change == PresenceChange::other_version)
        throw Error({version_complaint(self_, presence.who), "the wall", ""});
      return presence.who;
    }
  }
  return std::nullopt;
}

bool WallPage::begin(const TouchPage& page, Duration search, Duration patience) {
  const std::optional<Participant> master = find_master(search);
  if (!master) return false;
  if (!master->wall.empty() && !self_.wall.empty() && master->wall != self_.wall)
    throw Error({"has another wall than the wall file here", "the master on " + master->host,
                 "name the wall file that it was started with (--wall)"});
  Asking asking(*bus_, self_, {.verb = Verb::touch_page, .touch_page = page}, patience, master);
  shown_ = true;
  while (!asking.answer() && asking.patient()) asking.turn();
  if (!asking.answer()) asking.give_up();
  shown_ = asking.answer()->done;
  expect_done(*asking.answer());
  page_ = page;
  said_ = std::chrono::steady_clock::now();
  return true;
}

void WallPage::show(const TouchPage& page) {
  const Time now = std::chrono::steady_clock::now();
  if (!shown_ || (page == page_ && now - said_ < kPageAgain)) return;
  bus_->take<AnswerMessage>();  // nobody waits for them
  bus_->take<Presence>();
  bus_->publish(command_of(self_, {.verb = Verb::touch_page, .touch_page = page}));
  page_ = page;
  said_ = now;
}

void PageOfConsole::hear(const CommandMessage& command, Time now) {
  if (at(now) && command.sender != console_) {
    if (!command.touch_page) return;
    throw Error({"shows the points of " + console_, "the wall", "end that calibration first"});
  }
  page_ = command.touch_page;
  console_ = command.sender;
  said_ = now;
}

const std::optional<TouchPage>& PageOfConsole::at(Time now) {
  if (now - said_ > kPageLease) page_.reset();
  return page_;
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
