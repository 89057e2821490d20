#include "apps/talus/inspection.h"

#include <nlohmann/json.hpp>

#include "talus/base/error.h"

namespace talus::cli {

std::string inspection_text(const std::filesystem::path& subject) {
  throw input_error(subject.string());
}

std::string inspection_json(const std::filesystem::path& subject) {
  return inspection_text(subject);
}

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace talus::cli
