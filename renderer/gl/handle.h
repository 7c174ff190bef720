// Move-only owners of OpenGL names, created by direct state access (OpenGL 4.5). Bound to the
// thread that has the context current; destroyed before the context.
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace vindu::gl {

/// Owns one name; Traits has destroy(GLuint). Name 0 is "nothing".
template <class Traits>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() {
    if (name_) Traits::destroy(name_);
  }

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

struct BufferTraits {
  static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};
struct VertexArrayTraits {
  static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};
struct TextureTraits {
  static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};
struct SamplerTraits {
  static void destroy(GLuint name) { glDeleteSamplers(1, &name); }
};
struct RenderbufferTraits {
  static void destroy(GLuint name) { glDeleteRenderbuffers(1, &name); }
};
struct FramebufferTraits {
  static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};
struct ProgramTraits {
  static void destroy(GLuint name) { glDeleteProgram(name); }
};
struct ShaderTraits {
  static void destroy(GLuint name) { glDeleteShader(name); }
};

struct QueryTraits {
  static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};

using Buffer = Handle<BufferTraits>;
using VertexArray = Handle<VertexArrayTraits>;
using Texture = Handle<TextureTraits>;
using Sampler = Handle<SamplerTraits>;
using Renderbuffer = Handle<RenderbufferTraits>;
using Framebuffer = Handle<FramebufferTraits>;
using Shader = Handle<ShaderTraits>;
using Query = Handle<QueryTraits>;

inline VertexArray make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return VertexArray(name);
}

inline Texture make_texture_2d() {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  return Texture(name);
}

inline Sampler make_sampler() {
  GLuint name = 0;
  glCreateSamplers(1, &name);
  return Sampler(name);
}

inline Framebuffer make_framebuffer() {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  return Framebuffer(name);
}

inline Renderbuffer make_renderbuffer() {
  GLuint name = 0;
  glCreateRenderbuffers(1, &name);
  return Renderbuffer(name);
}

/// A buffer of fixed size; `data` may be null when it is written later.
inline Buffer make_buffer(const void* data, std::size_t bytes, GLbitfield flags = 0) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes ? bytes : 16), bytes ? data : nullptr,
                       flags);
  return Buffer(name);
}

/// A point in the stream of commands; owns its sync object. The default one has passed.
class Fence {
 public:
  Fence() = default;
  Fence(Fence&& other) noexcept : sync_(std::exchange(other.sync_, nullptr)) {}
  Fence& operator=(Fence&& other) noexcept {
    std::swap(sync_, other.sync_);
    return *this;
  }
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;
  ~Fence() {
    if (sync_) glDeleteSync(sync_);
  }

  static Fence here() {
    Fence fence;
    fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    return fence;
  }
  bool passed() const {
    return !sync_ || glClientWaitSync(sync_, GL_SYNC_FLUSH_COMMANDS_BIT, 0) != GL_TIMEOUT_EXPIRED;
  }

 private:
  GLsync sync_ = nullptr;
};

}  // namespace vindu::gl
