#include "recording_lines.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <type_traits>
#include <utility>

#include "bumper/response/error.h"

namespace bumper {

namespace {

using Json = nlohmann::json;

constexpr std::string_view formatName = "bumper-recording";
constexpr int formatVersion = 1;
constexpr std::string_view hashPrefix = "fnv1a64:";
constexpr std::string_view posesStart = R"({"kind":"poses","time":)";
constexpr double notKnown = std::numeric_limits<double>::quiet_NaN();

/// What a pose's numbers mean, in their order.
constexpr std::array<const char*, 12> poseColumns = {"vehicle", "x",  "y",  "z",  "qw", "qx",
                                                     "qy",      "qz", "vx", "vy", "vz", "yawRate"};

struct VehicleField {
  const char* name;
  double VehicleParameters::*value;
};
constexpr std::array vehicleFields = {
    VehicleField{"mass", &VehicleParameters::mass},
    VehicleField{"yawInertia", &VehicleParameters::yawInertia},
    VehicleField{"massCentreToFront", &VehicleParameters::massCentreToFront},
    VehicleField{"massCentreToRear", &VehicleParameters::massCentreToRear},
    VehicleField{"width", &VehicleParameters::width},
    VehicleField{"massCentreHeight", &VehicleParameters::massCentreHeight}};

struct ImpactField {
  const char* name;
  double ImpactEvent::*value;
};
constexpr std::array impactFields = {
    ImpactField{"approachSpeed", &ImpactEvent::approachSpeed},
    ImpactField{"restitution", &ImpactEvent::restitution},
    ImpactField{"friction", &ImpactEvent::friction},
    ImpactField{"impulseNormal", &ImpactEvent::impulseNormal},
    ImpactField{"impulseTangent", &ImpactEvent::impulseTangent},
    ImpactField{"impulseRatio", &ImpactEvent::impulseRatio},
    ImpactField{"criticalImpulseRatio", &ImpactEvent::criticalImpulseRatio},
    ImpactField{"deltaV", &ImpactEvent::deltaV},
    ImpactField{"yawRateBefore", &ImpactEvent::yawRateBefore},
    ImpactField{"yawRateAfter", &ImpactEvent::yawRateAfter},
    ImpactField{"speedBefore", &ImpactEvent::speedBefore},
    ImpactField{"speedAfter", &ImpactEvent::speedAfter},
    ImpactField{"energyAsked", &ImpactEvent::energyAsked},
    ImpactField{"energyRatio", &ImpactEvent::energyRatio},
    ImpactField{"energyLost", &ImpactEvent::energyLost},
    ImpactField{"duration", &ImpactEvent::duration}};

struct AngleField {
  const char* name;
  double AnglesOfAttack::*value;
};
constexpr std::array angleFields = {AngleField{"contactVelocity", &AnglesOfAttack::contactVelocity},
                                    AngleField{"centreVelocity", &AnglesOfAttack::centreVelocity},
                                    AngleField{"heading", &AnglesOfAttack::heading}};

constexpr std::array otherFields = {
    ImpactField{"otherYawRateBefore", &ImpactEvent::otherYawRateBefore},
    ImpactField{"otherYawRateAfter", &ImpactEvent::otherYawRateAfter}};

constexpr std::array phases = {EventPhase::impact, EventPhase::contact_begin,
                               EventPhase::contact_end};
constexpr std::array laws = {Law::restitution, Law::energy};
constexpr std::array regimes = {Regime::separating, Regime::sliding, Regime::sticking,
                                Regime::reverse_slip};
constexpr std::array outcomes = {EnergyOutcome::not_asked,
                                 EnergyOutcome::met,
                                 EnergyOutcome::limited_by_restitution,
                                 EnergyOutcome::limited_by_friction,
                                 EnergyOutcome::below_reach,
                                 EnergyOutcome::no_break_through};

// ---- Writing ----

template <typename Number>
void append(std::string& text, Number value) {
  if constexpr (std::is_floating_point_v<Number>) {
    if (!std::isfinite(value)) {
      text += "null";
      return;
    }
    if (value == 0.0) {  // readers take "-0" for an integer, which has no sign
      text += std::signbit(value) ? "-0.0" : "0";
      return;
    }
  }
  std::array<char, 32> digits{};  // the longest double takes 24
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  text.append(digits.data(), written.ptr);
}

void append(std::string& text, std::optional<std::uint64_t> value) {
  if (value) {
    append(text, *value);
  } else {
    text += "null";
  }
}

std::string jsonString(std::string_view words) {
  return Json(words).dump(-1, ' ', false, Json::error_handler_t::replace);
}

void appendKey(std::string& text, std::string_view name) {
  text += ",\"";
  text += name;
  text += "\":";
}

template <typename Vector>
void appendVector(std::string& text, std::string_view name, const Vector& vector) {
  appendKey(text, name);
  char separator = '[';
  for (const double number : vector) {
    text += separator;
    append(text, number);
    separator = ',';
  }
  text += ']';
}

template <typename Fields, typename Owner>
void appendFields(std::string& text, const Fields& fields, const Owner& owner) {
  for (const auto& field : fields) {
    appendKey(text, field.name);
    append(text, owner.*field.value);
  }
}

void appendParameters(std::string& text, const RunParameters& parameters) {
  char separator = '{';
  for (const auto& [name, value] : parameters) {
    text += separator;
    text += jsonString(name);
    text += ':';
    if (const double* number = std::get_if<double>(&value)) {
      append(text, *number);
    } else {
      text += jsonString(std::get<std::string>(value));
    }
    separator = ',';
  }
  if (separator == '{') text += separator;
  text += '}';
}

std::string hexadecimal(std::uint64_t hash) {
  std::array<char, 16> digits{};
  const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), hash, 16);
  const std::string text(digits.data(), written.ptr);
  return std::string(digits.size() - text.size(), '0') + text;
}

