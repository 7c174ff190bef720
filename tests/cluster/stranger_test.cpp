// Somebody on the network who speaks DDS and the right types, but says what cannot be: nothing of
// it becomes a message.
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "cluster/dds.h"
#include "cluster/internal/dds_entity.h"
#include "tests/cluster/waiting.h"
#include "wire.h"

namespace vindu {
namespace {

using internal::DdsEntity;
using testing::in_ms;

vindu_wire_Frame good_frame() {
  vindu_wire_Frame frame{};
  frame.epoch = 1;
  frame.newest.number = 1;
  frame.newest.wall_from_scene.rotation[3] = 1;
  frame.newest.scale = 1;
  return frame;
}

class Stranger : public ::testing::Test {
 protected:
  Stranger() {
    const dds_qos_t* const defaults = nullptr;  // best effort
    dds_domainid_t id = 200;
    domain_ = {dds_create_domain(id, dds_configuration(settings_, "").c_str()), "a domain"};
    participant_ = {dds_create_participant(id, nullptr, nullptr), "a participant"};
    const std::string name = "v" + std::to_string(kProtocolVersion) + "/frame";
    const dds_entity_t topic = dds_create_topic(participant_.get(), &vindu_wire_Frame_desc,
                                                name.c_str(), defaults, nullptr);
    writer_ = dds_create_writer(participant_.get(), topic, defaults, nullptr);
  }

  /// Writes this and then a good frame of number 1, again and again, until something is heard.
  std::vector<FrameMessage> heard_of(const vindu_wire_Frame& frame) {
    const vindu_wire_Frame good = good_frame();
    std::vector<FrameMessage> heard;
    while (heard.empty()) {
      dds_write(writer_, &frame);
      tile_->wait({Topic::frame}, in_ms(20));
      heard = tile_->take<FrameMessage>();
      if (!heard.empty()) break;
      dds_write(writer_, &good);
      tile_->wait({Topic::frame}, in_ms(20));
      heard = tile_->take<FrameMessage>();
    }
    return heard;
  }

  DdsSettings settings_{.name = "stranger" + std::to_string(getpid())};
  DdsTransport transport_{settings_};
  std::unique_ptr<Bus> tile_ = transport_.join(
      {{Role::tile, "tile-0-0", "here", "0.1"}, {}, {Topic::frame, Topic::presence}});
  DdsEntity domain_;
  DdsEntity participant_;
  dds_entity_t writer_ = 0;
};

TEST_F(Stranger, IsHeardWhereHeSpeaksSense) {
  vindu_wire_Frame frame = good_frame();
  frame.newest.number = 7;
  while (heard_of(frame)[0].newest.number != 7) {
  }
}

TEST_F(Stranger, IsNotHeardWithNumbersThatAreNone) {
  std::vector<vindu_wire_Frame> frames(6, good_frame());
  for (vindu_wire_Frame& frame : frames) frame.newest.number = 7;
  frames[0].newest.eye_in_wall_m[1] = std::nan("");
  frames[1].newest.mode = 200;
  frames[2].epoch = 0;
  frames[3].released = 8;
  frames[4].newest.scale = 0;
  frames[5].sent_time_ns = 1ll << 62;
  for (const vindu_wire_Frame& frame : frames)
    for (int i = 0; i < 10; ++i)
      for (const FrameMessage& heard : heard_of(frame)) EXPECT_EQ(heard.newest.number, 1u);
}

TEST_F(Stranger, WithoutAVindusNameIsNobody) {
  heard_of(good_frame());
  EXPECT_THAT(tile_->take(Topic::presence), ::testing::IsEmpty());
}

}  // namespace
}  // namespace vindu
