#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "bumper/base/api.h"
#include "bumper/response/response_settings.h"

/// Response settings with a source. Each is a starting point to copy and change. Unless one says
/// otherwise: Method::bumper, the restitution law, the angle by the contact point's velocity,
/// Coulomb friction, a penetration time of 2.5 ms.
namespace BUMPER_API bumper {

/// "paper": Knight and Bernard 2003, what a default ResponseSettings holds. From grazing (0°) to
/// head-on (90°) e falls from 0.3 to 0.05, μ from 0.3 to 0 and the remaining energy P from 0.92 to
/// 0.04, as cosines of the angle.
///
/// For any angle and speed where a collision has to look right; the authors chose the curves on
/// pragmatic grounds. Against two redirective crash tests (25°, 100 km/h) the exit speed is 8 % too
/// low and the exit trajectory too shallow. A modern car rebounds further head-on: see
/// modernCarSettings().
ResponseSettings paperSettings();

/// "macmillan": Macmillan, Dynamics of Vehicle Collisions, 1983, as the paper reports him: e and μ
/// from 0 to 0.3 in typical vehicle collisions. He gives ranges and no dependence on the angle, so
/// this is the middle of both, e = μ = 0.15, at every angle.
///
/// For typical collisions when nothing more is known. The effect of the choice within the ranges is
/// seen at their ends: the exit speed of the two redirective crash tests is met within 1.5 % by the
/// middle, and within 10 % by either end. The energy law is not his: P stays the paper's.
ResponseSettings macmillanSettings();

/// "modern_car": head-on restitution 0.17 as measured on a 2018 Toyota Camry at 57 km/h into a
/// rigid wall (NHTSA test 10146), by either law: e = 0.17 and P = 0.17² at 90°. Towards grazing,
/// which that test does not cover, the paper's curves.
///
/// For modern passenger cars, 60° to 90° against rigid walls at about 40 to 70 km/h. One car, one
/// test: in slower collisions expect more rebound.
ResponseSettings modernCarSettings();

/// "reconstruction": a vehicle that snags on the edge of a barrier. The contact point comes to
/// rest: e = 0 and friction 1 as a fraction of the critical impulse ratio. It is found at the depth
/// that is reached in 70 ms, more than a metre inside the outline at 64 km/h.
///
/// From Brach's planar impact analysis of six small-overlap tests of the IIHS at 64 km/h. In the
/// four in which the car snags, the fraction fitted is 0.96 to 1 and e 0 to 0.15. 70 ms is the mean
/// of the times that suit each test, 52 to 82 ms.
///
/// In those four the impulse at that point, respond()'s, gives the velocity change within 13 % and
/// the yaw rate within 22 %. A whole collision step gives the velocity change up to 24 % too large
/// and the yaw rate 23 to 40 % too low (with 2.5 ms 43 to 56 %): the outline keeps its shape, and
/// as the car turns its front meets the edge once more, where the real one is crushed.
///
/// Where the car slips past, off a pole or a well-rounded edge, the fraction has to be fitted to
/// the case (0.72 and 0.87): 1 makes the velocity change up to 1.5 and the yaw rate up to 3 times
/// too large. Wrong for a vehicle that scrapes along a wall: it would be stopped. The restitution
/// law of Method::bumper only.
ResponseSettings reconstructionSettings();

/// The names above, in this order.
std::span<const std::string_view> presetNames();

/// Nothing if no preset has that name.
std::optional<ResponseSettings> findPreset(std::string_view name);

}  // namespace bumper
