// Names folded as ClusterShell folds them.
#include "cluster/launch/node_set.h"

#include <gmock/gmock.h>

#include "core/wall.h"

namespace vindu {
namespace {

std::vector<std::string> all_tiles() {
  std::vector<std::string> names;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 7; ++column) names.push_back(tile_name(column, row));
  return names;
}

TEST(FoldNames, AWholeWallIsOneWord) { EXPECT_EQ(fold_names(all_tiles()), "tile-[0-6]-[0-3]"); }

TEST(FoldNames, AWallWithoutOneTileIsTwo) {
  std::vector<std::string> names = all_tiles();
  std::erase(names, "tile-5-0");
  EXPECT_EQ(fold_names(names), "tile-[0-4,6]-[0-3],tile-5-[1-3]");
}

TEST(FoldNames, OneNameStaysAsItIs) {
  EXPECT_EQ(fold_names({"tile-5-0"}), "tile-5-0");
  EXPECT_EQ(fold_names({"tile-5-0", "tile-5-0"}), "tile-5-0");
  EXPECT_EQ(fold_names({"master"}), "master");
  EXPECT_EQ(fold_names({}), "");
}

TEST(FoldNames, AColumnAndARowAreOneWord) {
  EXPECT_EQ(fold_names({"tile-2-0", "tile-2-1", "tile-2-3"}), "tile-2-[0-1,3]");
  EXPECT_EQ(fold_names({"tile-9-1", "tile-10-1", "tile-12-1"}), "tile-[9-10,12]-1");
}

TEST(FoldNames, NamesOfDifferentFormsStandSideBySide) {
  EXPECT_EQ(fold_names({"b1", "a2", "a1", "head", "a1x"}), "a[1-2],a1x,b1,head");
}

TEST(FoldNames, LeadingZerosAndLongNumbersAreLetters) {
  EXPECT_EQ(fold_names({"n01", "n02"}), "n01,n02");
  EXPECT_EQ(fold_names({"n99999999999999999999", "n1"}), "n1,n99999999999999999999");
  EXPECT_EQ(fold_names({"10.0.0.9", "10.0.0.10"}), "10.0.0.[9-10]");
}

}  // namespace
}  // namespace vindu