void appendScene(std::string& text, const SceneReference& scene) {
  text += R"({"name":)" + jsonString(scene.name);
  if (!scene.file.empty()) text += R"(,"file":)" + jsonString(scene.file);
  if (!scene.up.empty()) text += R"(,"up":)" + jsonString(scene.up);
  text += R"(,"scale":)";
  append(text, scene.scale);
  if (!scene.builtIn.empty()) text += R"(,"builtIn":)" + jsonString(scene.builtIn);
  text += R"(,"triangles":)";
  append(text, std::uint64_t{scene.triangles});
  text += R"(,"hash":")" + std::string(hashPrefix) + hexadecimal(scene.hash) + "\"}";
}

// ---- Reading ----

/// Before a line is parsed: what has been parsed is compared and destroyed level by level.
void checkDepth(std::string_view line, std::size_t most) {
  std::size_t depth = 0;
  bool inString = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"') inString = !inString;
    if (inString) {
      if (c == '\\') ++k;
    } else if (c == '[' || c == '{') {
      if (++depth > most)
        throw Error(
            "its arrays and objects stand deeper in each other than RecordingLimits::depth, " +
            std::to_string(most) + ", allows");
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
}

/// The line as JSON; what the caller reads from it throws nlohmann's exceptions, see reading().
Json parse(std::string_view line, const RecordingLimits& limits) {
  checkDepth(line, limits.depth);
  return Json::parse(line);
}

double timeOf(double time, const RecordingLimits& limits) {
  if (std::abs(time) <= limits.latest) return time;
  std::ostringstream message;
  message << "its time is " << time << " s: RecordingLimits::latest, " << limits.latest
          << " s, is the most either way";
  throw Error(message.str());
}

/// nlohmann would convert any number to any other.
template <typename Integer>
Integer integerOf(const Json& value, const char* name) {
  const bool fits =
      value.is_number_unsigned()
          ? std::in_range<Integer>(value.get<std::uint64_t>())
          : value.is_number_integer() && std::in_range<Integer>(value.get<std::int64_t>());
  if (fits) return value.get<Integer>();
  throw Error(
      std::string(name) + " is " + value.dump(-1, ' ', true, Json::error_handler_t::replace) +
      ": it must be an integer from " + std::to_string(std::numeric_limits<Integer>::min()) +
      " to " + std::to_string(std::numeric_limits<Integer>::max()));
}

/// Calls what reads a line; whatever that finds wrong becomes an Error.
template <typename Reading>
auto reading(const Reading& read) {
  try {
    return read();
  } catch (const Json::parse_error&) {
    throw Error("this is no JSON");
  } catch (const Json::exception& error) {
    // "[json.exception.type_error.302] type must be number, but is string"
    const std::string_view what = error.what();
    throw Error(std::string(what.substr(what.find("] ") + 2)));
  }
}

double numberOf(const Json& value) { return value.is_null() ? notKnown : value.get<double>(); }

/// Of words that an enumeration has, the one that `word` is.
template <typename Words>
auto oneOf(const Words& words, const Json& word, const char* name) {
  const auto& text = word.get_ref<const std::string&>();
  for (const auto value : words) {
    if (toString(value) == text) return value;
  }
  throw Error(std::string(name) + " is \"" + text + "\", which is none of its words");
}

template <typename Vector>
void readVector(const Json& object, const char* name, Vector& vector) {
  const Json& array = object.at(name);
  const auto wanted = static_cast<std::size_t>(vector.size());
  if (!array.is_array() || array.size() != wanted)
    throw Error(std::string(name) + " is no list of " + std::to_string(wanted) + " numbers");
  for (Eigen::Index k = 0; k < vector.size(); ++k) {
    vector[k] = numberOf(array.at(static_cast<std::size_t>(k)));
  }
}

/// What files of earlier times do not have is not known.
template <typename Vector>
void readVectorIfThere(const Json& object, const char* name, Vector& vector) {
  vector.setConstant(notKnown);
  if (object.contains(name)) readVector(object, name, vector);
}

template <typename Fields, typename Owner>
void readFields(const Json& object, const Fields& fields, Owner& owner) {
  for (const auto& field : fields) owner.*field.value = numberOf(object.at(field.name));
}

void readOtherVehicle(const Json& object, ImpactEvent& event) {
  const auto other = object.find("otherVehicle");
  if (other == object.end()) return;
  if (!other->is_string()) throw Error("otherVehicle is no name");
  event.otherVehicle = other->get_ref<const std::string&>();
  readVectorIfThere(object, "otherArm", event.otherArm);
  readVectorIfThere(object, "otherVelocityBefore", event.otherVelocityBefore);
  readVectorIfThere(object, "otherVelocityAfter", event.otherVelocityAfter);
  for (const auto& field : otherFields) {
    const auto number = object.find(field.name);
    event.*field.value = number == object.end() ? notKnown : numberOf(*number);
  }
}

RunParameters parametersOf(const Json& object) {
  RunParameters parameters;
  for (const auto& [name, value] : object.items()) {
    if (value.is_string()) {
      parameters[name] = value.get<std::string>();
    } else {
      parameters[name] = numberOf(value);
    }
  }
  return parameters;
}

std::uint64_t hashOf(const std::string& text) {
  std::uint64_t hash = 0;
  const bool known = text.starts_with(hashPrefix);
  const char* begin = text.data() + (known ? hashPrefix.size() : 0);
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(begin, end, hash, 16);
  if (!known || read.ec != std::errc() || read.ptr != end)
    throw Error("the scene's hash is \"" + text + "\" instead of \"fnv1a64:\" and digits");
  return hash;
}

SceneReference sceneOf(const Json& object) {
  SceneReference scene;
  scene.name = object.at("name").get<std::string>();
  scene.file = object.value("file", std::string());
  scene.up = object.value("up", std::string());
  scene.scale = object.at("scale").get<double>();
  scene.builtIn = object.value("builtIn", std::string());
  scene.triangles = integerOf<std::size_t>(object.at("triangles"), "triangles");
  scene.hash = hashOf(object.at("hash").get<std::string>());
  return scene;
}

RecordedVehicle vehicleOf(const Json& object) {
  RecordedVehicle vehicle;
  vehicle.name = object.at("name").get<std::string>();
  readFields(object, vehicleFields, vehicle.parameters);
  vehicle.settings = parametersOf(object.at("settings"));
  return vehicle;
}

void requireFormat(const Json& header) {
  if (!header.is_object() || !header.contains("format") || header["format"] != formatName)
    throw Error("this is no recording: its first line does not say \"format\":\"" +
                std::string(formatName) + "\"");
  const int version = integerOf<int>(header.at("version"), "version");
  if (version != formatVersion) {
    throw Error("this recording is of format version " + std::to_string(version) + ", known is " +
                std::to_string(formatVersion));
  }
  // Poses are read by their place.
  if (header.at("poseColumns") != Json(poseColumns))
    throw Error("the columns of its poses are not those of format version 1");
}

void checkNames(const HeaderLine& header, std::size_t most) {
  std::size_t names = header.run.parameters.size() + header.vehicles.size();
  for (const RecordedVehicle& vehicle : header.vehicles) names += vehicle.settings.size();
  if (names > most)
    throw Error("its " + std::to_string(names) +
                " vehicles, parameters and settings are more than RecordingLimits::names, " +
                std::to_string(most) + ", allows");
}

std::optional<std::uint64_t> offsetOf(const Json& value) {
  if (value.is_null()) return std::nullopt;
  return integerOf<std::uint64_t>(value, "a byte of the file");
}

}  // namespace

