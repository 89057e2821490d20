#include "talus/io/image_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "talus/base/error.h"
#include "talus/io/gdal_session.h"
#include "talus/io/read_file.h"

namespace talus {
namespace {

constexpr std::int64_t kPixelsMax = std::int64_t{1} << 28;

// What a stored number means in 255ths, by its bits: 1 to 16.
std::vector<std::uint8_t> levels(int bits) {
  const std::uint32_t most = (1u << bits) - 1;
  std::vector<std::uint8_t> table(std::size_t{1} << 16, 255);
  for (std::uint32_t value = 0; value <= most; ++value)
    table[value] = static_cast<std::uint8_t>((value * 255 + most / 2) / most);
  return table;
}

// Colors of a palette; those it does not have are black.
std::vector<std::array<std::uint8_t, 4>> colors_of(const GDALColorTable& table) {
  std::vector<std::array<std::uint8_t, 4>> colors(std::size_t{1} << 16);
  const int count = std::min(table.GetColorEntryCount(), 1 << 16);
  for (int i = 0; i < count; ++i) {
    GDALColorEntry entry{};
    table.GetColorEntryAsRGB(i, &entry);
    colors[static_cast<std::size_t>(i)] = {
        static_cast<std::uint8_t>(entry.c1), static_cast<std::uint8_t>(entry.c2),
        static_cast<std::uint8_t>(entry.c3), static_cast<std::uint8_t>(entry.c4)};
  }
  return colors;
}

int bits_of(GDALRasterBand& band) {
  if (const char* bits = band.GetMetadataItem("NBITS", "IMAGE_STRUCTURE"))
    return std::clamp(std::atoi(bits), 1, 16);
  return band.GetRasterDataType() == GDT_Byte ? 8 : 16;
}

}  // namespace

Image read_image(const std::filesystem::path& path, const CheckImageSize& check) {
  check_readable_file(path);
  GdalSession session;
  const auto refuse = [&](std::string_view what) {
    const std::string& why = session.complaint();
    return input_error(
        fmt::format("{}: {}{}{}", path.string(), what, why.empty() ? "" : ": ", why));
  };
  const GDALDatasetUniquePtr dataset = session.open(path);
  if (!dataset) throw refuse("no picture that can be read");
  const int width = dataset->GetRasterXSize(), height = dataset->GetRasterYSize();
  const int bands = dataset->GetRasterCount();
  if (bands < 1 || bands > 4)
    throw refuse(fmt::format("a picture has 1 to 4 channels, not {}", bands));
  if (std::int64_t{width} * height > kPixelsMax)
    throw refuse(fmt::format("{} x {} pixels are more than {}", width, height, kPixelsMax));
  for (int b = 1; b <= bands; ++b)
    if (const GDALDataType type = dataset->GetRasterBand(b)->GetRasterDataType();
        type != GDT_Byte && type != GDT_UInt16)
      throw refuse(
          fmt::format("a picture has 8 or 16 bits a channel, not {}", GDALGetDataTypeName(type)));
  if (check) check(width, height);

  const GDALColorTable* palette = bands == 1 ? dataset->GetRasterBand(1)->GetColorTable() : nullptr;
  const auto colors = palette ? colors_of(*palette) : std::vector<std::array<std::uint8_t, 4>>();
  const std::vector<std::uint8_t> level = levels(bits_of(*dataset->GetRasterBand(1)));
  Image image{.width = width, .height = height, .channels = palette ? 4 : bands == 2 ? 1 : bands};
  const auto channels = static_cast<std::size_t>(image.channels);
  image.pixels.resize(channels * static_cast<std::size_t>(width) *
                      static_cast<std::size_t>(height));
  std::vector<std::uint16_t> row(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    std::uint8_t* out = image.pixels.data() + static_cast<std::size_t>(y) * row.size() * channels;
    for (std::size_t c = 0; c < (palette ? 1 : channels); ++c) {
      GDALRasterBand& band = *dataset->GetRasterBand(static_cast<int>(c) + 1);
      if (band.RasterIO(GF_Read, 0, y, width, 1, row.data(), width, 1, GDT_UInt16, 0, 0, nullptr) !=
          CE_None)
        throw refuse("cannot be read whole");
      for (std::size_t x = 0; x < row.size(); ++x) {
        if (palette)
          std::copy(colors[row[x]].begin(), colors[row[x]].end(), out + 4 * x);
        else
          out[channels * x + c] = level[row[x]];
      }
    }
  }
  return image;
}

}  // namespace talus
