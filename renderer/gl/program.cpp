#include "renderer/gl/program.h"

#include <fstream>
#include <glm/gtc/type_ptr.hpp>
#include <sstream>

#include "core/error.h"
#include "renderer/resources.h"

namespace vindu::gl {
namespace {

std::string read_shader(const std::string& name) {
  const std::string path = find_shader(name);
  std::ifstream file(path);
  if (!file) throw Error({"cannot be read", path, "install Vindu again"});
  std::ostringstream text;
  for (std::string line; std::getline(file, line);) {
    constexpr std::string_view include = "#include \"";
    if (line.starts_with(include))
      text << read_shader(line.substr(include.size(), line.rfind('"') - include.size()));
    else
      text << line << '\n';
  }
  return text.str();
}

Shader compile(GLenum stage, const std::string& name, const std::string& defines) {
  const std::string text = "#version 450 core\n" + defines + read_shader(name);
  Shader shader(glCreateShader(stage));
  const char* source = text.c_str();
  glShaderSource(shader.name(), 1, &source, nullptr);
  glCompileShader(shader.name());
  GLint done = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &done);
  if (done) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader.name(), static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  throw Error({"does not compile: " + log, "shader " + name, "report this with the GL version"});
}

}  // namespace

Program::Program(const std::string& vertex, const std::string& fragment, const std::string& defines)
    : handle_(glCreateProgram()) {
  const Shader vertex_shader = compile(GL_VERTEX_SHADER, vertex, defines);
  const Shader fragment_shader = compile(GL_FRAGMENT_SHADER, fragment, defines);
  glAttachShader(handle_.name(), vertex_shader.name());
  glAttachShader(handle_.name(), fragment_shader.name());
  glLinkProgram(handle_.name());
  GLint done = 0;
  glGetProgramiv(handle_.name(), GL_LINK_STATUS, &done);
  if (done) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(handle_.name(), static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  throw Error({"do not link: " + log, "shaders " + vertex + " and " + fragment, ""});
}

GLint Program::location(const char* uniform) const {
  return glGetUniformLocation(handle_.name(), uniform);
}

void Program::set(const char* uniform, int value) const {
  glProgramUniform1i(handle_.name(), location(uniform), value);
}
void Program::set(const char* uniform, float value) const {
  glProgramUniform1f(handle_.name(), location(uniform), value);
}
void Program::set(const char* uniform, const glm::vec2& value) const {
  glProgramUniform2fv(handle_.name(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(const char* uniform, const glm::vec3& value) const {
  glProgramUniform3fv(handle_.name(), location(uniform), 1, glm::value_ptr(value));
}
void Program::set(const char* uniform, const glm::mat3& value) const {
  glProgramUniformMatrix3fv(handle_.name(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(const char* uniform, const glm::mat4& value) const {
  glProgramUniformMatrix4fv(handle_.name(), location(uniform), 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace vindu::gl
