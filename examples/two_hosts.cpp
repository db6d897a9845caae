// Two hosts, each a process with an ODE world of its own and one car in it. In each step they
// exchange their cars' states over a local socket; both then compute the impact of the two, with
// the same bits, and each applies its own car's share. Lower host first: respondPair() is a pure
// function of what was transmitted.
//
//   two_hosts [--impacts N]          exit code 0: both hosts got the same bits

#include <ode/ode.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <string>

#include "bumper/response/error.h"
#include "bumper/response/force_pulse.h"
#include "bumper/response/pair.h"
#include "tool.h"
#include "yaw_plane_car.h"

namespace {

using namespace bumper;
using namespace bumper::examples;
using namespace bumper::tools;

constexpr double step = 0.01;     // s
constexpr int longestRound = 80;  // steps

/// A car's state as it is transmitted: position, yaw, velocity and yaw rate.
using State = std::array<double, 6>;

/// The end of a socket that blocks until all has been sent or received.
class Peer {
 public:
  explicit Peer(int socket) : socket_(socket) {}
  ~Peer() { close(socket_); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;
  Peer(Peer&&) = delete;
  Peer& operator=(Peer&&) = delete;

  template <typename Data>
  Data exchange(const Data& own) const {
    const auto mine = std::as_bytes(std::span(&own, 1));
    for (std::size_t done = 0; done < mine.size();)
      done += counted(send(socket_, &mine[done], mine.size() - done, MSG_NOSIGNAL));
    Data other{};
    const auto its = std::as_writable_bytes(std::span(&other, 1));
    for (std::size_t done = 0; done < its.size();)
      done += counted(recv(socket_, &its[done], its.size() - done, 0));
    return other;
  }

 private:
  static std::size_t counted(ssize_t bytes) {
    if (bytes > 0) return static_cast<std::size_t>(bytes);
    if (bytes < 0 && errno == EINTR) return 0;
    throw Error("the other host has gone");
  }

  int socket_;
};

/// What an IEEE 1278.1 Collision-Elastic PDU (type 66) says of an impact, as its issuer sees it. An
/// event of Bumper's has all of it but the numbers of entities and events, which the application
/// gives, and the mass, which it knows.
struct CollisionElastic {
  int issuing = 0;
  int colliding = 0;
  std::uint64_t event = 0;    ///< both hosts count the same impacts
  Vector2 contactVelocity;    ///< of the issuer's contact point, m/s
  double mass = 0.0;          ///< kg
  Vector2 location;           ///< in the colliding vehicle's axes, m
  double intermediate = 0.0;  ///< 1/m + (r × n)²/I along the normal, 1/kg
  Vector2 normal;             ///< unit
  double restitution = 0.0;
};

/// FNV-1a over the bits of numbers.
class Digest {
 public:
  void add(double number) {
    for (unsigned shift = 0; shift < 64; shift += 8) {
      value_ ^= (std::bit_cast<std::uint64_t>(number) >> shift) & 0xFFU;
      value_ *= 0x100000001B3U;
    }
  }
  void add(const Vector2& vector) {
    for (const double number : vector) add(number);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325U;
};

/// One host: its world, its car, and what it knows of the other one's.
class Host {
 public:
  Host(int number, int socket)
      : number_(number),
        peer_(socket),
        world_(dWorldCreate()),
        body_(dBodyCreate(world_)),
        numbers_(static_cast<std::uint32_t>(number)) {
    dMass mass;
    dMassSetParameters(&mass, car_.mass, 0.0, 0.0, 0.0, 600.0, 2500.0, car_.yawInertia, 0.0, 0.0,
                       0.0);
    dBodySetMass(body_, &mass);
    dBodySetFiniteRotationMode(body_, 1);
  }
  ~Host() { dWorldDestroy(world_); }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  Host(Host&&) = delete;
  Host& operator=(Host&&) = delete;

  /// Rounds until so many impacts have been computed.
  void run(std::uint64_t impacts) {
    while (impacts_ < impacts) round();
  }

  /// Whether the other host got the same; says so.
  bool agrees() {
    const std::uint64_t other = peer_.exchange(digest_.value());
    std::printf(
        "host %d: %llu impacts, digest of all their bits %016llx, own speed off by %.1e m/s\n",
        number_, static_cast<unsigned long long>(impacts_),
        static_cast<unsigned long long>(digest_.value()), worst_);
    return other == digest_.value();
  }

 private:
  /// The cars come from either side, turned and turning as they like.
  void round() {
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const double side = number_ == 1 ? -1.0 : 1.0;
    dMatrix3 rotation;
    dRFromAxisAndAngle(rotation, 0.0, 0.0, 1.0, std::numbers::pi * share(numbers_));
    dBodySetRotation(body_, rotation);
    dBodySetPosition(body_, 5.0 * side, 0.8 * share(numbers_), 0.55);
    dBodySetLinearVel(body_, -side * (15.0 + 10.0 * share(numbers_)), share(numbers_), 0.0);
    dBodySetAngularVel(body_, 0.0, 0.0, 2.0 * share(numbers_));
    pulse_.drop();
    expected_.reset();
    for (int i = 0; i < longestRound; ++i) {
      if (stepBoth()) break;
    }
  }