void appendHeader(std::string& text, const RunDescription& run,
                  std::span<const RecordedVehicle> vehicles) {
  text += R"({"kind":"header","format":)" + jsonString(formatName) + R"(,"version":)";
  append(text, formatVersion);
  text += R"(,"library":)" + jsonString(BUMPER_VERSION) +
          R"(,"units":"SI, angles in rad; world right-handed, z up","scene":)";
  appendScene(text, run.scene);
  text += R"(,"parameters":)";
  appendParameters(text, run.parameters);
  text += R"(,"vehicles":[)";
  for (const RecordedVehicle& vehicle : vehicles) {
    if (text.back() != '[') text += ',';
    text += R"({"name":)" + jsonString(vehicle.name);
    appendFields(text, vehicleFields, vehicle.parameters);
    text += R"(,"settings":)";
    appendParameters(text, vehicle.settings);
    text += '}';
  }
  text += R"(],"poseColumns":)" + Json(poseColumns).dump() + "}\n";
}

void appendPoseLineBegin(std::string& text, double time) {
  text += posesStart;
  append(text, time);
  text += R"(,"poses":[)";
}

void appendPose(std::string& text, std::size_t vehicle, const RecordedPose& pose, bool first) {
  text += first ? "[" : ",[";
  append(text, vehicle);
  const Eigen::Quaterniond& turn = pose.orientation;
  for (const double number :
       {pose.position.x(), pose.position.y(), pose.position.z(), turn.w(), turn.x(), turn.y(),
        turn.z(), pose.velocity.x(), pose.velocity.y(), pose.velocity.z(), pose.yawRate}) {
    text += ',';
    append(text, number);
  }
  text += ']';
}

