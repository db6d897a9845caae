#pragma once

#include <Eigen/Core>

#include "bumper/render/image.h"

namespace bumper::doctor {

/// Draws a straight line of `width` pixels over a picture, between two places in pixels from the
/// left and the top edge, which may lie outside. Ends are round, edges smooth.
void drawLine(Image& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour,
              double width);

/// The same with a head at its end.
void drawArrow(Image& image, const Eigen::Vector2d& from, const Eigen::Vector2d& to, Rgb colour,
               double width);

}  // namespace bumper::doctor
