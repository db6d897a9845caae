#include "bumper/render/csv_export.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <string_view>
#include <system_error>

#include "bumper/base/output_file.h"
#include "bumper/render/degrees.h"
#include "bumper/response/error.h"

namespace bumper {

namespace {

constexpr std::string_view eventsHeader =
    "time_s,phase,duration_s,vehicle,barrier,triangle,material,law,contact_x_m,contact_y_m,"
    "contact_z_m,normal_x,normal_y,normal_z,arm_x_m,arm_y_m,angle_of_attack_deg,"
    "angle_centre_velocity_deg,angle_heading_deg,approach_speed_mps,restitution,friction,"
    "impulse_normal_Ns,impulse_tangent_Ns,impulse_ratio,critical_impulse_ratio,delta_v_mps,"
    "yaw_rate_before_rps,yaw_rate_after_rps,speed_before_mps,speed_after_mps,"
    "velocity_after_x_mps,velocity_after_y_mps,velocity_after_z_mps,energy_asked,energy_ratio,"
    "energy_lost_J,outcome,regime,velocity_before_x_mps,velocity_before_y_mps,velocity_before_z_"
    "mps,"
    "other_vehicle,other_arm_x_m,other_arm_y_m,other_velocity_before_x_mps,"
    "other_velocity_before_y_mps,other_velocity_before_z_mps,other_velocity_after_x_mps,"
    "other_velocity_after_y_mps,other_velocity_after_z_mps,other_yaw_rate_before_rps,"
    "other_yaw_rate_after_rps\n";

constexpr std::string_view trajectoryHeader =
    "time_s,x_m,y_m,z_m,yaw_rad,vx_mps,vy_mps,vz_mps,yaw_rate_rps\n";

/// One line of a file, field by field.
class Row {
 public:
  explicit Row(std::string& text) : text_(text) {}

  Row& operator<<(double value) {
    separate();
    if (std::isnan(value)) return *this;
    return append(value);
  }

  template <int size>
  Row& operator<<(const Eigen::Matrix<double, size, 1>& vector) {
    for (const double value : vector) *this << value;
    return *this;
  }

  Row& operator<<(int value) {
    separate();
    return append(value);
  }

  Row& operator<<(std::string_view name) {
    separate();
    if (name.find_first_of(",\"\r\n") == std::string_view::npos) {
      text_ += name;
      return *this;
    }
    text_ += '"';
    for (const char letter : name) text_.append(letter == '"' ? 2 : 1, letter);
    text_ += '"';
    return *this;
  }

  void end() { text_ += '\n'; }

 private:
  template <typename Number>
  Row& append(Number value) {
    std::array<char, 32> digits{};  // the longest double takes 24
    const auto written = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text_.append(digits.data(), written.ptr);
    return *this;
  }

  void separate() {
    if (!first_) text_ += ',';
    first_ = false;
  }

  std::string& text_;
  bool first_ = true;
};

std::string eventsText(const Recording& recording) {
  std::string text(eventsHeader);
  for (const RecordedImpact& impact : recording.impacts()) {
    const ImpactEvent event = impact.event();
    Row row(text);
    row << event.time << toString(event.phase) << event.duration << event.vehicle << event.barrier
        << event.triangle << event.material << toString(event.law) << event.contact.x()
        << event.contact.y() << event.contact.z() << event.normal.x() << event.normal.y()
        << event.normal.z() << event.arm.x() << event.arm.y()
        << event.angles.contactVelocity * degrees << event.angles.centreVelocity * degrees
        << event.angles.heading * degrees << event.approachSpeed << event.restitution
        << event.friction << event.impulseNormal << event.impulseTangent << event.impulseRatio
        << event.criticalImpulseRatio << event.deltaV << event.yawRateBefore << event.yawRateAfter
        << event.speedBefore << event.speedAfter << event.velocityAfter.x()
        << event.velocityAfter.y() << event.velocityAfter.z() << event.energyAsked
        << event.energyRatio << event.energyLost << toString(event.outcome)
        << toString(event.regime) << event.velocityBefore << event.otherVehicle;
    // A field stays empty where there is no other vehicle.
    const double known =
        event.otherVehicle.empty() ? std::numeric_limits<double>::quiet_NaN() : 1.0;
    row << Vector2(known * event.otherArm) << Eigen::Vector3d(known * event.otherVelocityBefore)
        << Eigen::Vector3d(known * event.otherVelocityAfter) << known * event.otherYawRateBefore
        << known * event.otherYawRateAfter;
    row.end();
  }
  return text;
}

std::string trajectoryText(const RecordedVehicle& vehicle) {
  std::string text(trajectoryHeader);
  double yaw = vehicle.poses.empty() ? 0.0 : heading(vehicle.poses.front().orientation);
  for (const RecordedPose& pose : vehicle.poses) {
    const double wrapped = heading(pose.orientation);
    yaw = wrapped + 2.0 * std::numbers::pi * std::round((yaw - wrapped) / (2.0 * std::numbers::pi));
    Row row(text);
    row << pose.time << pose.position.x() << pose.position.y() << pose.position.z() << yaw
        << pose.velocity.x() << pose.velocity.y() << pose.velocity.z() << pose.yawRate;
    row.end();
  }
  return text;
}

}  // namespace

void writeCsv(const Recording& recording, const std::filesystem::path& folder,
              std::size_t vehicle) {
  const auto vehicles = recording.vehicles();
  if (vehicle >= vehicles.size() && !(vehicle == 0 && vehicles.empty())) {
    throw Error("writeCsv: there is no vehicle " + std::to_string(vehicle) +
                "; the recording has " + std::to_string(vehicles.size()));
  }
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure || !std::filesystem::is_directory(folder, failure))
    throw Error("cannot write into " + folder.string() + ": it is not a folder that can be made");

  OutputFile events(folder / "events.csv");
  OutputFile trajectory(folder / "trajectory.csv");
  events.write({eventsText(recording)});
  trajectory.write(
      {vehicles.empty() ? std::string(trajectoryHeader) : trajectoryText(vehicles[vehicle])});
  events.moveToPlace();
  trajectory.moveToPlace();
}

}  // namespace bumper
