#include "talus/io/image_reader.h"

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>

#include "io/scratch.h"
#include "talus/io/png.h"

namespace talus {
namespace {

using test::Scratch;

Image gradient(int channels) {
  Image image{.width = 40, .height = 30, .channels = channels};
  for (int i = 0; i < 40 * 30 * channels; ++i)
    image.pixels.push_back(static_cast<std::uint8_t>(i / 9));
  return image;
}

TEST(ReadImage, GivesBackWhatAPngHolds) {
  const Scratch scratch;
  for (const int channels : {1, 3, 4}) {
    const Image image = gradient(channels);
    write_png(scratch.path("a.png"), image);
    const Image read = read_image(scratch.path("a.png"));
    EXPECT_EQ(read.width, 40);
    EXPECT_EQ(read.height, 30);
    EXPECT_EQ(read.channels, channels);
    EXPECT_EQ(read.pixels, image.pixels);
  }
}

// A PNG of a format that Talus does not write itself.
void write_with_libpng(const std::filesystem::path& path, png_uint_32 format, const void* pixels,
                       const void* palette, int palette_size) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = 2;
  png.height = 1;
  png.format = format;
  png.colormap_entries = static_cast<png_uint_32>(palette_size);
  ASSERT_TRUE(png_image_write_to_file(&png, path.c_str(), 0, pixels, 0, palette)) << png.message;
}

TEST(ReadImage, RoundsSixteenBits) {
  const Scratch scratch;
  const std::uint16_t pixels[] = {128, 65535};
  write_with_libpng(scratch.path("a.png"), PNG_FORMAT_LINEAR_Y, pixels, nullptr, 0);
  EXPECT_EQ(read_image(scratch.path("a.png")).pixels, (std::vector<std::uint8_t>{0, 255}));
}

TEST(ReadImage, WritesPalettesOut) {
  const Scratch scratch;
  const std::uint8_t pixels[] = {1, 0}, palette[] = {10, 20, 30, 40, 50, 60};
  write_with_libpng(scratch.path("a.png"), PNG_FORMAT_RGB_COLORMAP, pixels, palette, 2);
  const Image read = read_image(scratch.path("a.png"));
  EXPECT_EQ(read.channels, 4);
  EXPECT_EQ(read.pixels, (std::vector<std::uint8_t>{40, 50, 60, 255, 10, 20, 30, 255}));
}

// The same picture as JPEG, made by GDAL.
std::string jpeg_of(const Scratch& scratch, const Image& image) {
  write_png(scratch.path("a.png"), image);
  GDALAllRegister();
  const GDALDatasetUniquePtr png(GDALDataset::Open(scratch.path("a.png").c_str()));
  GDALDriver* jpeg = GetGDALDriverManager()->GetDriverByName("JPEG");
  GDALClose(
      jpeg->CreateCopy(scratch.path("a.jpg").c_str(), png.get(), false, nullptr, nullptr, nullptr));
  return test::bytes_of(scratch.path("a.jpg"));
}

TEST(ReadImage, ReadsJpegNearly) {
  const Scratch scratch;
  const Image image = gradient(1);
  scratch.file("b.jpg", jpeg_of(scratch, image));
  const Image read = read_image(scratch.path("b.jpg"));
  ASSERT_EQ(read.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    EXPECT_LE(std::abs(read.pixels[i] - image.pixels[i]), 12) << i;
}

TEST(ReadImage, RefusesEveryTruncation) {
  const Scratch scratch;
  const std::string jpeg = jpeg_of(scratch, gradient(3));
  const std::string png = test::bytes_of(scratch.path("a.png"));
  for (const auto& [name, bytes] : {std::pair{"cut.jpg", jpeg}, {"cut.png", png}})
    for (std::size_t size = 0; size + 16 < bytes.size(); size += 1 + bytes.size() / 100) {
      const auto path = scratch.file(name, bytes.substr(0, size));
      const test::Refusal refusal = test::refusal_of([&] { read_image(path); });
      EXPECT_EQ(refusal.kind, ErrorKind::input) << refusal.line;
      EXPECT_EQ(refusal.line.find('\n'), std::string::npos) << refusal.line;
    }
}

TEST(ReadImage, NamesWhatIsMissing) {
  EXPECT_EQ(test::refusal_of([] { read_image("/no/such.png"); }).line,
            "/no/such.png: cannot read: no such file");
}

}  // namespace
}  // namespace talus
