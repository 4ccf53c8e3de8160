#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "rendering/facing_triangles.h"
#include "rendering/mesh.h"

/** Owners of OpenGL objects. Each must be created, used and destroyed while the same context is
 * current. */
namespace nao::gl {

/** A linked vertex and fragment shader. */
class ShaderProgram {
 public:
  /** @param name  For error messages. @throws Error  with the text of the shader compiler. */
  ShaderProgram(const std::string& name, const std::string& vertex_source,
                const std::string& fragment_source);
  ~ShaderProgram();
  ShaderProgram(const ShaderProgram&) = delete;
  ShaderProgram& operator=(const ShaderProgram&) = delete;

  void use() const;

  /** Sets a uniform of the program in use. A name that the shader does not use is ignored. */
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2i& value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, const Eigen::Vector4f& value) const;
  void set(const char* name, const Eigen::Matrix4f& value) const;

 private:
  int location(const char* name) const;

  unsigned id_ = 0;
};

/** Indices of vertices that change with every image. */
class IndexStream {
 public:
  IndexStream();
  ~IndexStream();
  IndexStream(const IndexStream&) = delete;
  IndexStream& operator=(const IndexStream&) = delete;

  void set(const std::vector<uint32_t>& indices) const;
  unsigned id() const { return id_; }

 private:
  unsigned id_ = 0;
};

/** A mesh in the graphics card's memory: attributes 0 position, 1 normal, 2 encoded color. */
class MeshBuffer {
 public:
  explicit MeshBuffer(const Mesh& mesh);
  ~MeshBuffer();
  MeshBuffer(const MeshBuffer&) = delete;
  MeshBuffer& operator=(const MeshBuffer&) = delete;

  /** Draws the triangles of the indices from `first` on. */
  void draw(const IndexStream& stream, int first, int num_indices) const;
  const FacingTriangles& facing() const { return facing_; }

 private:
  FacingTriangles facing_;
  int num_vertices_;
  unsigned vertex_array_ = 0;
  unsigned vertices_ = 0;
};

/** Vertices that change with every image: attributes 0 position, 1 four numbers (color). */
class StreamBuffer {
 public:
  struct Vertex {
    Eigen::Vector3f position;
    Eigen::Vector4f color;
  };

  StreamBuffer();
  ~StreamBuffer();
  StreamBuffer(const StreamBuffer&) = delete;
  StreamBuffer& operator=(const StreamBuffer&) = delete;

  void draw_lines(const std::vector<Vertex>& vertices) const;
  void draw_triangles(const std::vector<Vertex>& vertices) const;

 private:
  void draw(unsigned mode, const std::vector<Vertex>& vertices) const;

  unsigned vertex_array_ = 0;
  unsigned vertices_ = 0;
};

/** Draws without vertex data: the vertex shader computes the corners from gl_VertexID. */
class EmptyVertexArray {
 public:
  EmptyVertexArray();
  ~EmptyVertexArray();
  EmptyVertexArray(const EmptyVertexArray&) = delete;
  EmptyVertexArray& operator=(const EmptyVertexArray&) = delete;

  void draw_triangles(int num_vertices) const;

 private:
  unsigned id_ = 0;
};

/** Offscreen render target: 8 bits for each color, 24 bits of depth. */
class Framebuffer {
 public:
  /** @param width, height  1 to 8192 pixels. @throws Error  if the size is outside that range or
   * the driver rejects it. */
  Framebuffer(int width, int height);
  ~Framebuffer();
  Framebuffer(const Framebuffer&) = delete;
  Framebuffer& operator=(const Framebuffer&) = delete;

  unsigned id() const { return id_; }
  int width() const { return width_; }
  int height() const { return height_; }

  /** Waits until drawing is complete and copies the image: rows from the bottom up, 4 bytes a pixel
   * (blue, green, red, 255). @param pixels  Resized to 4 * width * height. */
  void read(std::vector<uint8_t>& pixels) const;

 private:
  int width_;
  int height_;
  unsigned id_ = 0;
  unsigned color_ = 0;
  unsigned depth_ = 0;
};

/** Square depth texture that shaders sample with depth comparison: 1 where lit, also outside of the
 * texture. */
class ShadowMap {
 public:
  /** @param size  Side, texels. @throws Error  if the driver rejects it. */
  explicit ShadowMap(int size);
  ~ShadowMap();
  ShadowMap(const ShadowMap&) = delete;
  ShadowMap& operator=(const ShadowMap&) = delete;

  unsigned framebuffer() const { return framebuffer_; }
  unsigned texture() const { return texture_; }
  int size() const { return size_; }

 private:
  int size_;
  unsigned framebuffer_ = 0;
  unsigned texture_ = 0;
};

/** Copies an image from any framebuffer, 0 for the window's; pixels as Framebuffer::read(). */
void read_pixels(unsigned framebuffer, int width, int height, std::vector<uint8_t>& pixels);

}  // namespace nao::gl
