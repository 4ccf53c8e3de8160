#include "rendering/gl_objects.h"

#include <array>
#include <cstddef>

#include "common/error.h"
#include "rendering/gl.h"

namespace nao::gl {
namespace {

/** Largest side of a framebuffer, pixels. Chosen: above the size of every window and camera here; a
 * driver with a lower limit rejects the framebuffer itself. */
constexpr int kMaxSize = 8192;

// Throws with the driver's log, which names line and reason.
unsigned compile(const std::string& name, unsigned kind, const std::string& source) {
  const unsigned shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  int compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == 0) {
    std::array<char, 2048> log{};
    glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
    glDeleteShader(shader);
    throw Error("shader " + name + " does not compile: " + log.data());
  }
  return shader;
}

// Throws if the bound framebuffer is incomplete.
void require_complete(const char* what) {
  const unsigned status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(std::string("the graphics driver rejects the ") + what + " (status " +
                std::to_string(status) + ")");
  }
}

}  // namespace

ShaderProgram::ShaderProgram(const std::string& name, const std::string& vertex_source,
                             const std::string& fragment_source) {
  const unsigned vertex = compile(name + " (vertex)", GL_VERTEX_SHADER, vertex_source);
  const unsigned fragment = compile(name + " (fragment)", GL_FRAGMENT_SHADER, fragment_source);
  id_ = glCreateProgram();
  glAttachShader(id_, vertex);
  glAttachShader(id_, fragment);
  glLinkProgram(id_);
  // The program keeps what it needs; shaders that are attached are deleted with it.
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  int linked = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &linked);
  if (linked == 0) {
    std::array<char, 2048> log{};
    glGetProgramInfoLog(id_, log.size(), nullptr, log.data());
    glDeleteProgram(id_);
    throw Error("shader " + name + " does not link: " + log.data());
  }
}

ShaderProgram::~ShaderProgram() {
  glDeleteProgram(id_);
}

void ShaderProgram::use() const {
  glUseProgram(id_);
}

// -1 for a name that the compiler has removed because it has no effect; OpenGL ignores it.
int ShaderProgram::location(const char* name) const {
  return glGetUniformLocation(id_, name);
}

void ShaderProgram::set(const char* name, int value) const {
  glUniform1i(location(name), value);
}

void ShaderProgram::set(const char* name, float value) const {
  glUniform1f(location(name), value);
}

void ShaderProgram::set(const char* name, const Eigen::Vector2i& value) const {
  glUniform2iv(location(name), 1, value.data());
}

void ShaderProgram::set(const char* name, const Eigen::Vector2f& value) const {
  glUniform2fv(location(name), 1, value.data());
}

void ShaderProgram::set(const char* name, const Eigen::Vector3f& value) const {
  glUniform3fv(location(name), 1, value.data());
}

void ShaderProgram::set(const char* name, const Eigen::Vector4f& value) const {
  glUniform4fv(location(name), 1, value.data());
}

void ShaderProgram::set(const char* name, const Eigen::Matrix4f& value) const {
  // Eigen and OpenGL both store matrices by columns: no transposition.
  glUniformMatrix4fv(location(name), 1, GL_FALSE, value.data());
}

MeshBuffer::MeshBuffer(const Mesh& mesh)
    : facing_(mesh), num_vertices_(static_cast<int>(mesh.vertices.size())) {
  glGenVertexArrays(1, &vertex_array_);
  glBindVertexArray(vertex_array_);
  glGenBuffers(1, &vertices_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(Vertex)),
               mesh.vertices.data(), GL_STATIC_DRAW);
  // Attribute numbers are those of the shaders' layout(location = ...).
  constexpr int kStride = sizeof(Vertex);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride,
                        reinterpret_cast<const void*>(offsetof(Vertex, position)));
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, kStride,
                        reinterpret_cast<const void*>(offsetof(Vertex, normal)));
  glEnableVertexAttribArray(2);
  // Normalized: bytes 0 to 255 reach the shader as 0 to 1.
  glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, kStride,
                        reinterpret_cast<const void*>(offsetof(Vertex, encoded_color)));
  glBindVertexArray(0);
}

MeshBuffer::~MeshBuffer() {
  glDeleteBuffers(1, &vertices_);
  glDeleteVertexArrays(1, &vertex_array_);
}

void MeshBuffer::draw(const IndexStream& stream, int first, int num_indices) const {
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, stream.id());
  // With the range of the indices the driver need not look for it.
  glDrawRangeElements(GL_TRIANGLES, 0, static_cast<unsigned>(num_vertices_ - 1), num_indices,
                      GL_UNSIGNED_INT,
                      reinterpret_cast<const void*>(static_cast<size_t>(first) * sizeof(uint32_t)));
}

