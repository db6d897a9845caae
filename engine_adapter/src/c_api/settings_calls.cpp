#include <algorithm>
#include <string>
#include <string_view>

#include "bumper/response/presets.h"
#include "session.h"

namespace bumper::c_api {

namespace {

void givePreset(std::string_view name, bumper_response_settings* settings) {
  give("settings", settings, *findPreset(name));
}

/// The word for a number; toString() has one for a number out of range, too.
template <Enumeration E>
const char* wordFor(std::int32_t value) {
  return value >= 0 && value < countOf<E> ? toString(static_cast<E>(value)).data() : "unknown";
}

}  // namespace

extern "C" {

int bumper_init_response_settings(bumper_response_settings* settings, size_t size) {
  return initialise("bumper_init_response_settings", "settings", settings, size);
}

int bumper_init_responder_options(bumper_responder_options* options, size_t size) {
  return initialise("bumper_init_responder_options", "options", options, size);
}

int bumper_init_wall_selection(bumper_wall_selection* walls, size_t size) {
  return initialise("bumper_init_wall_selection", "walls", walls, size);
}

int bumper_init_barrier_options(bumper_barrier_options* options, size_t size) {
  return initialise("bumper_init_barrier_options", "options", options, size);
}

int bumper_init_scene(bumper_scene* scene, size_t size) {
  return initialise("bumper_init_scene", "scene", scene, size);
}

int bumper_init_wall_report(bumper_wall_report* report, size_t size) {
  return initialise("bumper_init_wall_report", "report", report, size);
}

int bumper_init_vehicle_parameters(bumper_vehicle_parameters* parameters, size_t size) {
  return initialise("bumper_init_vehicle_parameters", "parameters", parameters, size);
}

int bumper_init_vehicle_options(bumper_vehicle_options* options, size_t size) {
  return initialise("bumper_init_vehicle_options", "options", options, size);
}

int bumper_init_pair_options(bumper_pair_options* options, size_t size) {
  return initialise("bumper_init_pair_options", "options", options, size);
}

int bumper_init_motion(bumper_motion* motion, size_t size) {
  return initialise("bumper_init_motion", "motion", motion, size);
}

int bumper_init_event(bumper_event* event, size_t size) {
  return initialise("bumper_init_event", "event", event, size);
}

int bumper_preset_count() { return static_cast<int>(presetNames().size()); }

int bumper_get_preset(size_t index, const char** name, bumper_response_settings* settings) {
  return guarded("bumper_get_preset", [&] {
    const auto names = presetNames();
    requireIndex(index, names.size(), "presets");
    if (name == nullptr && settings == nullptr) refuse({"name"}, "is null, and settings too");
    if (settings != nullptr) givePreset(names[index], settings);
    if (name != nullptr) write(names[index], *name);
    return int{BUMPER_OK};
  });
}

int bumper_find_preset(const char* name, bumper_response_settings* settings) {
  return guarded("bumper_find_preset", [&] {
    const std::string_view wanted = &required("name", name);
    const auto names = presetNames();
    if (std::find(names.begin(), names.end(), wanted) == names.end()) {
      refuse({"name"}, "is none of a preset");
    }
    givePreset(wanted, settings);
    return int{BUMPER_OK};
  });
}

const char* bumper_phase_word(int32_t phase) { return wordFor<EventPhase>(phase); }
const char* bumper_law_word(int32_t law) { return wordFor<Law>(law); }
const char* bumper_outcome_word(int32_t outcome) { return wordFor<EnergyOutcome>(outcome); }
const char* bumper_regime_word(int32_t regime) { return wordFor<Regime>(regime); }

}  // extern "C"

}  // namespace bumper::c_api
