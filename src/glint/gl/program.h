#pragma once

#include <glad/gl.h>

#include <span>
#include <string_view>

#include "glint/gl/handles.h"

namespace glint {

/// The text of one stage, including its `#version` line. Several texts for one stage are linked
/// together.
struct ShaderSource {
  GLenum stage;  ///< GL_VERTEX_SHADER, GL_GEOMETRY_SHADER, GL_FRAGMENT_SHADER
  std::string_view text;
};

/// Whether the driver's compiler accepts `#line N "file"`, given the line
/// `#extension GL_ARB_shading_language_include : enable` after `#version`, so that its messages
/// name files. Otherwise only `#line N NUMBER` works.
bool fileNamesInLines();

/// A linked program.
class Program {
 public:
  Program() = default;

  /// Compiles and links. Throws Error: "NAME: fragment shader does not compile:" followed, from the
  /// next line on, by the driver's unmodified log with its file names and line numbers. Mere
  /// warnings are dropped.
  Program(std::string_view name, std::span<const ShaderSource> sources);

  GLuint id() const { return program_.id(); }
  void use() const { glUseProgram(program_.id()); }

  /// The location of a plain uniform, -1 if the program does not use it (glUniform* then does
  /// nothing).
  GLint uniform(const char* name) const { return glGetUniformLocation(program_.id(), name); }

  /// Assigns a uniform block to a binding point; false if the program does not use it.
  bool bindBlock(const char* name, GLuint binding) const;

  /// Assigns a sampler to a texture unit; false if the program does not use it. Leaves the program
  /// in use.
  bool bindSampler(const char* name, GLint unit) const;

 private:
  ProgramHandle program_;
};

}  // namespace glint
