// Long copies in short pieces: everything is moved once, in order, and no piece is longer than it
// was asked to be.
#include "renderer/upload.h"

#include <gmock/gmock.h>

#include <utility>
#include <vector>

namespace vindu {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Moved {
  char list = 0;
  std::size_t first = 0, count = 0;
  bool operator==(const Moved&) const = default;
};

/// Copies that only note what is moved.
class Moves {
 public:
  Upload::Copy list(char name, std::size_t items, std::size_t item_bytes) {
    return {items, item_bytes, [this, name](std::size_t first, std::size_t count) {
              moved_.push_back({name, first, count});
            }};
  }
  std::vector<Moved> take() { return std::exchange(moved_, {}); }

 private:
  std::vector<Moved> moved_;
};

TEST(Upload, MovesAsManyItemsAsThePieceHolds) {
  Moves moves;
  Upload upload;
  upload.add(moves.list('a', 10, 4));
  upload.advance(16);
  EXPECT_THAT(moves.take(), ElementsAre(Moved{'a', 0, 4}));
  upload.advance(19);
  EXPECT_THAT(moves.take(), ElementsAre(Moved{'a', 4, 4}));
  EXPECT_FALSE(upload.done());
  upload.advance(16);
  EXPECT_THAT(moves.take(), ElementsAre(Moved{'a', 8, 2}));
  EXPECT_TRUE(upload.done());
}

TEST(Upload, FillsAPieceFromSeveralLists) {
  Moves moves;
  Upload upload;
  upload.add(moves.list('a', 3, 4));
  upload.add(moves.list('b', 2, 2));
  upload.add(moves.list('c', 5, 3));
  upload.advance(22);
  EXPECT_THAT(moves.take(), ElementsAre(Moved{'a', 0, 3}, Moved{'b', 0, 2}, Moved{'c', 0, 2}));
  upload.advance(1000);
  EXPECT_THAT(moves.take(), ElementsAre(Moved{'c', 2, 3}));
  EXPECT_TRUE(upload.done());
}

TEST(Upload, MovesAnItemThatIsLongerThanThePieceAlone) {
  Moves moves;
  Upload upload;
  upload.add(moves.list('a', 1, 2));
  upload.add(moves.list('b', 2, 100));
  upload.advance(10);
  EXPECT_THAT(moves.take(), ElementsAre(Moved{'a', 0, 1}));
  upload.advance(10);
  EXPECT_THAT(moves.take(), ElementsAre(Moved{'b', 0, 1}));
}

TEST(Upload, HasNothingToDoForEmptyLists) {
  Moves moves;
  Upload upload;
  upload.add(moves.list('a', 0, 4));
  EXPECT_TRUE(upload.done());
  upload.advance(10);
  EXPECT_THAT(moves.take(), IsEmpty());
}

}  // namespace
}  // namespace vindu
