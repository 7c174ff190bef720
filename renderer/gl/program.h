// A linked shader program, from files of the shaders folder. A line `#include "name"` in them is
// replaced by that file.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "renderer/gl/handle.h"

namespace vindu::gl {

class Program {
 public:
  /// Names of files in the shaders folder, "scene.vert". Throws Error with the compiler's words.
  Program(const std::string& vertex, const std::string& fragment, const std::string& defines = "");

  void use() const { glUseProgram(handle_.name()); }
  void set(const char* uniform, int value) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, const glm::vec2& value) const;
  void set(const char* uniform, const glm::vec3& value) const;
  void set(const char* uniform, const glm::mat3& value) const;
  void set(const char* uniform, const glm::mat4& value) const;

 private:
  GLint location(const char* uniform) const;

  Handle<ProgramTraits> handle_;
};

}  // namespace vindu::gl
