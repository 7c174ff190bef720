// What is drawn into and what comes out: a canvas with 32-bit float depth and, where light is
// drawn, several samples a pixel in sRGB; and a picture, a plain texture that canvases are resolved
// into and that can be read back.
#pragma once

#include "renderer/gl/handle.h"
#include "renderer/image.h"

namespace vindu {

enum class Style {
  lit,    ///< light, tone curve, sRGB
  unlit,  ///< base colours as they are: no light, tone, sRGB or multisampling; for measuring
};

enum class Shadows {
  none,
  crisp,  ///< of 1024 pixels, one bilinear comparison: for a CPU that draws
  soft,   ///< of 2048 pixels, edges over three of them
};

/// One for the whole wall: neighbours must agree.
struct Look {
  Style style = Style::lit;
  int samples = 4;                  ///< a pixel, where light is drawn; 1 is much cheaper on a CPU
  Shadows shadows = Shadows::soft;  ///< where light is drawn
  float anisotropy = 8;             ///< of all textures of models
};

/// A part of a canvas or picture, its lower left at (x, y), counted from the lower left.
struct RectPx {
  int x = 0;
  int y = 0;
  SizePx size;
};

/// A texture; row 0 is the bottom, as OpenGL counts. Bound to the render thread.
class Picture {
 public:
  Picture(SizePx size, Style style);

  SizePx size() const { return size_; }
  GLuint texture() const { return texture_.name(); }
  GLuint framebuffer() const { return framebuffer_.name(); }
  void clear(Rgba8 colour) { clear(colour, {0, 0, size_}); }
  void clear(Rgba8 colour, const RectPx& part);
  /// For pictures that are drawn smaller than they are.
  void make_mipmaps() { glGenerateTextureMipmap(texture_.name()); }
  Image read() const;
  Image read(const RectPx& part) const;
  /// `image` must have this picture's size.
  void write(const Image& image) { write(image, 0, 0); }
  /// Into a part, the image's lower left at (x, y); it must lie within the picture.
  void write(const Image& image, int x, int y);
  /// All of another one into a part, its lower left at (x, y); the bytes as they are.
  void copy(const Picture& other, int x, int y);

 private:
  SizePx size_;
  gl::Texture texture_;
  gl::Framebuffer framebuffer_;
};

/// Bound to the render thread.
class Canvas {
 public:
  /// Throws Error when the GPU cannot make one of this size.
  Canvas(SizePx size, const Look& look);

  SizePx size() const { return size_; }
  /// Makes it the target of what is drawn next, cleared to black and infinitely far.
  void begin();
  /// After begin(): what is drawn next fills this part alone.
  void draw_into(const RectPx& part);
  /// Copies all of it into the lower left of `picture`.
  void resolve(Picture& picture) const { resolve({0, 0, size_}, picture, 0, 0); }
  /// Copies a part into `picture`, its lower left at (x, y).
  void resolve(const RectPx& part, Picture& picture, int x, int y) const;

 private:
  SizePx size_;
  Look look_;
  gl::Renderbuffer colour_;
  gl::Renderbuffer depth_;
  gl::Framebuffer framebuffer_;
};

}  // namespace vindu
