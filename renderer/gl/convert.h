// The one place where Eigen's values become GLM's: single precision, column major.
#pragma once

#include <Eigen/Core>
#include <glm/glm.hpp>

namespace vindu::gl {

template <class Derived>
glm::vec3 vec3_from(const Eigen::MatrixBase<Derived>& value) {
  return {static_cast<float>(value.x()), static_cast<float>(value.y()),
          static_cast<float>(value.z())};
}

template <class Derived>
glm::mat4 mat4_from(const Eigen::MatrixBase<Derived>& value) {
  glm::mat4 result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result[column][row] = static_cast<float>(value(row, column));
  return result;
}

template <class Derived>
glm::mat3 mat3_from(const Eigen::MatrixBase<Derived>& value) {
  glm::mat3 result;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      result[column][row] = static_cast<float>(value(row, column));
  return result;
}

}  // namespace vindu::gl
