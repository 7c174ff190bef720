// Pictures in files and in memory: exact round trips, and calm where the bytes are rubbish.
#include "renderer/image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "core/error.h"
#include "tests/renderer_import/model_files.h"

namespace vindu {
namespace {

using test::TemporaryFolder;

Image gradient(int width_px, int height_px) {
  Image image = Image::filled(width_px, height_px, {0, 0, 0, 255});
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      image.at(x, y) = {static_cast<std::uint8_t>(x * 7), static_cast<std::uint8_t>(y * 5),
                        static_cast<std::uint8_t>(x ^ y), 255};
  return image;
}

std::vector<std::uint8_t> bytes_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A PNG's head: signature and IHDR (the checksum of IHDR is not looked at by stb_image).
std::vector<std::uint8_t> png_that_claims(std::uint32_t width_px, std::uint32_t height_px) {
  std::vector<std::uint8_t> png = test::two_pixel_png();
  for (int byte = 0; byte < 4; ++byte) {
    png[16 + byte] = static_cast<std::uint8_t>(width_px >> (24 - 8 * byte));
    png[20 + byte] = static_cast<std::uint8_t>(height_px >> (24 - 8 * byte));
  }
  return png;
}

TEST(Image, PngRoundTripKeepsEveryPixel) {
  const TemporaryFolder folder;
  const Image image = gradient(37, 19);

  write_png(image, folder.path("a.png"));

  EXPECT_EQ(read_png(folder.path("a.png")), image);
}

TEST(Image, WrittenPngIsOpaque) {
  const TemporaryFolder folder;
  const Image image = Image::filled(3, 2, {10, 20, 30, 40});

  write_png(image, folder.path("a.png"));

  EXPECT_EQ(read_png(folder.path("a.png")), Image::filled(3, 2, {10, 20, 30, 255}));
}

TEST(Image, BothDecodersAgree) {
  const TemporaryFolder folder;
  write_png(gradient(64, 3), folder.path("a.png"));

  const std::optional<Image> decoded = decode_image(bytes_of(folder.path("a.png")));

  ASSERT_TRUE(decoded);
  EXPECT_EQ(*decoded, read_png(folder.path("a.png")));
}

TEST(Image, WritingIntoAMissingFolderIsAnErrorThatNamesTheFile) {
  const TemporaryFolder folder;
  const std::string file = folder.path("missing/a.png");

  try {
    write_png(gradient(2, 2), file);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(file));
  }
}

TEST(Image, ReadingWhatIsNoPngIsAnError) {
  const TemporaryFolder folder;

  EXPECT_THROW(read_png(folder.path("missing.png")), Error);
  EXPECT_THROW(read_png(folder.write("text.png", "no picture")), Error);
  EXPECT_THROW(read_png(folder.write("empty.png", "")), Error);
}

TEST(Image, DecodesAlphaAndColour) {
  const std::optional<Image> image = decode_image(test::two_pixel_png());

  ASSERT_TRUE(image);
  EXPECT_EQ(image->width_px, 2);
  EXPECT_EQ(image->at(0, 0), (Rgba8{255, 0, 0, 255}));
  EXPECT_EQ(image->at(1, 0), (Rgba8{0, 255, 0, 128}));
}

TEST(Image, DecodesJpegAndTga) {
  EXPECT_TRUE(decode_image(bytes_of(test::test_model("OBJ/SpiderTex.jpg"))));
  EXPECT_TRUE(decode_image(bytes_of(test::test_model("Collada/duckCM.tga"))));
}

TEST(Image, RandomBytesDecodeToNothing) {
  std::mt19937 random(1);
  for (int size = 0; size < 200; ++size) {
    std::vector<std::uint8_t> bytes(size);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    EXPECT_FALSE(decode_image(bytes)) << size;
  }
}

TEST(Image, EveryCutOffPngDecodesToNothing) {
  const std::vector<std::uint8_t> png = test::two_pixel_png();
  const std::size_t data_end = png.size() - 16;  // before the last bytes of IDAT
  for (std::size_t size = 0; size < data_end; ++size)
    EXPECT_FALSE(decode_image(std::span(png).first(size))) << size;
}

TEST(Image, FlippedBytesNeverCrashADecoder) {
  std::mt19937 random(2);
  const std::vector<std::uint8_t> whole = bytes_of(test::test_model("OBJ/SpiderTex.jpg"));
  for (int round = 0; round < 20; ++round) {
    std::vector<std::uint8_t> bytes = whole;
    for (int flip = 0; flip < 10; ++flip)
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    const std::optional<Image> image = decode_image(bytes);
    if (!image) continue;
    EXPECT_EQ(image->pixels.size(), std::size_t(image->width_px) * image->height_px);
  }
}

TEST(Image, ASmallFileThatClaimsToBeHugeDecodesToNothing) {
  EXPECT_FALSE(decode_image(png_that_claims(65535, 65535)));
  EXPECT_FALSE(decode_image(png_that_claims(8000, 8000)));
}

TEST(Image, DecodesNothingLargerThanAllowed) {
  EXPECT_TRUE(decode_image(test::two_pixel_png(), 2));
  EXPECT_FALSE(decode_image(test::two_pixel_png(), 1));
}

TEST(Image, PasteCutsWhatFallsOutside) {
  Image whole = Image::filled(4, 4, {0, 0, 0, 255});
  const Image part = gradient(3, 3);

  paste(part, 2, -1, whole);

  EXPECT_EQ(whole.at(2, 0), part.at(0, 1));
  EXPECT_EQ(whole.at(3, 1), part.at(1, 2));
  EXPECT_EQ(whole.at(2, 2), (Rgba8{0, 0, 0, 255}));
  EXPECT_EQ(whole.at(1, 0), (Rgba8{0, 0, 0, 255}));
}

TEST(Image, PasteWhollyOutsideChangesNothing) {
  Image whole = Image::filled(4, 4, {0, 0, 0, 255});
  const Image before = whole;

  for (const auto& [x, y] : {std::pair(4, 0), std::pair(-3, 0), std::pair(0, 4), std::pair(0, -3)})
    paste(gradient(3, 3), x, y, whole);

  EXPECT_EQ(whole, before);
}

}  // namespace
}  // namespace vindu
