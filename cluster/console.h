// Commands to a running wall and their answers. Both ends: a console repeats its command until it
// is answered, since the first may fall before the two know each other; the desk, at the master,
// obeys each command once.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cluster/bus.h"

namespace vindu {

/// So often a console repeats its command until it is answered.
constexpr Duration kAskAgain = std::chrono::milliseconds(250);
/// So long a wall shows a page of points that is not said again: its console was killed.
constexpr Duration kPageLease = std::chrono::seconds(3);

/// What a console asks for.
struct Request {
  Verb verb = Verb::show;
  std::string argument{};
  std::string clip{};                     ///< as CommandMessage's
  std::optional<TouchPage> touch_page{};  ///< the same
};

/// Asks as `self`, a name that no other console has. Returns the wall's answer, which may be a
/// refusal. Throws Error where no master is found (within ten seconds at most) or none answers in
/// time, and says which.
AnswerMessage ask_wall(Transport& transport, const Participant& self, const Request& request,
                       Duration patience);

/// Asks the wall to stop, and returns when its master has gone, whoever else asked for that. Throws
/// Error as ask_wall does, and where it does not go in time after its answer: it may be reading
/// a model.
void stop_wall(Transport& transport, const Participant& self, Duration patience,
               Duration patience_of_end = std::chrono::seconds(10));

/// Throws Error with what the wall said where it did not do it.
void expect_done(const AnswerMessage& answer);

/// A page of points to be touched, on a running wall. At its end, or kPageLease after its process
/// was killed, the wall shows again what it showed before. Bound to one thread.
class WallPage {
 public:
  /// `self`: a name that no other console has. The transport must outlive it.
  WallPage(Transport& transport, Participant self);
  ~WallPage();
  WallPage(const WallPage&) = delete;
  WallPage& operator=(const WallPage&) = delete;

  /// False where no master is found within `search`. Throws Error where it has another version or
  /// another wall, does not answer within `patience`, or refuses.
  bool begin(const TouchPage& page, Duration search, Duration patience);
  /// Another page, or, within every second, the same again.
  void show(const TouchPage& page);

 private:
  std::optional<Participant> find_master(Duration search);

  Participant self_;
  std::unique_ptr<Bus> bus_;
  TouchPage page_;
  Time said_{};
  bool shown_ = false;
};

/// The page that a console keeps on the wall, as the master knows it.
class PageOfConsole {
 public:
  /// Of Verb::touch_page. Throws Error where another console's is shown.
  void hear(const CommandMessage& command, Time now);
  /// Empty: none, or it was not said again for too long.
  const std::optional<TouchPage>& at(Time now);

 private:
  std::optional<TouchPage> page_;
  std::string console_;
  Time said_{};
};

/// Commands that wait for an answer. The bus, which publishes answers and hears commands, must
/// outlive it.
class CommandDesk {
 public:
  /// `self`: who answers.
  CommandDesk(Bus& bus, std::string self) : bus_(bus), self_(std::move(self)) {}

  /// New ones, each once; a repeated one is answered as before, or in time.
  std::vector<CommandMessage> take();
  /// `text`: why not, where it is not done.
  void answer(const CommandMessage& command, bool done, const std::string& text = "");

 private:
  static constexpr std::size_t kMostSenders = 64;
  struct Last {
    std::uint64_t request = 0;
    std::optional<AnswerMessage> answer{};
  };

  Bus& bus_;
  std::string self_;
  std::map<std::string, Last> last_;  // by sender; one command at a time
};

}  // namespace vindu
