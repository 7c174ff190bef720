// Writes good inputs of wire_fuzz into a folder: some of every topic, frame states, a participant.
#include <fstream>
#include <string>

#include "cluster/cdr.h"
#include "tests/cluster/random_messages.h"

int main(int count, char** words) {
  using namespace vindu;
  if (count != 2) return 2;
  Random random(1);
  const auto write = [&](const std::string& name, int which, const auto& bytes) {
    std::ofstream file(std::string(words[1]) + "/" + name, std::ios::binary);
    file.put(static_cast<char>(which));
    for (const auto byte : bytes) file.put(static_cast<char>(byte));
  };
  for (int i = 0; i < 4; ++i) {
    for (int topic = 0; topic < kTopics - 1; ++topic)
      write("topic-" + std::to_string(topic) + "-" + std::to_string(i), topic,
            to_cdr(testing::random_message(random, static_cast<Topic>(topic))));
    write("state-" + std::to_string(i), kTopics - 1, to_cdr(testing::random_state(random)));
  }
  write("participant", kTopics,
        std::string("role=tile name=tile-3-0 host=node7 version=0.1.0 protocol=1"));
}
