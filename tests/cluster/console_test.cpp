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

}  // namespace
}  // namespace vindu
