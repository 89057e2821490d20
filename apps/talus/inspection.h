// What `inspect` tells.
#pragma once

#include <filesystem>
#include <string>

#include "talus/scene/tile_report.h"

namespace talus::cli {

// For a person, a line for each fact. Throws `Error` (input) for what cannot be read.
std::string inspection_text(const std::filesystem::path& subject);

// The same facts as JSON.
std::string inspection_json(const std::filesystem::path& subject);

// What tile sets are like, a line for each fact.
std::string tiles_text(const TileReport& tiles);

// Text as a JSON string, with its quotes.
std::string json_text(const std::string& text);

}  // namespace talus::cli
