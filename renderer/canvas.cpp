#include "renderer/canvas.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "core/error.h"

namespace vindu {
namespace {

GLenum colour_format(Style style) { return style == Style::lit ? GL_SRGB8_ALPHA8 : GL_RGBA8; }

void check_complete(GLuint framebuffer, SizePx size) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  const std::string shown = std::to_string(size.width) + "x" + std::to_string(size.height);
  const std::string remedy =
      "draw smaller pictures (--scale); the largest side here is " + std::to_string(largest);
  if (glCheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return;
  while (glGetError() != GL_NO_ERROR) continue;  // reported below; not the next caller's
  throw Error({"cannot make a picture of " + shown + " pixels", "OpenGL", remedy});
}

}  // namespace

Picture::Picture(SizePx size, Style style)
    : size_(size), texture_(gl::make_texture_2d()), framebuffer_(gl::make_framebuffer()) {
  const auto longest = static_cast<unsigned>(std::max(size.width, size.height));
  glTextureStorage2D(texture_.name(), std::bit_width(longest), colour_format(style), size.width,
                     size.height);
  glTextureParameteri(texture_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameterf(texture_.name(), GL_TEXTURE_MAX_ANISOTROPY, 8.0f);
  glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, texture_.name(), 0);
  check_complete(framebuffer_.name(), size);
}

void Picture::clear(Rgba8 colour, const RectPx& part) {
  glDisable(GL_FRAMEBUFFER_SRGB);  // the bytes as they are
  glEnable(GL_SCISSOR_TEST);
  glScissor(part.x, part.y, part.size.width, part.size.height);
  const float values[] = {colour[0] / 255.0f, colour[1] / 255.0f, colour[2] / 255.0f, 1.0f};
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, values);
  glDisable(GL_SCISSOR_TEST);
}

void Picture::copy(const Picture& other, int x, int y) {
  glDisable(GL_FRAMEBUFFER_SRGB);
  const auto [width, height] = other.size_;
  glBlitNamedFramebuffer(other.framebuffer(), framebuffer(), 0, 0, width, height, x, y, x + width,
                         y + height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image Picture::read() const { return read({0, 0, size_}); }

Image Picture::read(const RectPx& part) const {
  const auto& [x, y, size] = part;
  Image image = Image::filled(size.width, size.height, {});
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureSubImage(texture_.name(), 0, x, y, 0, size.width, size.height, 1, GL_RGBA,
                       GL_UNSIGNED_BYTE, static_cast<GLsizei>(image.pixels.size() * sizeof(Rgba8)),
                       image.pixels.data());
  for (int row = 0; row < size.height / 2; ++row)
    std::swap_ranges(&image.at(0, row), &image.at(0, row) + size.width,
                     &image.at(0, size.height - 1 - row));
  return image;
}

void Picture::write(const Image& image, int x, int y) {
  assert(x >= 0 && y >= 0 && x + image.width_px <= size_.width &&
         y + image.height_px <= size_.height);
  Image flipped = image;
  for (int row = 0; row < image.height_px; ++row)
    std::copy_n(&image.at(0, row), image.width_px, &flipped.at(0, image.height_px - 1 - row));
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture_.name(), 0, x, y, image.width_px, image.height_px, GL_RGBA,
                      GL_UNSIGNED_BYTE, flipped.pixels.data());
}

Canvas::Canvas(SizePx size, const Look& look)
    : size_(size),
      look_(look),
      colour_(gl::make_renderbuffer()),
      depth_(gl::make_renderbuffer()),
      framebuffer_(gl::make_framebuffer()) {
  const int samples = look.style == Style::lit && look.samples > 1 ? look.samples : 0;
  glNamedRenderbufferStorageMultisample(colour_.name(), samples, colour_format(look.style),
                                        size.width, size.height);
  glNamedRenderbufferStorageMultisample(depth_.name(), samples, GL_DEPTH_COMPONENT32F, size.width,
                                        size.height);
  glNamedFramebufferRenderbuffer(framebuffer_.name(), GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                 colour_.name());
  glNamedFramebufferRenderbuffer(framebuffer_.name(), GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER,
                                 depth_.name());
  check_complete(framebuffer_.name(), size);
}

void Canvas::begin() {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  draw_into({0, 0, size_});
  (look_.style == Style::lit ? glEnable : glDisable)(GL_FRAMEBUFFER_SRGB);
  const float black[] = {0, 0, 0, 1}, infinitely_far = 0;
  glDepthMask(GL_TRUE);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_COLOR, 0, black);
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &infinitely_far);
}

void Canvas::draw_into(const RectPx& part) {
  glViewport(part.x, part.y, part.size.width, part.size.height);
}

void Canvas::resolve(const RectPx& part, Picture& picture, int x, int y) const {
  (look_.style == Style::lit ? glEnable
                             : glDisable)(GL_FRAMEBUFFER_SRGB);  // averages light, not bytes
  const auto [width, height] = part.size;
  glBlitNamedFramebuffer(framebuffer_.name(), picture.framebuffer(), part.x, part.y, part.x + width,
                         part.y + height, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
}

}  // namespace vindu
