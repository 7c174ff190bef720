// Consoles and the master's desk, within one process.
#include "cluster/console.h"

#include <gmock/gmock.h>

#include <atomic>
#include <thread>

#include "cluster/in_process.h"
#include "core/error.h"
#include "tests/cluster/waiting.h"

namespace vindu {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::in_ms;
using ::testing::SizeIs;

Participant console(const std::string& name) {
  return {.role = Role::console, .name = name, .host = "here", .version = "1"};
}

class Consoles : public ::testing::Test {
 protected:
  std::unique_ptr<Bus> join_master(int protocol = kProtocolVersion) {
    return transport_.join({{.role = Role::master,
                             .name = "master",
                             .host = "head",
                             .version = "1",
                             .protocol = protocol},
                            {Topic::answer},
                            {Topic::command}});
  }
  std::string complaint() {
    try {
      ask_wall(transport_, console("c"), {Verb::stop, ""}, 50ms);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  InProcessTransport transport_;
};

TEST_F(Consoles, AreAnsweredOnceThoughTheyAskAgainAndAgain) {
  const auto bus = join_master();
  CommandDesk desk(*bus, "master");
  std::vector<CommandMessage> obeyed;
  std::jthread master([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      bus->wait({Topic::command}, in_ms(10));
      for (const CommandMessage& command : desk.take()) obeyed.push_back(command);
      if (obeyed.empty() || obeyed.back().request == 0) continue;
      std::this_thread::sleep_for(700ms);  // the console repeats its command meanwhile
      desk.take();
      desk.answer(obeyed.back(), false, "no such model");
      return;
    }
  });

  const AnswerMessage answer =
      ask_wall(transport_, console("c"), {Verb::show, "a b.glb; rm -rf ~"}, 60s);
  master.join();

  ASSERT_THAT(obeyed, SizeIs(1));
  EXPECT_EQ(obeyed[0].argument, "a b.glb; rm -rf ~");
  EXPECT_FALSE(answer.done);
  EXPECT_THROW(expect_done(answer), Error);
}

TEST_F(Consoles, SayThatThereIsNoMaster) {
  EXPECT_THAT(complaint(), AllOf(HasSubstr("no master is found"), HasSubstr("vindu launch")));
}

TEST_F(Consoles, SayThatTheMasterDoesNotAnswer) {
  const auto bus = join_master();
  EXPECT_THAT(complaint(), HasSubstr("the master on head: does not answer"));
}

TEST_F(Consoles, SayThatTheMasterIsOfAnotherVersion) {
  const auto bus = join_master(kProtocolVersion + 1);
  EXPECT_THAT(complaint(), HasSubstr("speaks protocol"));
}

TEST_F(Consoles, ThatStopAWallWaitUntilItsMasterHasGone) {
  auto bus = join_master();
  CommandDesk desk(*bus, "master");
  std::atomic<bool> gone = false;
  std::jthread master([&] {
    std::vector<CommandMessage> asked;
    while (asked.empty()) {
      bus->wait({Topic::command}, in_ms(10));
      asked = desk.take();
    }
    desk.answer(asked.front(), true);
    std::this_thread::sleep_for(300ms);
    gone = true;
    bus.reset();
  });
  stop_wall(transport_, console("c"), 60s);
  EXPECT_TRUE(gone);
}

TEST_F(Consoles, NeedNoAnswerOfAMasterThatAnotherOneStopped) {
  auto bus = join_master();
  std::jthread master([&] {
    std::this_thread::sleep_for(300ms);
    bus.reset();
  });
  EXPECT_NO_THROW(stop_wall(transport_, console("c"), 60s));
}

TEST_F(Consoles, SayThatAMasterDoesNotEnd) {
  const auto bus = join_master();
  CommandDesk desk(*bus, "master");
  std::jthread master([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      bus->wait({Topic::command}, in_ms(10));
      for (const CommandMessage& command : desk.take()) desk.answer(command, true);
    }
  });
  try {
    stop_wall(transport_, console("c"), 60s, 50ms);
    FAIL() << "it says that it has ended";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("was told to end and has not"));
  }
}

TEST_F(Consoles, TheDeskGivesTheSameAnswerToARepeatedCommand) {
  const auto bus = join_master();
  const auto asking = transport_.join({console("c"), {Topic::command}, {Topic::answer}});
  CommandDesk desk(*bus, "master");
  const CommandMessage command{.sender = "c", .request = 5, .verb = Verb::mode};
  asking->publish(command);
  ASSERT_THAT(desk.take(), SizeIs(1));
  desk.answer(command, true);
  asking->publish(command);
  EXPECT_THAT(desk.take(), SizeIs(0));
  EXPECT_THAT(asking->take<AnswerMessage>(), SizeIs(2));
}

TEST_F(Consoles, ManyOfThemTakeNoMemoryOfTheDesk) {
  const auto bus = join_master();
  const auto asking = transport_.join({console("c"), {Topic::command}, {Topic::answer}});
  CommandDesk desk(*bus, "master");
  for (int i = 0; i < 1000; ++i) {
    asking->publish(CommandMessage{.sender = std::to_string(i), .request = 1});
    EXPECT_THAT(desk.take(), SizeIs(1));
  }
}

