#include "talus/io/open_exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "talus/base/error.h"
#include "talus/io/mesh_formats.h"

namespace talus {
namespace {

constexpr int kStripRows = 256;  // the most that one compressed block holds

// Where a channel stands among the bands, and what it means.
struct Channel {
  std::string name;
  int rank = 3;
  GDALColorInterp meaning = GCI_GrayIndex;
};

Channel channel_of(const std::string& name) {
  if (name == "R") return {name, 0, GCI_RedBand};
  if (name == "G") return {name, 1, GCI_GreenBand};
  if (name == "B") return {name, 2, GCI_BlueBand};
  if (name == "A") return {name, 4, GCI_AlphaBand};
  return {name};
}

std::vector<Channel> channels_of(const Imf::Header& header) {
  std::vector<Channel> channels;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i)
    channels.push_back(channel_of(i.name()));
  std::stable_sort(channels.begin(), channels.end(),
                   [](const Channel& a, const Channel& b) { return a.rank < b.rank; });
  return channels;
}

GDALDatasetUniquePtr read_channels(const std::filesystem::path& path, std::uint64_t memory_limit) {
  Imf::InputFile file(path.c_str());
  const Imath::Box2i window = file.header().dataWindow();
  const std::vector<Channel> channels = channels_of(file.header());
  const double width = 1.0 + window.max.x - window.min.x,
               height = 1.0 + window.max.y - window.min.y;
  const int strip_rows = static_cast<int>(std::min<double>(kStripRows, height));
  const double need =
      sizeof(float) * width * (height + strip_rows) * static_cast<double>(channels.size());
  if (need > static_cast<double>(memory_limit))
    throw job_error(
        fmt::format("{}: {} channels of {} x {} pixels take {:.4g} GiB, the memory "
                    "limit is {:.4g} GiB",
                    path.string(), channels.size(), width, height, need / (1 << 30),
                    static_cast<double>(memory_limit) / (1 << 30)));

  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("MEM");
  GDALDatasetUniquePtr dataset(driver->Create("", static_cast<int>(width), static_cast<int>(height),
                                              static_cast<int>(channels.size()), GDT_Float32,
                                              nullptr));
  if (!dataset) throw job_error(fmt::format("{}: not enough memory", path.string()));
  const int nx = dataset->GetRasterXSize();
  std::vector<std::vector<float>> strips(
      channels.size(),
      std::vector<float>(static_cast<std::size_t>(nx) * static_cast<std::size_t>(strip_rows)));
  for (int y = window.min.y; y <= window.max.y; y += kStripRows) {
    const int last = std::min(y + kStripRows - 1, window.max.y);
    const Imath::Box2i strip({window.min.x, y}, {window.max.x, last});
    Imf::FrameBuffer buffer;
    for (std::size_t c = 0; c < channels.size(); ++c)
      buffer.insert(channels[c].name, Imf::Slice::Make(Imf::FLOAT, strips[c].data(), strip));
    file.setFrameBuffer(buffer);
    file.readPixels(y, last);
    for (std::size_t c = 0; c < channels.size(); ++c) {
      GDALRasterBand& band = *dataset->GetRasterBand(static_cast<int>(c) + 1);
      band.SetColorInterpretation(channels[c].meaning);
      const int rows = last - y + 1;
      if (band.RasterIO(GF_Write, 0, y - window.min.y, nx, rows, strips[c].data(), nx, rows,
                        GDT_Float32, 0, 0, nullptr) != CE_None)
        throw job_error(fmt::format("{}: cannot be kept in memory", path.string()));
    }
  }
  return dataset;
}

}  // namespace

bool is_exr(const std::filesystem::path& path) { return lower_extension(path) == ".exr"; }

GDALDatasetUniquePtr open_exr(const std::filesystem::path& path, std::uint64_t memory_limit) {
  try {
    return read_channels(path, memory_limit);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    std::string line = error.what();
    std::replace(line.begin(), line.end(), '\n', ' ');
    throw input_error(
        fmt::format("{}: no OpenEXR picture that can be read: {}", path.string(), line));
  }
}

}  // namespace talus
