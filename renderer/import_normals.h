// Normals for triangles that come without: smooth over an edge unless it is sharp.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace vindu {

/// Edges between faces whose normals differ by more than this stay sharp.
constexpr double kSmoothingLimit_deg = 60;

/// One normal for each corner, given by its position (three in a row are a triangle): the mean of
/// the faces that meet at the corner's position and lie within the limit of its own face, each
/// weighted by its angle there (Thuermer & Wuethrich, "Computing Vertex Normals from Polygonal
/// Facets", 1998). A triangle without area gets +z where no neighbour helps.
std::vector<Eigen::Vector3f> corner_normals(std::span<const Eigen::Vector3f> positions);

}  // namespace vindu