TouchPage page_of(double held) {
  return {.points = {{{1, 2, 0}, "tile-0-0"}, {{3, 2, 0}, "tile-1-0"}}, .held = held};
}

CommandMessage page_command(const std::string& sender, const std::optional<TouchPage>& page) {
  return {.sender = sender, .request = 1, .verb = Verb::touch_page, .touch_page = page};
}

const Time kBegin{1000s};

TEST(PageOfConsole, IsShownUntilItsConsoleTakesItAway) {
  PageOfConsole page;
  EXPECT_FALSE(page.at(kBegin));
  page.hear(page_command("c", page_of(0)), kBegin);
  EXPECT_EQ(page.at(kBegin), page_of(0));
  page.hear(page_command("c", page_of(0.5)), kBegin + 1s);
  EXPECT_EQ(page.at(kBegin + 1s), page_of(0.5));
  page.hear(page_command("c", std::nullopt), kBegin + 2s);
  EXPECT_FALSE(page.at(kBegin + 2s));
}

TEST(PageOfConsole, OfAConsoleThatWasKilledEndsByItself) {
  PageOfConsole page;
  page.hear(page_command("c", page_of(0)), kBegin);
  page.hear(page_command("c", page_of(0)), kBegin + kPageLease);
  EXPECT_TRUE(page.at(kBegin + 2 * kPageLease)) << "it was said again";
  EXPECT_FALSE(page.at(kBegin + 2 * kPageLease + 1ns));
}

TEST(PageOfConsole, IsNotTakenOverByAnotherConsole) {
  PageOfConsole page;
  page.hear(page_command("c", page_of(0)), kBegin);
  EXPECT_THROW(page.hear(page_command("d", page_of(1)), kBegin + 1s), Error);
  page.hear(page_command("d", std::nullopt), kBegin + 1s);
  EXPECT_EQ(page.at(kBegin + 1s), page_of(0));
  page.hear(page_command("d", page_of(1)), kBegin + 2 * kPageLease);
  EXPECT_EQ(page.at(kBegin + 2 * kPageLease), page_of(1));
}

class WallPages : public Consoles {
 protected:
  /// A master that does as it is told, until its scope ends.
  std::jthread start_master() {
    return std::jthread(
        [this, bus = std::shared_ptr<Bus>(join_master())](const std::stop_token& stop) {
          CommandDesk desk(*bus, "master");
          while (!stop.stop_requested()) {
            bus->wait({Topic::command}, in_ms(10));
            for (const CommandMessage& command : desk.take()) {
              page_.hear(command, std::chrono::steady_clock::now());
              pages_.push_back(command.touch_page);
              desk.answer(command, true);
            }
          }
        });
  }

  PageOfConsole page_;
  std::vector<std::optional<TouchPage>> pages_;  // that the master was told
};

TEST_F(WallPages, GoToTheMasterAndAreTakenAwayAtTheEnd) {
  std::jthread master = start_master();
  {
    WallPage page(transport_, console("c"));
    ASSERT_TRUE(page.begin(page_of(0), 60s, 60s));
    page.show(page_of(0));  // nothing is said: it is the same, and it is no time yet
    page.show(page_of(0.5));
  }
  master.request_stop();
  master.join();
  EXPECT_THAT(pages_, ::testing::ElementsAre(page_of(0), page_of(0.5), std::nullopt));
}

TEST_F(WallPages, AreSaidAgainBeforeTheMasterForgetsThem) {
  std::jthread master = start_master();
  {
    WallPage page(transport_, console("c"));
    ASSERT_TRUE(page.begin(page_of(0), 60s, 60s));
    const Time end = std::chrono::steady_clock::now() + kPageLease / 2;
    while (std::chrono::steady_clock::now() < end) {
      page.show(page_of(0));
      std::this_thread::sleep_for(10ms);
    }
  }
  master.request_stop();
  master.join();
  EXPECT_GT(pages_.size(), 2u);
}

TEST_F(WallPages, FindNoMasterWhereThereIsNone) {
  WallPage page(transport_, console("c"));
  EXPECT_FALSE(page.begin(page_of(0), 20ms, 60s));
}

TEST_F(WallPages, AreNotShownByAMasterOfAnotherVersionOrWall) {
  const auto complaint = [this](const Participant& self) -> std::string {
    try {
      WallPage(transport_, self).begin(page_of(0), 60s, 50ms);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  {
    const auto newer = join_master(kProtocolVersion + 1);
    EXPECT_THAT(complaint(console("c")), HasSubstr("speaks protocol"));
  }
  const auto bus = transport_.join(
      {{.role = Role::master, .name = "master", .host = "head", .version = "1", .wall = "A"},
       {Topic::answer},
       {Topic::command}});
  Participant self = console("c");
  self.wall = "B";
  EXPECT_THAT(complaint(self), HasSubstr("has another wall than the wall file here"));
  EXPECT_TRUE(bus->take<CommandMessage>().empty()) << "it was asked all the same";
  self.wall = "A";
  EXPECT_THAT(complaint(self), HasSubstr("does not answer"));
}

}  // namespace
}  // namespace vindu