void appendImpact(std::string& text, const ImpactEvent& event) {
  text += R"({"kind":"impact","time":)";
  append(text, event.time);
  for (const auto& [name, words] :
       {std::pair{"phase", toString(event.phase)}, std::pair{"vehicle", event.vehicle},
        std::pair{"barrier", event.barrier}, std::pair{"material", event.material},
        std::pair{"law", toString(event.law)}, std::pair{"regime", toString(event.regime)},
        std::pair{"outcome", toString(event.outcome)}}) {
    appendKey(text, name);
    text += jsonString(words);
  }
  appendKey(text, "triangle");
  append(text, event.triangle);
  appendVector(text, "contact", event.contact);
  appendVector(text, "normal", event.normal);
  appendVector(text, "arm", event.arm);
  appendVector(text, "velocityBefore", event.velocityBefore);
  appendVector(text, "velocityAfter", event.velocityAfter);
  appendKey(text, "angles");
  std::string angles;
  appendFields(angles, angleFields, event.angles);
  angles.front() = '{';
  text += angles + '}';
  appendFields(text, impactFields, event);
  if (!event.otherVehicle.empty()) {
    appendKey(text, "otherVehicle");
    text += jsonString(event.otherVehicle);
    appendVector(text, "otherArm", event.otherArm);
    appendVector(text, "otherVelocityBefore", event.otherVelocityBefore);
    appendVector(text, "otherVelocityAfter", event.otherVelocityAfter);
    appendFields(text, otherFields, event);
  }
  text += "}\n";
}

void appendIndex(std::string& text, std::optional<std::uint64_t> previous,
                 std::span<const IndexedImpact> impacts) {
  text += R"({"kind":"index","previous":)";
  append(text, previous);
  text += R"(,"impacts":[)";
  for (const auto& [time, offset] : impacts) {
    text += text.back() == '[' ? "[" : ",[";
    append(text, time);
    text += ',';
    append(text, offset);
    text += ']';
  }
  text += "]}\n";
}

void appendEnd(std::string& text, std::optional<std::uint64_t> index, std::uint64_t impacts) {
  text += R"({"kind":"end","index":)";
  append(text, index);
  text += R"(,"impacts":)";
  append(text, impacts);
  text += "}\n";
}

void requireUtf8(const std::string& name) {
  try {
    (void)Json(name).dump();
  } catch (const Json::exception&) {
    throw Error("Recording: the vehicle name \"" + name + "\" is not UTF-8; a file's must be");
  }
}