  /// As it is by the law, with what is pending; in the plane.
  [[nodiscard]] State state() const {
    const dReal* place = dBodyGetPosition(body_);
    const dReal* turn = dBodyGetRotation(body_);
    const dReal* velocity = dBodyGetLinearVel(body_);
    const PlanarImpulse pending = pulse_.pending();
    return {place[0],
            place[1],
            std::atan2(turn[4], turn[0]),
            velocity[0] + pending.linear.x() / car_.mass,
            velocity[1] + pending.linear.y() / car_.mass,
            dBodyGetAngularVel(body_)[2] + pending.angular / car_.yawInertia};
  }

  [[nodiscard]] PairState pairState(const State& state) const {
    return {.vehicle = car_,
            .motion = {.position = {state[0], state[1]},
                       .yaw = state[2],
                       .velocity = {state[3], state[4]},
                       .yawRate = state[5]}};
  }

  /// Returns whether they have parted.
  bool stepBoth() {
    const State own = state();
    const State other = peer_.exchange(own);
    if (expected_) worst_ = std::max(worst_, (Vector2(own[3], own[4]) - *expected_).norm());
    expected_.reset();
    const bool isFirst = number_ == 1;
    const PairState first = pairState(isFirst ? own : other);
    const PairState second = pairState(isFirst ? other : own);
    if (const auto hit = respondPair(first, second, settings_, step)) {
      ++impacts_;
      const ImpactResponse& response = hit->response;
      digest_.add(hit->time);
      for (const Vector2& vector :
           {hit->impact.point, hit->impact.normal, hit->impact.arm, hit->impact.otherArm,
            response.impulse.linear, response.after.velocity, response.otherAfter.velocity})
        digest_.add(vector);
      digest_.add(response.after.yawRate);
      digest_.add(response.otherAfter.yawRate);
      if (impacts_ == 1) tell(*hit);
      // The opposite share for the second host's car.
      const PairHit mine = isFirst ? *hit : asSeenByOther(*hit);
      pulse_.add({.linear = mine.response.impulse.linear,
                  .angular = cross(mine.impact.arm, mine.response.impulse.linear)},
                 mine.time, step);
      expected_ = mine.response.after.velocity;
    }
    const PlanarForce force = pulse_.take(step);
    dBodyAddForce(body_, force.force.x(), force.force.y(), 0.0);
    dBodyAddTorque(body_, 0.0, 0.0, force.yawMoment);
    dWorldQuickStep(world_, step);
    const Vector2 apart = first.motion.position - second.motion.position;
    return apart.norm() > 8.0 && apart.dot(first.motion.velocity - second.motion.velocity) > 0.0;
  }

  /// The impact as this host's PDU.
  void tell(const PairHit& hit) const {
    const PairHit mine = number_ == 1 ? hit : asSeenByOther(hit);
    const Vector2& arm = mine.impact.arm;
    const double turning = cross(arm, mine.impact.normal);
    const Placement others(mine.response.otherBefore.position, mine.response.otherBefore.yaw);
    const CollisionElastic pdu{
        .issuing = number_,
        .colliding = 3 - number_,
        .event = impacts_,
        .contactVelocity = velocityAt(mine.response.before, arm),
        .mass = car_.mass,
        .location = others.turnedBack(mine.impact.otherArm),
        .intermediate = 1.0 / car_.mass + turning * turning / car_.yawInertia,
        .normal = mine.impact.normal,
        .restitution = mine.response.restitution};
    std::printf(
        "host %d: event %llu, %d hits %d at (%.3f, %.3f) m of it with %.0f kg, point at "
        "(%.3f, %.3f) m/s, normal (%.3f, %.3f), e = %.3f, k = %.2e /kg\n",
        number_, static_cast<unsigned long long>(pdu.event), pdu.issuing, pdu.colliding,
        pdu.location.x(), pdu.location.y(), pdu.mass, pdu.contactVelocity.x(),
        pdu.contactVelocity.y(), pdu.normal.x(), pdu.normal.y(), pdu.restitution, pdu.intermediate);
  }

  int number_;
  Peer peer_;
  VehicleParameters car_ = YawPlaneCarDesign{}.body;
  ResponseSettings settings_;
  dWorldID world_;
  dBodyID body_;
  std::mt19937 numbers_;
  ForcePulse pulse_;
  std::uint64_t impacts_ = 0;
  Digest digest_;
  std::optional<Vector2> expected_;  ///< the velocity after the last step's impact, by the law
  double worst_ = 0.0;
};

bool runHost(int number, int socket, std::uint64_t impacts) {
  dInitODE2(0);
  bool isSame = false;
  {
    Host host(number, socket);
    host.run(impacts);
    isSame = host.agrees();
  }
  dCloseODE();
  return isSame;
}

int run(int argc, char** argv) {
  std::uint64_t impacts = 1000;
  CLI::App app("Two processes with a car each exchange states, collide, and get the same bits.");
  app.add_option("--impacts", impacts, "how many at least")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{10'000'000}))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::array<int, 2> sockets{};
  if (socketpair(AF_UNIX, SOCK_STREAM, 0, sockets.data()) != 0)
    throw Error("no pair of sockets can be had");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw Error("no second process can be had");
  const bool isFirst = child != 0;
  close(sockets.at(isFirst ? 1 : 0));
  const bool isSame = runHost(isFirst ? 1 : 2, sockets.at(isFirst ? 0 : 1), impacts);
  if (!isFirst) return isSame ? 0 : 1;
  int status = 0;
  waitpid(child, &status, 0);
  const bool isBothSame = isSame && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  std::printf("%s\n", isBothSame ? "the same bits" : "not the same bits");
  return isBothSame ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) { return runMain("two_hosts", run, argc, argv); }
