#include "apps/talus/camera_options.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "talus/scene/fields.h"

namespace talus::cli {
namespace {

// The keys of [view] that the command line gives.
std::set<std::string, std::less<>> given_keys(const Command& command) {
  std::set<std::string, std::less<>> keys;
  const auto add = [&](std::string_view path) {
    constexpr std::string_view kView = "view.";
    if (!path.starts_with(kView)) return;
    path.remove_prefix(kView.size());
    keys.emplace(path.substr(0, path.find('.')));
  };
  for (const Setting& option : command.options) add(option.path);
  for (const std::string& setting : command.settings) add(setting.substr(0, setting.find('=')));
  return keys;
}

}  // namespace

void let_command_place_camera(Value& document, const Command& command) {
  auto& members = std::get<Value::Table>(document.data);
  const auto view =
      std::find_if(members.begin(), members.end(), [](const Member& m) { return m.key == "view"; });
  if (view == members.end() || !view->value.table()) return;
  const std::set<std::string, std::less<>> given = given_keys(command);
  const auto gives = [&](std::string_view key) { return given.contains(key); };
  const auto camera_is = [&](std::string_view preset) {
    const Value* camera = view->value.find("camera");
    return camera && camera->text() && lower_case(*camera->text()) == preset;
  };
  const auto drop = [&](std::string_view key) {
    if (!gives(key))
      std::erase_if(std::get<Value::Table>(view->value.data),
                    [&](const Member& member) { return member.key == key; });
  };

  const bool around = gives("azimuth_deg") || gives("elevation_deg") || gives("zoom");
  const bool by_hand = gives("eye") || gives("target");
  const bool by_preset = gives("camera") && !camera_is("inside");
  if (by_hand) {
    for (const char* key : {"azimuth_deg", "elevation_deg", "zoom"}) drop(key);
  } else if (around || by_preset) {
    drop("eye");
    drop("target");
    // Inside there must be an eye, and a person's height leaves no elevation to choose.
    if (camera_is("inside")) drop("camera");
    if (camera_is("low") && (gives("elevation_deg") || gives("zoom"))) drop("camera");
  }
  if (gives("camera") && camera_is("low")) {
    drop("elevation_deg");
    drop("zoom");
  }
}

}  // namespace talus::cli