IndexStream::IndexStream() {
  glGenBuffers(1, &id_);
}

IndexStream::~IndexStream() {
  glDeleteBuffers(1, &id_);
}

void IndexStream::set(const std::vector<uint32_t>& indices) const {
  // The array of elements belongs to the vertex array that is bound.
  glBindVertexArray(0);
  glBindBuffer(GL_ARRAY_BUFFER, id_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(uint32_t)),
               indices.data(), GL_STREAM_DRAW);
}

StreamBuffer::StreamBuffer() {
  glGenVertexArrays(1, &vertex_array_);
  glBindVertexArray(vertex_array_);
  glGenBuffers(1, &vertices_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  constexpr int kStride = sizeof(Vertex);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, kStride,
                        reinterpret_cast<const void*>(offsetof(Vertex, position)));
  glEnableVertexAttribArray(1);
  glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, kStride,
                        reinterpret_cast<const void*>(offsetof(Vertex, color)));
  glBindVertexArray(0);
}

StreamBuffer::~StreamBuffer() {
  glDeleteBuffers(1, &vertices_);
  glDeleteVertexArrays(1, &vertex_array_);
}

void StreamBuffer::draw_lines(const std::vector<Vertex>& vertices) const {
  draw(GL_LINES, vertices);
}

void StreamBuffer::draw_triangles(const std::vector<Vertex>& vertices) const {
  draw(GL_TRIANGLES, vertices);
}

void StreamBuffer::draw(unsigned mode, const std::vector<Vertex>& vertices) const {
  if (vertices.empty()) return;
  glBindVertexArray(vertex_array_);
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
               // A new store for each call: the driver need not wait until the last drawing has
               // read the old one.
               vertices.data(), GL_STREAM_DRAW);
  glDrawArrays(mode, 0, static_cast<int>(vertices.size()));
}

EmptyVertexArray::EmptyVertexArray() {
  glGenVertexArrays(1, &id_);
}

EmptyVertexArray::~EmptyVertexArray() {
  glDeleteVertexArrays(1, &id_);
}

void EmptyVertexArray::draw_triangles(int num_vertices) const {
  glBindVertexArray(id_);
  glDrawArrays(GL_TRIANGLES, 0, num_vertices);
}

// Color and depth as renderbuffers: they are read back, never sampled.
Framebuffer::Framebuffer(int width, int height) : width_(width), height_(height) {
  if (width < 1 || height < 1 || width > kMaxSize || height > kMaxSize) {
    throw Error("the image size " + std::to_string(width) + "x" + std::to_string(height) +
                " is out of range: each side must be 1 to " + std::to_string(kMaxSize) + " pixels");
  }
  glGenFramebuffers(1, &id_);
  glBindFramebuffer(GL_FRAMEBUFFER, id_);
  glGenRenderbuffers(1, &color_);
  glBindRenderbuffer(GL_RENDERBUFFER, color_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_);
  glGenRenderbuffers(1, &depth_);
  glBindRenderbuffer(GL_RENDERBUFFER, depth_);
  glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
  require_complete("framebuffer");
}

Framebuffer::~Framebuffer() {
  glDeleteFramebuffers(1, &id_);
  glDeleteRenderbuffers(1, &color_);
  glDeleteRenderbuffers(1, &depth_);
}

void Framebuffer::read(std::vector<uint8_t>& pixels) const {
  read_pixels(id_, width_, height_, pixels);
}

ShadowMap::ShadowMap(int size) : size_(size) {
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, size, size, 0, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_INT, nullptr);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  // A lookup compares depths and returns the lit fraction; the linear filter averages four
  // comparisons (percentage-closer filtering).
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glGenFramebuffers(1, &framebuffer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  // Depth only: there is no color buffer to write.
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  require_complete("shadow map");
}

ShadowMap::~ShadowMap() {
  glDeleteFramebuffers(1, &framebuffer_);
  glDeleteTextures(1, &texture_);
}

// Four bytes a pixel: rows are aligned without padding, and BGRA is the drivers' own order.
void read_pixels(unsigned framebuffer, int width, int height, std::vector<uint8_t>& pixels) {
  pixels.resize(static_cast<size_t>(4) * width * height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
  // Rows come bottom up, as OpenGL has them.
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width, height, GL_BGRA, GL_UNSIGNED_BYTE, pixels.data());
}

}  // namespace nao::gl