LineStart startOf(std::string_view line, const RecordingLimits& limits) {
  if (line.starts_with(posesStart)) {
    double time = 0.0;
    const char* end = line.data() + line.size();
    const auto read = std::from_chars(line.data() + posesStart.size(), end, time);
    if (read.ec == std::errc() && read.ptr != end && *read.ptr == ',')
      return {.kind = LineKind::poses, .time = timeOf(time, limits)};
  }
  return reading([&]() -> LineStart {
    const Json object = parse(line, limits);
    const std::string kind = object.at("kind").get<std::string>();
    if (kind == "poses" || kind == "impact") {
      return {.kind = kind == "poses" ? LineKind::poses : LineKind::impact,
              .time = timeOf(object.at("time").get<double>(), limits)};
    }
    if (kind == "index") return {.kind = LineKind::index};
    if (kind == "end") return {.kind = LineKind::end};
    throw Error("its kind is \"" + kind + "\", known are poses, impact, index and end");
  });
}

bool isWhole(std::string_view line) { return Json::accept(line); }

HeaderLine parseHeader(std::string_view line, const RecordingLimits& limits) {
  return reading([&] {
    const Json object = parse(line, limits);
    requireFormat(object);
    HeaderLine header;
    header.libraryVersion = object.at("library").get<std::string>();
    header.run.scene = sceneOf(object.at("scene"));
    header.run.parameters = parametersOf(object.at("parameters"));
    for (const Json& vehicle : object.at("vehicles")) {
      header.vehicles.push_back(vehicleOf(vehicle));
    }
    checkNames(header, limits.names);
    return header;
  });
}

PoseLine parsePoses(std::string_view line, const RecordingLimits& limits) {
  return reading([&] {
    const Json object = parse(line, limits);
    const double time = timeOf(object.at("time").get<double>(), limits);
    PoseLine poses;
    for (const Json& row : object.at("poses")) {
      if (row.size() != poseColumns.size())
        throw Error("a pose has " + std::to_string(row.size()) + " numbers instead of " +
                    std::to_string(poseColumns.size()));
      const auto number = [&](std::size_t column) { return row.at(column).get<double>(); };
      RecordedPose pose;
      pose.time = time;
      pose.position = {number(1), number(2), number(3)};
      pose.orientation = Eigen::Quaterniond(number(4), number(5), number(6), number(7));
      pose.velocity = {number(8), number(9), number(10)};
      pose.yawRate = number(11);
      poses.emplace_back(integerOf<std::size_t>(row.at(0), "a vehicle's index"), pose);
    }
    return poses;
  });
}

RecordedImpact parseImpact(std::string_view line, const RecordingLimits& limits) {
  return reading([&] {
    const Json object = parse(line, limits);
    ImpactEvent event;
    event.time = timeOf(object.at("time").get<double>(), limits);
    event.vehicle = object.at("vehicle").get_ref<const std::string&>();
    event.barrier = object.at("barrier").get_ref<const std::string&>();
    event.material = object.at("material").get_ref<const std::string&>();
    event.phase = oneOf(phases, object.at("phase"), "phase");
    event.law = oneOf(laws, object.at("law"), "law");
    event.regime = oneOf(regimes, object.at("regime"), "regime");
    event.outcome = oneOf(outcomes, object.at("outcome"), "outcome");
    event.triangle = integerOf<int>(object.at("triangle"), "triangle");
    readVector(object, "contact", event.contact);
    readVector(object, "normal", event.normal);
    readVector(object, "arm", event.arm);
    readVector(object, "velocityAfter", event.velocityAfter);
    readVectorIfThere(object, "velocityBefore", event.velocityBefore);
    readFields(object.at("angles"), angleFields, event.angles);
    readFields(object, impactFields, event);
    readOtherVehicle(object, event);
    return RecordedImpact(event);
  });
}

IndexLine parseIndex(std::string_view line, const RecordingLimits& limits) {
  return reading([&] {
    const Json object = parse(line, limits);
    IndexLine index;
    index.previous = offsetOf(object.at("previous"));
    for (const Json& entry : object.at("impacts")) {
      index.impacts.emplace_back(entry.at(0).get<double>(),
                                 integerOf<std::uint64_t>(entry.at(1), "a byte of the file"));
    }
    return index;
  });
}

EndLine parseEnd(std::string_view line, const RecordingLimits& limits) {
  return reading([&] {
    const Json object = parse(line, limits);
    return EndLine{.index = offsetOf(object.at("index")),
                   .impacts = integerOf<std::uint64_t>(object.at("impacts"), "impacts")};
  });
}

}  // namespace bumper
